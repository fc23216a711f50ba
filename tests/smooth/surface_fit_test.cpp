#include <camber/basis/quadrature.hpp>
#include <camber/smooth/detail/surface_distance.hpp>
#include <camber/smooth/surface_fit.hpp>

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "sphere_patch.hpp"

namespace camber {
namespace {

using testing::on_sphere;
using testing::shake;
using testing::sphere_patch;

void nearest_on_sphere(std::span<const Index>, const Points& points, Points& feet) {
  for (std::size_t i = 0; i < points.size(); ++i) feet[i] = points[i].normalized();
}

/// int (|x| - 1)^2 ds over all faces at the sixth-order Gauss points, ds of the straight faces.
double squared_distance(const SurfacePatch& patch) {
  double sum = 0.0;
  for (const SurfaceFace& face : patch.faces) {
    const Quadrature& rule = sixth_order(face.shape);
    Points nodes;
    for (Index n : face.nodes) nodes.push_back(patch.nodes[at(n)]);
    for (std::size_t g = 0; g < rule.points.size(); ++g) {
      const Mat3 J = jacobian(face.shape, patch.order, face.straight, rule.points[g]);
      const double d = evaluate(face.shape, patch.order, nodes, rule.points[g]).norm() - 1.0;
      sum += rule.weights[g] * J.col(0).cross(J.col(1)).norm() * d * d;
    }
  }
  return sum;
}

TEST(SurfaceDistance, IsTheSumByPlainEvaluation) {
  for (const bool is_triangles : {true, false}) {
    SurfacePatch patch = sphere_patch(2, is_triangles, 0.5);
    shake(patch, 0.05, 1);
    const NearestPoints nearest = nearest_on_sphere;
    detail::SurfaceDistance distance(patch, nearest);
    Points slope(patch.nodes.size(), Vec3::Zero());
    const double expected = squared_distance(patch);
    EXPECT_NEAR(distance.evaluate(patch.nodes, slope), expected, 1e-14 * expected);
  }
}

TEST(SurfaceDistance, HasTheSlopeOfItsDifferences) {
  SurfacePatch patch = sphere_patch(3, true, 0.5);
  shake(patch, 0.05, 2);
  const NearestPoints nearest = nearest_on_sphere;
  detail::SurfaceDistance distance(patch, nearest);
  distance.weigh_by_start();
  Points slope(patch.nodes.size(), Vec3::Zero()), unused = slope;
  distance.evaluate(patch.nodes, slope);
  std::mt19937 random(3);
  std::normal_distribution<double> normal;
  for (int trial = 0; trial < 5; ++trial) {
    const double h = 1e-6;
    Points plus = patch.nodes, minus = patch.nodes;
    double expected = 0.0;
    for (std::size_t i = 0; i < plus.size(); ++i) {
      const Vec3 d(normal(random), normal(random), normal(random));
      plus[i] += h * d;
      minus[i] -= h * d;
      expected += slope[i].dot(d);
    }
    const double difference =
        (distance.evaluate(plus, unused) - distance.evaluate(minus, unused)) / (2.0 * h);
    EXPECT_NEAR(difference, expected, 1e-5 * std::abs(expected));
  }
}

TEST(FitSurface, BringsFacesNearerAndKeepsNodesOnTheSurface) {
  for (const bool is_triangles : {true, false}) {
    for (int order = 2; order <= 4; ++order) {
      SurfacePatch patch = sphere_patch(order, is_triangles, 0.5);
      const double before = squared_distance(patch);

      const SurfaceFit fit = fit_surface(patch, on_sphere, nearest_on_sphere);

      EXPECT_LT(fit.after, fit.before);
      EXPECT_LT(squared_distance(patch), before);
      for (const Vec3& x : patch.nodes) EXPECT_NEAR(x.norm(), 1.0, 1e-14);
    }
  }
}

TEST(FitSurface, GainsMostAtOddOrders) {
  // A cubic with evenly spread nodes converges as h^4 only; with free nodes it does much better.
  SurfacePatch patch = sphere_patch(3, false, 0.5);
  const SurfaceFit fit = fit_surface(patch, on_sphere, nearest_on_sphere);
  EXPECT_LT(fit.after, 0.5 * fit.before);
}

TEST(FitSurface, LeavesFacesAloneThatAreGoodEnough) {
  SurfacePatch patch = sphere_patch(3, false, 0.5);
  for (SurfaceFace& face : patch.faces) face.good_enough = 1.0;
  const Points before = patch.nodes;

  fit_surface(patch, on_sphere, nearest_on_sphere);

  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_LT((patch.nodes[i] - before[i]).norm(), 1e-3);
  }
}

TEST(FitSurface, RefusesAFoldedPatch) {
  SurfacePatch patch = sphere_patch(2, true, 0.4);
  shake(patch, 0.5, 1);
  const Points before = patch.nodes;

  const SurfaceFit fit = fit_surface(patch, on_sphere, nearest_on_sphere);

  EXPECT_EQ(fit.after, fit.before);
  EXPECT_EQ(patch.nodes, before);
}

}  // namespace
}  // namespace camber
