#include <camber/base/error.hpp>
#include <camber/geom/analytic_model.hpp>

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace camber {
namespace {

constexpr GeomEntity k_face{2, 1};

struct Sample {
  const char* name;
  std::unique_ptr<GeometryModel> (*make)();
};

BsplineSurface bump() {
  std::vector<Vec3> poles;
  for (int i = 0; i < 5; ++i)
    for (int j = 0; j < 5; ++j) poles.emplace_back(i, j, i == 2 && j == 2 ? 2.0 : 0.0);
  const BsplineBasis basis(3, {0, 0, 0, 0, 0.5, 1, 1, 1, 1});
  return {basis, basis, poles};
}

const Sample k_samples[] = {
    {"plane",
     [] {
       return make_plane({0, 0, 1}, {2, 0, 0}, {0, 3, 0});
     }},
    {"sphere",
     [] {
       return make_sphere({1, 2, 3}, 2.0);
     }},
    {"cylinder",
     [] {
       return make_cylinder({0, 0, 0}, {0, 0, 3}, 1.0);
     }},
    {"torus",
     [] {
       return make_torus({0, 0, 0}, {0, 1, 1}, 2.0, 0.5);
     }},
    {"ellipsoid",
     [] {
       return make_ellipsoid({0, 1, 0}, {0.5, 3, 1});
     }},
    {"bspline", [] { return make_bspline_patch(bump()); }},
};

class AnalyticModelOf : public testing::TestWithParam<Sample> {
 protected:
  std::vector<Vec3> points(int count) const {
    const Box box = model->box();
    std::mt19937 random(11);
    std::uniform_real_distribution<double> uniform(-0.5, 1.5);
    std::vector<Vec3> result;
    for (int i = 0; i < count; ++i)
      result.push_back(box.lower + Vec3(uniform(random), uniform(random), uniform(random))
                                       .cwiseProduct(box.upper - box.lower + Vec3::Constant(0.1)));
    return result;
  }
  std::unique_ptr<GeometryModel> model = GetParam().make();
  std::unique_ptr<Projector> projector = model->projector();
};

TEST_P(AnalyticModelOf, AnyKindIsNowhereNearerThanItsClosestPoint) {
  // A dense sample of the surface is the naive reference.
  const Projection corner = projector->closest(k_face, model->box().centre());
  ASSERT_NE(corner.status, ProjectionStatus::failed);
  const auto periods = model->periods(1);
  for (const Vec3& x : points(20)) {
    const Projection p = projector->closest(k_face, x);
    EXPECT_NEAR((x - p.point).norm(), p.distance, 1e-12);
    EXPECT_LT((projector->evaluate_face(1, p.uv).point - p.point).norm(), 1e-7);
    for (int i = 0; i <= 25; ++i) {
      for (int j = 0; j <= 25; ++j) {
        const double u = periods[0] > 0 ? periods[0] * i / 25.0 : i / 25.0;
        const double v = periods[1] > 0 ? periods[1] * j / 25.0
                         : GetParam().name == std::string("sphere") ||
                                 GetParam().name == std::string("ellipsoid")
                             ? std::numbers::pi * (j / 25.0 - 0.5)
                             : j / 25.0;
        EXPECT_GE((projector->evaluate_face(1, {u, v}).point - x).norm(), p.distance - 1e-12);
      }
    }
  }
}

TEST_P(AnalyticModelOf, AnyKindHasItsInsideFeetOnTheNormal) {
  for (const Vec3& x : points(200)) {
    const Projection p = projector->closest(k_face, x);
    if (p.status != ProjectionStatus::inside || p.distance < 1e-6) continue;
    const Vec3 normal = projector->evaluate_face(1, p.uv).normal;
    EXPECT_LT((x - p.point).cross(normal).norm(), 1e-7 * (1.0 + p.distance));
  }
}

TEST_P(AnalyticModelOf, AnyKindScalesWithItsUnit) {
  const auto scaled = GetParam().make();
  scaled->set_scale(25.4);
  const auto large = scaled->projector();
  EXPECT_NEAR(scaled->box().diagonal(), 25.4 * model->box().diagonal(), 1e-9);
  for (const Vec3& x : points(50)) {
    const Projection a = projector->closest(k_face, x), b = large->closest(k_face, 25.4 * x);
    EXPECT_NEAR(b.distance, 25.4 * a.distance, 1e-10);
    EXPECT_LT((b.uv - a.uv).norm(), 1e-6);
    const SurfacePoint s = projector->evaluate_face(1, a.uv), t = large->evaluate_face(1, a.uv);
    EXPECT_LT((t.du - 25.4 * s.du).norm() + (t.point - 25.4 * s.point).norm(), 1e-10);
    EXPECT_LT((t.normal - s.normal).norm(), 1e-12);
  }
}

TEST_P(AnalyticModelOf, AnyKindMeetsTheLineAlongItsNormalAtTheFoot) {
  for (const Vec3& x : points(100)) {
    const Projection foot = projector->closest(k_face, x);
    if (foot.status != ProjectionStatus::inside || foot.distance < 1e-3) continue;
    const Vec3 d = 3.0 * (foot.point - x);
    const auto hit = projector->along_line(1, x, d, 1.01 * foot.distance);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, foot.distance, 1e-9);
    EXPECT_LT((hit->point - foot.point).norm(), 1e-6);
    EXPECT_FALSE(projector->along_line(1, x, d, 0.5 * foot.distance));
  }
}

INSTANTIATE_TEST_SUITE_P(Any, AnalyticModelOf, testing::ValuesIn(k_samples),
                         [](const auto& sample) { return std::string(sample.param.name); });

TEST(MakeSphere, ProjectsAlongTheRadius) {
  const auto model = make_sphere({1, 0, 0}, 2.0);
  const Projection p = model->projector()->closest(k_face, {1, 3, 0});
  EXPECT_NEAR(p.distance, 1.0, 1e-15);
  EXPECT_LT((p.point - Vec3(1, 2, 0)).norm(), 1e-15);
  EXPECT_NEAR(p.uv[0], 0.5 * std::numbers::pi, 1e-15);
  EXPECT_EQ(p.status, ProjectionStatus::inside);
}

TEST(MakeSphere, AnswersAtItsCentreAndReturnsTheSeedsSideOfTheSeam) {
  const auto model = make_sphere({0, 0, 0}, 1.0);
  const auto projector = model->projector();
  EXPECT_DOUBLE_EQ(projector->closest(k_face, {0, 0, 0}).distance, 1.0);
  const Projection p = projector->closest(k_face, {2, -0.01, 0}, Vec2(0.01, 0.0));
  EXPECT_NEAR(p.uv[0], -0.005, 1e-6);
  EXPECT_EQ(projector->closest(k_face, {NAN, 0, 0}).status, ProjectionStatus::failed);
}

TEST(MakeEllipsoid, AnswersOnAxesPlanesAndInsideTheEvolute) {
  const auto model = make_ellipsoid({0, 0, 0}, {3, 2, 1});
  const auto projector = model->projector();
  // The centre is nearest to the ends of the shortest axis.
  EXPECT_NEAR(projector->closest(k_face, {0, 0, 0}).distance, 1.0, 1e-15);
  // On the long axis inside the evolute (|x| < 3 - 1/3): x leaves the axis, y_0 = 9 x / 8.
  const Projection p = projector->closest(k_face, {1, 0, 0});
  EXPECT_NEAR(p.point[0], 9.0 / 8.0, 1e-14);
  EXPECT_NEAR(std::abs(p.point[2]), std::sqrt(1.0 - 9.0 / 64.0), 1e-14);
  // Beyond the evolute it stays on the axis.
  EXPECT_NEAR(projector->closest(k_face, {2.9, 0, 0}).distance, 0.1, 1e-14);
  EXPECT_NEAR(projector->closest(k_face, {0, 5, 0}).distance, 3.0, 1e-14);
  EXPECT_NEAR(projector->closest(k_face, {0, 0, -1e-300}).distance, 1.0, 1e-15);
}

TEST(MakePlane, ClampsToItsRectangle) {
  const auto model = make_plane({0, 0, 0}, {1, 0, 0}, {0, 2, 0});
  const Projection p = model->projector()->closest(k_face, {4, 6, 0});
  EXPECT_DOUBLE_EQ(p.distance, 5.0);  // to the corner (1, 2, 0): 3, 4
  EXPECT_EQ(p.status, ProjectionStatus::boundary);
  EXPECT_TRUE(model->is_planar(1));
  EXPECT_THROW(make_plane({0, 0, 0}, {1, 0, 0}, {1, 1, 0}), GeometryError);
}

TEST(AnalyticModel, HasOneFaceAndNothingElse) {
  const auto model = make_torus({0, 0, 0}, {0, 0, 1}, 2, 1);
  EXPECT_EQ(model->count(2), 1);
  EXPECT_EQ(model->count(1), 0);
  EXPECT_EQ(model->count(0), 0);
  EXPECT_TRUE(model->curves_of_face(1).empty());
  EXPECT_THROW(static_cast<void>(model->range(1)), GeometryError);
  EXPECT_THROW(static_cast<void>(model->projector()->closest({1, 1}, Vec3::Zero())), GeometryError);
  EXPECT_THROW(static_cast<void>(model->box({2, 2})), GeometryError);
  EXPECT_THROW(model->set_scale(0.0), GeometryError);
}

TEST(ProjectToGroup, TakesTheNearestMemberAndFailsOnNone) {
  const auto model = make_sphere({0, 0, 0}, 1.0);
  const auto projector = model->projector();
  EXPECT_EQ(project_to_group(*projector, {}, {2, 0, 0}).status, ProjectionStatus::failed);
  const Projection p = project_to_group(*projector, {k_face}, {2, 0, 0});
  EXPECT_DOUBLE_EQ(p.distance, 1.0);
  EXPECT_EQ(p.entity, k_face);
}

}  // namespace
}  // namespace camber
