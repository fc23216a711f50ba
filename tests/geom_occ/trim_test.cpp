#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "sample_bodies.hpp"

namespace camber {
namespace {

using test::random_points;
using test::round_trip;

/// The top face (z = 1) of the drilled plate.
int top_face(const GeometryModel& model) {
  for (const int f : test::faces(model, true))
    if (model.box({2, f}).lower[2] > 0.5) return f;
  return 0;
}

/// Distance to the square [0,4]^2 without the disc of radius 1 around (2,2), at z = 1.
double plate_distance(const Vec3& x) {
  const Vec2 q(x[0], x[1]), inside = q.cwiseMax(0.0).cwiseMin(4.0);
  const double radial = (q - Vec2(2, 2)).norm();
  const double in_plane = radial < 1.0 ? 1.0 - radial : (q - inside).norm();
  return std::hypot(in_plane, x[2] - 1.0);
}

TEST(TrimmedPlate, HasTheDistanceOfASquareWithAHole) {
  const auto model = round_trip(test::drilled_plate(), ".step");
  const auto projector = model->projector();
  const int top = top_face(*model);
  ASSERT_GT(top, 0);
  for (const Vec3& x : random_points(model->box(), 500)) {
    const Projection p = projector->closest({2, top}, x);
    EXPECT_NEAR(p.distance, plate_distance(x), 1e-9) << x.transpose();
    const double radial = (Vec2(x[0], x[1]) - Vec2(2, 2)).norm();
    const bool is_over = radial > 1.0 && x[0] > 0 && x[1] > 0 && x[0] < 4 && x[1] < 4;
    EXPECT_EQ(p.status, is_over ? ProjectionStatus::inside : ProjectionStatus::boundary);
  }
}

TEST(TrimmedPlate, OverTheHoleGivesItsRimAndNotTheUntrimmedPlane) {
  const auto model = round_trip(test::drilled_plate());
  const auto projector = model->projector();
  const int top = top_face(*model);
  // 0.05 above the plane, 0.4 from the rim.
  const Projection p = projector->closest({2, top}, {2.6, 2.0, 1.05});
  EXPECT_NEAR(p.distance, std::hypot(0.4, 0.05), 1e-12);
  EXPECT_LT((p.point - Vec3(3, 2, 1)).norm(), 1e-12);
  EXPECT_EQ(p.status, ProjectionStatus::boundary);
  const Projection seeded = projector->closest({2, top}, {2.6, 2.0, 1.05}, p.uv);
  EXPECT_LT((seeded.point - p.point).norm(), 1e-12);
}

TEST(TrimmedPlate, KeepsTheSurfacePointWithinTheEdgesTolerance) {
  const auto model = round_trip(test::drilled_plate());
  const auto projector = model->projector();
  const int top = top_face(*model);
  const double outside = 5e-8;  // half of the edge tolerance beyond the rim
  const Vec3 x(3.0 - outside, 2.0, 1.01);
  const Projection p = projector->closest({2, top}, x);
  EXPECT_NEAR(p.distance, 0.01, 1e-15);
  EXPECT_EQ(p.status, ProjectionStatus::inside);
}

TEST(TrimmedPlate, LetsALineThroughTheHole) {
  const auto model = round_trip(test::drilled_plate());
  const auto projector = model->projector();
  const int top = top_face(*model);
  EXPECT_FALSE(projector->along_line(top, {2.3, 2.2, 1.5}, {0, 0, 1}, 2.0));
  const auto hit = projector->along_line(top, {3.5, 2.2, 1.5}, {0, 0, 7}, 2.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->distance, 0.5, 1e-12);
  EXPECT_LT((hit->point - Vec3(3.5, 2.2, 1.0)).norm(), 1e-12);
  EXPECT_FALSE(projector->along_line(top, {3.5, 2.2, 1.5}, {0, 0, 1}, 0.4));
  EXPECT_FALSE(projector->along_line(top, {3.5, 2.2, 1.5}, {1, 0, 0}, 9.0));  // parallel
  EXPECT_FALSE(projector->along_line(top, {3.5, 2.2, 1.5}, {0, 0, 0}, 9.0));
}

TEST(DrilledCylinder, IsMetByALineAtTheNearestCrossing) {
  const auto model = round_trip(test::drilled_cylinder(), ".step");
  const auto projector = model->projector();
  int side = 0;
  for (const int f : test::faces(*model, false))
    if (model->box({2, f}).upper[2] > 1.9) side = f;
  ASSERT_GT(side, 0);
  // Along y through the axis' neighbourhood: crossings at y = +-1; the nearer one is asked for.
  const auto hit = projector->along_line(side, {0, 0.2, 1.0}, {0, 1, 0}, 3.0);
  ASSERT_TRUE(hit);
  EXPECT_LT((hit->point - Vec3(0, 1, 1)).norm(), 1e-10);
  EXPECT_NEAR(hit->distance, 0.8, 1e-10);
  // Through the hole along x: nothing is met; above it both walls are.
  EXPECT_FALSE(projector->along_line(side, {3, 0, 0}, {-1, 0, 0}, 10.0));
  const auto above = projector->along_line(side, {3, 0, 1}, {-1, 0, 0}, 10.0);
  ASSERT_TRUE(above);
  EXPECT_LT((above->point - Vec3(1, 0, 1)).norm(), 1e-10);
  const auto seeded =
      projector->along_line(side, {3, 0, 1}, {-1, 0, 0}, 10.0, above->uv + Vec2(0.05, 0.1));
  ASSERT_TRUE(seeded);
  EXPECT_LT((seeded->point - above->point).norm(), 1e-10);
}

TEST(SeededProjection, FindsWhatTheGlobalOneFindsNearTheSurface) {
  for (const TopoDS_Shape& shape : {test::drilled_cylinder(), test::wavy_face_with_hole(),
                                    test::torus(2, 0.7), test::cone(1, 2)}) {
    const auto model = round_trip(shape);
    const auto projector = model->projector();
    for (int f = 1; f <= model->count(2); ++f) {
      const double size = model->box({2, f}).diagonal();
      for (const Vec3& y : random_points(model->box({2, f}), 60)) {
        const Projection on = projector->closest({2, f}, y);
        const SurfacePoint s = projector->evaluate_face(f, on.uv);
        const Vec3 x = s.point + 0.005 * size * s.normal;
        const Projection global = projector->closest({2, f}, x);
        const Projection seeded = projector->closest({2, f}, x, on.uv);
        EXPECT_NEAR(seeded.distance, global.distance, 1e-9 * size);
      }
    }
  }
}

TEST(SeededProjection, SurvivesSeedsThatAreNoUse) {
  const auto model = round_trip(test::drilled_cylinder());
  const auto projector = model->projector();
  for (int f = 1; f <= model->count(2); ++f) {
    for (const Vec3& x : random_points(model->box({2, f}), 20)) {
      const Projection global = projector->closest({2, f}, x);
      const Projection blind = projector->closest({2, f}, x, Vec2(NAN, 0.0));
      EXPECT_EQ(blind.point, global.point);
      const Projection far = projector->closest({2, f}, x, Vec2(50.0, -70.0));
      EXPECT_TRUE(far.uv.allFinite());
      EXPECT_LT((projector->evaluate_face(f, far.uv).point - far.point).norm(), 1e-6);
      EXPECT_NEAR((x - far.point).norm(), far.distance, 1e-12);
      EXPECT_GE(far.distance, global.distance - 1e-6);
    }
  }
}

TEST(WavyFace, BeyondItsCornerGivesItsNearestBorder) {
  const auto model = round_trip(test::wavy_face());
  const auto projector = model->projector();
  // Far beyond one corner: the answer is on the border, and not nearer than any sampled border
  // point.
  const Vec3 x(6.0, 5.0, 0.0);
  const Projection p = projector->closest({2, 1}, x);
  EXPECT_EQ(p.status, ProjectionStatus::boundary);
  double sampled = 1e300;
  for (const int c : model->curves_of_face(1)) {
    const auto range = model->range(c);
    for (int i = 0; i <= 1000; ++i)
      sampled = std::min(
          sampled,
          (projector->evaluate_curve(c, range.first + (range.last - range.first) * i / 1000.0)
               .point -
           x)
              .norm());
  }
  EXPECT_LE(p.distance, sampled + 1e-12);
  EXPECT_GE(p.distance, sampled - 1e-3);
}

}  // namespace
}  // namespace camber
