#include <camber/geom/analytic_surface.hpp>
#include <camber/geom/surface_tree.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace camber {
namespace {

constexpr double k_pi = std::numbers::pi;
constexpr double k_infinity = std::numeric_limits<double>::infinity();

Vec3 random_point(std::mt19937& random, double half_width) {
  std::uniform_real_distribution<double> uniform(-half_width, half_width);
  return {uniform(random), uniform(random), uniform(random)};
}

double nearest(const SurfaceTree& tree, const Vec3& x) {
  double best = k_infinity;
  tree.feet(
      x, [&] { return best; },
      [&](const SurfaceFoot& foot) { best = std::min(best, foot.distance_squared); });
  return std::sqrt(best);
}

class SurfaceTreeOf : public testing::TestWithParam<int> {
 protected:
  static std::unique_ptr<AnalyticSurface> make() {
    switch (GetParam()) {
      case 0:
        return ellipsoid_surface({0, 0, 0}, {1, 1, 1});
      case 1:
        return ellipsoid_surface({0.1, 0, 0}, {2, 1, 0.3});
      case 2:
        return torus_surface({0, 0.2, 0}, {1, 1, 0}, 1.0, 0.4);
      case 3:
        return cylinder_surface({0, 0, -1}, {0.1, 0, 2}, 0.7);
      default:
        return plane_surface({-1, -1, 0}, {2, 0, 0}, {0, 1, 1});
    }
  }
};

TEST_P(SurfaceTreeOf, AnalyticSurfacesFindsTheExactDistance) {
  const auto surface = make();
  const SurfaceTree tree(*surface, surface->domain());
  std::mt19937 random(5);
  for (int k = 0; k < 300; ++k) {
    const Vec3 x = random_point(random, 2.0);
    EXPECT_NEAR(nearest(tree, x), std::sqrt(surface->closest(x, {}).distance_squared), 1e-12);
  }
}

TEST_P(SurfaceTreeOf, AnalyticSurfacesHasBoxesThatHoldTheSurface) {
  const auto surface = make();
  const SurfaceTree tree(*surface, surface->domain());
  const UvBox domain = surface->domain();
  for (int i = 0; i <= 60; ++i) {
    for (int j = 0; j <= 60; ++j) {
      const Vec2 uv = domain.lower + Vec2(i, j).cwiseProduct(domain.upper - domain.lower) / 60.0;
      const Vec3 s = surface->jet(uv).s;
      EXPECT_LT(nearest(tree, s), 1e-12);
      EXPECT_EQ(distance_squared(tree.box(), s), 0.0);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(All, SurfaceTreeOf, testing::Range(0, 5));

TEST(SurfaceTree, FindsBothCrossingsOfALineAndASphere) {
  const auto sphere = ellipsoid_surface({0, 0, 0}, {1, 1, 1});
  const SurfaceTree tree(*sphere, sphere->domain());
  // x = (0.5, 0.6, z): crossings at z = -+ sqrt(1 - 0.61).
  const Vec3 x(0.5, 0.6, 0.0), d(0, 0, 1);
  double low = 0.0, high = 0.0;
  tree.crossings(
      x, d, [] { return 2.0; },
      [&](const SurfaceFoot& foot) {
        if (foot.distance_squared > 1e-20) return;
        low = std::min(low, foot.point[2]);
        high = std::max(high, foot.point[2]);
      });
  EXPECT_NEAR(high, std::sqrt(0.39), 1e-12);
  EXPECT_NEAR(low, -std::sqrt(0.39), 1e-12);
}

TEST(FindFoot, OfAnEllipsoidIsOrthogonalAndStationary) {
  const auto surface = ellipsoid_surface({0, 0, 0}, {2, 1, 0.5});
  std::mt19937 random(6);
  std::uniform_real_distribution<double> longitude(0.0, 6.2), latitude(-1.4, 1.4);
  for (int k = 0; k < 200; ++k) {
    const Vec2 uv(longitude(random), latitude(random));
    const SurfaceJet jet = surface->jet(uv);
    const Vec3 x = jet.s + 0.1 * jet.su.cross(jet.sv).normalized();
    const SurfaceFoot foot = find_foot(*surface, x, uv + Vec2(0.02, -0.02), surface->domain(), 4.0);
    EXPECT_TRUE(foot.is_converged);
    EXPECT_LT((foot.point - jet.s).norm(), 1e-13);
    EXPECT_LT(foot.tangential, 1e-12);
  }
}

TEST(FindFoot, NeverGoesUp) {
  const auto surface = torus_surface({0, 0, 0}, {0, 0, 1}, 1.0, 0.3);
  std::mt19937 random(16);
  std::uniform_real_distribution<double> angle(0.0, 2.0 * k_pi);
  for (int k = 0; k < 300; ++k) {
    const Vec3 x = random_point(random, 3.0);
    const Vec2 start(angle(random), angle(random));
    const SurfaceFoot foot = find_foot(*surface, x, start, surface->domain(), 2.0);
    EXPECT_LE(foot.distance_squared, (surface->jet(start).s - x).squaredNorm() * (1.0 + 1e-14));
    EXPECT_TRUE(foot.is_converged);
  }
}

TEST(FindFoot, StopsAtTheLimitsAndSaysHowFarItWantedToGo) {
  const auto plane = plane_surface({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const SurfaceFoot foot = find_foot(*plane, {1.5, 0.5, 2.0}, {0.5, 0.5}, plane->domain(), 1.0);
  EXPECT_TRUE(foot.is_converged);
  EXPECT_LT((foot.point - Vec3(1.0, 0.5, 0.0)).norm(), 1e-15);
  EXPECT_NEAR(foot.tangential, 0.5, 1e-15);
}

TEST(FindFoot, EndsAtThePoleOfASphereWithoutNan) {
  const auto sphere = ellipsoid_surface({0, 0, 0}, {1, 1, 1});
  const SurfaceFoot foot = find_foot(*sphere, {0, 0, 2}, {1.0, 1.2}, sphere->domain(), 2.0);
  EXPECT_TRUE(foot.is_converged);
  EXPECT_LT((foot.point - Vec3(0, 0, 1)).norm(), 1e-12);
  const SurfaceFoot from_pole =
      find_foot(*sphere, {0, 0, 2}, {1.0, 0.5 * k_pi}, sphere->domain(), 2.0);
  EXPECT_LT((from_pole.point - Vec3(0, 0, 1)).norm(), 1e-12);
}

TEST(UnitNormal, AtThePoleOfASphereIsItsAxisAndAtATipOfAConeZero) {
  const auto sphere = ellipsoid_surface({0, 0, 0}, {1, 2, 3});
  const Vec2 pole(0.3, 0.5 * k_pi);
  const Vec3 normal = unit_normal(*sphere, sphere->domain(), pole, sphere->jet(pole));
  EXPECT_LT((normal - Vec3(0, 0, 1)).norm(), 1e-7);

  // Ruled B-spline with one side shrunk to a point and the other a bent line: a cone.
  const Vec3 poles[6] = {{0, 0, 1}, {0, 0, 1}, {0, 0, 1}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const BsplineSurface cone(BsplineBasis(1, {0, 0, 1, 1}), BsplineBasis(2, {0, 0, 0, 1, 1, 1}),
                            poles);
  const Vec2 tip(0.0, 0.4);
  EXPECT_EQ(unit_normal(cone, cone.domain(), tip, cone.jet(tip)).norm(), 0.0);
}

}  // namespace
}  // namespace camber
