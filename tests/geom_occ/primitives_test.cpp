// Distances on the kernel's primitives against closed forms.
#include <camber/base/error.hpp>
#include <camber/geom/analytic_model.hpp>

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "sample_bodies.hpp"

namespace camber {
namespace {

using test::random_points;
using test::round_trip;

constexpr double k_pi = std::numbers::pi;

/// Every face's normal points away from inside points of a convex body, or as `sign` says.
void expect_unit_normal(const SurfacePoint& s) {
  EXPECT_NEAR(s.normal.norm(), 1.0, 1e-12);
  EXPECT_NEAR(s.normal.dot(s.du), 0.0, 1e-9 * (1.0 + s.du.norm()));
  EXPECT_NEAR(s.normal.dot(s.dv), 0.0, 1e-9 * (1.0 + s.dv.norm()));
}

class SphereFrom : public testing::TestWithParam<const char*> {};

TEST_P(SphereFrom, AnyFormatHasTheDistancesOfASphere) {
  const auto model = round_trip(test::sphere(2.0), GetParam());
  const auto exact = make_sphere({0, 0, 0}, 2.0);
  const auto projector = model->projector(), reference = exact->projector();
  for (const Vec3& x : random_points(model->box(), 300)) {
    double distance = 1e300;
    for (int f = 1; f <= model->count(2); ++f)
      distance = std::min(distance, projector->closest({2, f}, x).distance);
    EXPECT_NEAR(distance, reference->closest({2, 1}, x).distance, 1e-10);
  }
}
INSTANTIATE_TEST_SUITE_P(Formats, SphereFrom, testing::Values(".step", ".iges", ".brep"));

TEST(OccSphere, IsOneFaceWithASeamAndTwoDegenerateCurves) {
  const auto model = round_trip(test::sphere(1.0));
  ASSERT_EQ(model->count(2), 1);
  ASSERT_EQ(model->count(1), 3);
  int degenerate = 0, seams = 0;
  for (int c = 1; c <= 3; ++c) {
    degenerate += model->is_degenerate(c);
    seams += model->is_seam(c, 1);
  }
  EXPECT_EQ(degenerate, 2);
  EXPECT_EQ(seams, 1);
  EXPECT_NEAR(model->periods(1)[0], 2.0 * k_pi, 1e-15);
  EXPECT_NEAR(model->box().diagonal(), 2.0 * std::sqrt(3.0), 1e-6);
}

TEST(OccSphere, AnswersAtPolesAndCentre) {
  const auto model = round_trip(test::sphere(1.0));
  const auto projector = model->projector();
  const Projection pole = projector->closest({2, 1}, {0, 0, 1.5});
  EXPECT_NEAR(pole.distance, 0.5, 1e-12);
  EXPECT_LT((pole.point - Vec3(0, 0, 1)).norm(), 1e-9);
  EXPECT_LT((projector->evaluate_face(1, pole.uv).normal - Vec3(0, 0, 1)).norm(), 1e-6);
  EXPECT_NEAR(projector->closest({2, 1}, {0, 0, 0}).distance, 1.0, 1e-12);
  EXPECT_EQ(projector->closest({2, 1}, {NAN, 0, 0}).status, ProjectionStatus::failed);
}

TEST(OccSphere, ReturnsTheSideOfTheSeamThatTheSeedIsOn) {
  const auto model = round_trip(test::sphere(1.0));
  const auto projector = model->projector();
  const Vec3 x(1.2, -0.012, 0.0);  // just below u = 0, or 2 pi
  EXPECT_NEAR(projector->closest({2, 1}, x, Vec2(0.02, 0.0)).uv[0], -0.01, 1e-4);
  EXPECT_NEAR(projector->closest({2, 1}, x, Vec2(6.2, 0.0)).uv[0], 2.0 * k_pi - 0.01, 1e-4);
  const double free = projector->closest({2, 1}, x).uv[0];
  EXPECT_NEAR(free, 2.0 * k_pi - 0.01, 1e-4);  // inside the face's own range
}

TEST(OccSphere, PutsTheSeamOnTheSideThatIsAskedFor) {
  const auto model = round_trip(test::sphere(1.0));
  for (int c = 1; c <= 3; ++c) {
    if (!model->is_seam(c, 1)) continue;
    const auto range = model->range(c);
    const double t = 0.5 * (range.first + range.last);
    EXPECT_NEAR(model->curve_on_face(c, 1, t, Vec2(0.1, 0.0))[0], 0.0, 1e-12);
    EXPECT_NEAR(model->curve_on_face(c, 1, t, Vec2(6.1, 0.0))[0], 2.0 * k_pi, 1e-12);
    EXPECT_NEAR(model->curve_on_face(c, 1, t, Vec2(-6.1, 0.0))[0], -2.0 * k_pi, 1e-12);
  }
}

TEST(OccCone, HasTheDistancesOfASegmentTurnedAboutItsAxis) {
  const auto model = round_trip(test::cone(1.0, 2.0), ".step");
  const auto projector = model->projector();
  const std::vector<int> side = test::faces(*model, false);
  ASSERT_EQ(side.size(), 1u);
  const Vec2 base(1.0, 0.0), slope(-1.0, 2.0);  // in the half plane (r, z)
  std::vector<Vec3> points = random_points(model->box(), 300);
  points.insert(points.end(), {{0, 0, 3}, {0, 0, 2}, {1e-9, 0, 2.5}, {0, 0, 1}, {0, 0, -1}});
  for (const Vec3& x : points) {
    const Vec2 q(std::hypot(x[0], x[1]), x[2]);
    const double s = std::clamp((q - base).dot(slope) / slope.squaredNorm(), 0.0, 1.0);
    const Projection p = projector->closest({2, side[0]}, x);
    EXPECT_NEAR(p.distance, (q - base - s * slope).norm(), 1e-9) << x.transpose();
    EXPECT_TRUE(p.point.allFinite() && p.uv.allFinite());
    EXPECT_LT((projector->evaluate_face(side[0], p.uv).point - p.point).norm(), 1e-6);
  }
  EXPECT_EQ(projector->closest({2, side[0]}, {0, 0, 3}).status, ProjectionStatus::boundary);
}

TEST(OccTorus, HasTheDistancesOfATorus) {
  const auto model = round_trip(test::torus(3.0, 1.0), ".step");
  const auto exact = make_torus({0, 0, 0}, {0, 0, 1}, 3.0, 1.0);
  const auto projector = model->projector(), reference = exact->projector();
  std::vector<Vec3> points = random_points(model->box(), 300);
  points.insert(points.end(), {{0, 0, 0}, {0, 0, 1}, {3, 0, 0}});
  for (const Vec3& x : points) {
    EXPECT_NEAR(projector->closest({2, 1}, x).distance, reference->closest({2, 1}, x).distance,
                1e-10);
    EXPECT_TRUE(projector->closest({2, 1}, x).uv.allFinite());
  }
  EXPECT_GT(model->periods(1).minCoeff(), 6.28);
}

TEST(OccCylinder, HasFacesWhoseNormalsPointOut) {
  for (const char* extension : {".step", ".iges", ".brep"}) {
    const auto model = round_trip(test::cylinder(1.0, 2.0), extension);
    const auto projector = model->projector();
    ASSERT_EQ(model->count(2), 3) << extension;
    for (int f = 1; f <= 3; ++f) {
      for (const Vec3& x : random_points(model->box(), 50)) {
        const Projection p = projector->closest({2, f}, x);
        const SurfacePoint s = projector->evaluate_face(f, p.uv);
        expect_unit_normal(s);
        EXPECT_GT(s.normal.dot(p.point - Vec3(0, 0, 1)), 0.1) << extension << " face " << f;
      }
    }
  }
}

TEST(OccDrilledPlate, HasNormalsThatPointIntoTheHole) {
  const auto model = round_trip(test::drilled_plate(), ".step");
  const auto projector = model->projector();
  for (const int f : test::faces(*model, false)) {
    for (const Vec3& x : random_points(model->box({2, f}), 50)) {
      const Projection p = projector->closest({2, f}, x);
      const Vec3 n = projector->evaluate_face(f, p.uv).normal;
      EXPECT_GT(n.dot(Vec3(2, 2, p.point[2]) - p.point), 0.99);
    }
  }
}

TEST(OccFaces, HaveTheDerivativesOfTheirDifferences) {
  for (const TopoDS_Shape& shape : {test::torus(2, 0.5), test::cone(1, 1), test::wavy_face()}) {
    const auto model = round_trip(shape);
    const auto projector = model->projector();
    for (int f = 1; f <= model->count(2); ++f) {
      for (const Vec3& x : random_points(model->box({2, f}), 20)) {
        const Projection p = projector->closest({2, f}, x);
        if (p.status != ProjectionStatus::inside) continue;
        const double h = 1e-6;
        const SurfacePoint s = projector->evaluate_face(f, p.uv);
        const auto at = [&](double du, double dv) {
          return projector->evaluate_face(f, p.uv + Vec2(du, dv)).point;
        };
        EXPECT_LT(((at(h, 0) - at(-h, 0)) / (2 * h) - s.du).norm(), 1e-7);
        EXPECT_LT(((at(0, h) - at(0, -h)) / (2 * h) - s.dv).norm(), 1e-7);
      }
    }
  }
}

TEST(OccModel, ScalesAllLengths) {
  const auto millimetres = round_trip(test::drilled_cylinder());
  const auto metres = round_trip(test::drilled_cylinder());
  metres->set_scale(1e-3);
  EXPECT_DOUBLE_EQ(metres->scale(), 1e-3);
  EXPECT_NEAR(metres->box().diagonal(), 1e-3 * millimetres->box().diagonal(), 1e-12);
  const auto a = millimetres->projector(), b = metres->projector();
  for (int f = 1; f <= metres->count(2); ++f) {
    EXPECT_DOUBLE_EQ(metres->tolerance({2, f}), 1e-3 * millimetres->tolerance({2, f}));
    for (const Vec3& x : random_points(millimetres->box(), 20)) {
      const Projection p = a->closest({2, f}, x), q = b->closest({2, f}, 1e-3 * x);
      EXPECT_NEAR(q.distance, 1e-3 * p.distance, 1e-12);
      const SurfacePoint s = a->evaluate_face(f, p.uv), t = b->evaluate_face(f, p.uv);
      EXPECT_LT((t.point - 1e-3 * s.point).norm() + (t.du - 1e-3 * s.du).norm(), 1e-15);
      EXPECT_LT((t.normal - s.normal).norm(), 1e-15);
      const Vec3 d = s.normal;
      const auto hit = a->along_line(f, x, d, 3.0), small = b->along_line(f, 1e-3 * x, d, 3e-3);
      ASSERT_EQ(hit.has_value(), small.has_value());
      if (!hit) continue;
      EXPECT_NEAR(small->distance, 1e-3 * hit->distance, 1e-12);
    }
  }
  for (int c = 1; c <= metres->count(1); ++c) {
    const auto range = metres->range(c);
    EXPECT_NEAR(b->curve_length(c, range.first, range.last),
                1e-3 * a->curve_length(c, range.first, range.last), 1e-14);
  }
  EXPECT_THROW(metres->set_scale(-1.0), GeometryError);
}

}  // namespace
}  // namespace camber
