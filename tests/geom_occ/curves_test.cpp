#include <camber/base/error.hpp>

#include <array>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <gp_Ax2.hxx>
#include <gp_Elips.hxx>

#include "sample_bodies.hpp"

namespace camber {
namespace {

using test::round_trip;

constexpr double k_pi = std::numbers::pi;

/// The circle at z = height of a cylinder of radius 1.
int rim(const GeometryModel& model, double height) {
  for (int c = 1; c <= model.count(1); ++c)
    if (std::abs(model.box({1, c}).lower[2] - height) < 1e-3 &&
        std::abs(model.box({1, c}).upper[2] - height) < 1e-3)
      return c;
  return 0;
}

TopoDS_Shape ellipse_disc(double a, double b) {
  const gp_Elips ellipse(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1)), a, b);
  return BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(ellipse)).Wire())
      .Shape();
}

TEST(OccCurve, OfACircleHasItsPerimeterAndPeriod) {
  const auto model = round_trip(test::cylinder(1.0, 2.0), ".step");
  const auto projector = model->projector();
  const int c = rim(*model, 2.0);
  ASSERT_GT(c, 0);
  const auto range = model->range(c);
  EXPECT_NEAR(range.period, 2.0 * k_pi, 1e-12);
  EXPECT_NEAR(projector->curve_length(c, range.first, range.last), 2.0 * k_pi, 1e-12);
  EXPECT_NEAR(projector->curve_length(c, 1.0, 1.5), 0.5, 1e-13);
  EXPECT_FALSE(model->is_straight(c));
  EXPECT_EQ(model->vertices_of_curve(c).size(), 1u);
  EXPECT_EQ(model->faces_of_curve(c).size(), 2u);
}

TEST(OccCurve, OfAnEllipseHasTheEllipticIntegral) {
  const auto model = round_trip(ellipse_disc(5.0, 2.0));
  const auto projector = model->projector();
  const auto range = model->range(1);
  const double expected = 20.0 * std::comp_ellint_2(std::sqrt(1.0 - 4.0 / 25.0));
  EXPECT_NEAR(projector->curve_length(1, range.first, range.last), expected, 1e-12 * expected);
}

TEST(OccCurve, IsDividedEvenlyForwardsBackwardsAndOverTheSeam) {
  const auto model = round_trip(ellipse_disc(5.0, 2.0));
  const auto projector = model->projector();
  const auto range = model->range(1);
  const std::array<double, 5> fractions{0.0, 0.25, 0.5, 0.75, 1.0};
  std::array<Projection, 5> points;
  for (const auto& [t0, t1] :
       {std::pair(0.2, 1.7), std::pair(1.7, 0.2), std::pair(range.last - 0.5, range.last + 0.5)}) {
    projector->divide_curve(1, t0, t1, fractions, points);
    const double whole = projector->curve_length(1, t0, t1);
    EXPECT_NEAR(points[0].uv[0], t0, 1e-12);
    EXPECT_NEAR(points[4].uv[0], t1, 1e-12);
    for (std::size_t i = 0; i + 1 < 5; ++i) {
      const double piece = projector->curve_length(1, points[i].uv[0], points[i + 1].uv[0]);
      EXPECT_NEAR(piece, 0.25 * whole, 1e-12 * whole);
      EXPECT_LT((projector->evaluate_curve(1, points[i].uv[0]).point - points[i].point).norm(),
                1e-13);
    }
  }
}

TEST(OccCurve, HasTheTangentOfItsDifferences) {
  const auto model = round_trip(test::drilled_cylinder());
  const auto projector = model->projector();
  for (int c = 1; c <= model->count(1); ++c) {
    const auto range = model->range(c);
    for (int i = 1; i < 10; ++i) {
      const double t = range.first + (range.last - range.first) * (0.1 * i + 0.01), h = 1e-6;
      const Vec3 difference =
          (projector->evaluate_curve(c, t + h).point - projector->evaluate_curve(c, t - h).point) /
          (2 * h);
      EXPECT_LT((projector->evaluate_curve(c, t).tangent - difference).norm(), 1e-6);
    }
  }
}

TEST(OccCurve, ClampsTheNearestPointToItsEnds) {
  const auto model = round_trip(test::box(1, 1, 1));
  const auto projector = model->projector();
  for (int c = 1; c <= model->count(1); ++c) {
    EXPECT_TRUE(model->is_straight(c));
    EXPECT_EQ(model->vertices_of_curve(c).size(), 2u);
    const auto range = model->range(c);
    EXPECT_EQ(range.period, 0.0);
    const CurvePoint end = projector->evaluate_curve(c, range.last);
    const Projection beyond =
        projector->closest({1, c}, end.point + 0.7 * end.tangent.normalized());
    EXPECT_NEAR(beyond.distance, 0.7, 1e-12);
    EXPECT_EQ(beyond.status, ProjectionStatus::boundary);
    EXPECT_NEAR(beyond.uv[0], range.last, 1e-12);
    const Projection seeded = projector->closest({1, c}, end.point - 0.3 * end.tangent.normalized(),
                                                 Vec2(range.first, 0.0));
    EXPECT_NEAR(seeded.distance, 0.0, 1e-12);
    EXPECT_EQ(seeded.status, ProjectionStatus::inside);
  }
}

TEST(OccCurve, ClosedReturnsTheParameterNearTheSeed) {
  const auto model = round_trip(test::cylinder(1.0, 2.0));
  const auto projector = model->projector();
  const int c = rim(*model, 0.0);
  ASSERT_GT(c, 0);
  const Projection base = projector->closest({1, c}, {2.0, -0.02, 0.0});
  EXPECT_NEAR(base.distance, std::sqrt(4.0004) - 1.0, 1e-12);
  const double period = model->range(c).period;
  const Projection above =
      projector->closest({1, c}, {2.0, -0.02, 0.0}, Vec2(base.uv[0] + period + 0.1, 0.0));
  EXPECT_NEAR(above.uv[0], base.uv[0] + period, 1e-9);
}

TEST(OccCurve, LiesOnItsFaces) {
  for (const TopoDS_Shape& shape :
       {test::drilled_cylinder(), test::drilled_plate(), test::cone(1, 2)}) {
    const auto model = round_trip(shape);
    const auto projector = model->projector();
    for (int f = 1; f <= model->count(2); ++f) {
      for (const int c : model->curves_of_face(f)) {
        if (model->is_degenerate(c)) continue;
        const auto range = model->range(c);
        for (int i = 0; i <= 8; ++i) {
          const double t = range.first + (range.last - range.first) * i / 8.0;
          const Vec3 on_face = projector->evaluate_face(f, model->curve_on_face(c, f, t)).point;
          EXPECT_LT((on_face - projector->evaluate_curve(c, t).point).norm(),
                    2.0 * model->tolerance({1, c}));
        }
      }
    }
  }
}

TEST(OccCurve, ThatDoesNotBoundTheFaceIsRefused) {
  const auto model = round_trip(test::box(1, 1, 1));
  const std::vector<int> own = model->curves_of_face(1);
  int other = 1;
  while (std::find(own.begin(), own.end(), other) != own.end()) ++other;
  EXPECT_THROW(static_cast<void>(model->curve_on_face(other, 1, 0.5)), GeometryError);
}

TEST(OccCurve, DegenerateIsAPointAtThePole) {
  const auto model = round_trip(test::sphere(1.0));
  const auto projector = model->projector();
  for (int c = 1; c <= model->count(1); ++c) {
    if (!model->is_degenerate(c)) continue;
    EXPECT_EQ(projector->curve_length(c, 0.0, 1.0), 0.0);
    const Projection p = projector->closest({1, c}, {3, 0, 0});
    EXPECT_NEAR(p.distance, std::sqrt(10.0), 1e-12);
    EXPECT_NEAR(std::abs(p.point[2]), 1.0, 1e-12);
  }
}

TEST(OccVertex, IsItsPoint) {
  const auto model = round_trip(test::box(1, 2, 3));
  const auto projector = model->projector();
  ASSERT_EQ(model->count(0), 8);
  double nearest = 1e300;
  for (int v = 1; v <= 8; ++v)
    nearest = std::min(nearest, projector->closest({0, v}, {2, 2, 3}).distance);
  EXPECT_DOUBLE_EQ(nearest, 1.0);
}

}  // namespace
}  // namespace camber
