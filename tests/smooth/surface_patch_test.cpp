#include <camber/basis/lagrange.hpp>
#include <camber/smooth/detail/sliding_nodes.hpp>
#include <camber/smooth/detail/surface_energy.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "sphere_patch.hpp"

namespace camber {
namespace {

using testing::on_sphere;
using testing::shake;
using testing::sphere_patch;

/// Least (dx/dxi x dx/deta) . n over a fine lattice of every face, by plain evaluation.
double least_orientation(const SurfacePatch& patch) {
  double least = 1e300;
  for (const SurfaceFace& face : patch.faces) {
    std::vector<Vec3> dN(face.nodes.size());
    for (const Vec3& xi : lattice_xi(face.shape, 3 * patch.order)) {
      lagrange_gradients(face.shape, patch.order, xi, dN);
      Vec3 a = Vec3::Zero(), b = Vec3::Zero(), x = Vec3::Zero();
      for (std::size_t i = 0; i < dN.size(); ++i) {
        a += dN[i].x() * patch.nodes[at(face.nodes[i])];
        b += dN[i].y() * patch.nodes[at(face.nodes[i])];
        x += patch.nodes[at(face.nodes[i])];
      }
      const double side = face.corner_normal[0].dot(x) > 0.0 ? 1.0 : -1.0;
      least = std::min(least, side * a.cross(b).dot(x.normalized()));
    }
  }
  return least;
}

TEST(SurfaceEnergy, IsOneAFaceAndALittleMoreForTheLatticeOnAFlatPatch) {
  SurfacePatch patch = sphere_patch(3, false, 1e-4);

  const detail::SurfaceEnergy energy(patch);
  Points slope(patch.nodes.size(), Vec3::Zero());

  // T is a rotation in the plane: |T|^2 / (2 tau) = 1 at every sample; weights sum to 1 + 0.1.
  EXPECT_NEAR(energy.evaluate(patch.nodes, 0.0, slope), 1.1 * 4.0, 1e-6);
  EXPECT_NEAR(energy.least_tau(patch.nodes), 1.0, 1e-6);
}

TEST(SurfaceEnergy, IsInfiniteWhereAFaceIsFoldedAndFiniteWithRegularisation) {
  SurfacePatch patch = sphere_patch(2, true, 0.4);
  shake(patch, 0.5, 1);
  const detail::SurfaceEnergy energy(patch);
  Points slope(patch.nodes.size(), Vec3::Zero());
  ASSERT_LT(energy.least_tau(patch.nodes), 0.0);
  EXPECT_TRUE(std::isinf(energy.evaluate(patch.nodes, 0.0, slope)));
  EXPECT_TRUE(std::isfinite(energy.evaluate(patch.nodes, 0.2, slope)));
}

TEST(SurfaceEnergy, HasTheSlopeOfItsDifferencesThroughTheSurfaceParameters) {
  for (const bool is_triangles : {true, false}) {
    for (const double delta : {0.0, 0.3}) {
      SurfacePatch patch = sphere_patch(3, is_triangles, 0.5);
      shake(patch, delta > 0.0 ? 0.2 : 0.02, 2);
      const OnSurface surface = on_sphere;
      const detail::SurfaceEnergy energy(patch);
      detail::SlidingNodes sliding(patch, surface);
      std::mt19937 random(3);
      std::normal_distribution<double> normal;
      const auto value = [&](const VecX& t, VecX* gradient) {
        Points slope(patch.nodes.size(), Vec3::Zero());
        const double e = energy.evaluate(sliding.place(t), delta, slope);
        if (gradient) sliding.pull_back(slope, *gradient);
        return e;
      };
      VecX gradient, t(sliding.size());
      for (double& x : t) x = 0.003 * normal(random);
      value(t, &gradient);
      for (int trial = 0; trial < 5; ++trial) {
        VecX d(t.size());
        for (double& x : d) x = normal(random);
        const double h = 1e-6;
        const double difference = (value(t + h * d, nullptr) - value(t - h * d, nullptr)) / (2 * h);
        EXPECT_NEAR(gradient.dot(d), difference, 1e-6 * (1.0 + gradient.norm()));
      }
    }
  }
}

TEST(SlidingNodes, MoveInUnitsOfLengthAtTheStart) {
  SurfacePatch patch = sphere_patch(2, false, 0.9);
  const OnSurface surface = on_sphere;
  detail::SlidingNodes sliding(patch, surface);
  const Points before = sliding.place(VecX::Zero(sliding.size()));
  VecX t = VecX::Zero(sliding.size());
  t[0] = 1e-7;
  const Points after = sliding.place(t);
  double moved = 0.0;
  for (std::size_t i = 0; i < before.size(); ++i) moved += (after[i] - before[i]).norm();
  EXPECT_NEAR(moved, 1e-7, 1e-12);
}

TEST(SlidingNodes, LeavesThePolesOfTheSurfaceAlone) {
  SurfacePatch patch = sphere_patch(2, false, 0.5);
  const std::size_t free =
      static_cast<std::size_t>(std::count(patch.is_free.begin(), patch.is_free.end(), 1));
  patch.uv[static_cast<std::size_t>(std::find(patch.is_free.begin(), patch.is_free.end(), 1) -
                                    patch.is_free.begin())] = Vec2(0.0, 0.5 * M_PI);
  const OnSurface surface = on_sphere;
  EXPECT_EQ(detail::SlidingNodes(patch, surface).size(), 2 * static_cast<Eigen::Index>(free - 1));
}

TEST(SmoothSurface, UnfoldsFacesHoweverTheyAreWalkedAndStaysOnTheSurface) {
  for (const bool is_triangles : {true, false}) {
    for (int order = 2; order <= 4; ++order) {
      for (unsigned seed = 1; seed <= 4; ++seed) {
        SurfacePatch patch = sphere_patch(order, is_triangles, 0.5);
        const Points border = patch.nodes;
        shake(patch, 0.5 / order, seed);
        if (least_orientation(patch) > 0.0) continue;

        ASSERT_TRUE(smooth_surface(patch, on_sphere)) << order << " seed " << seed;

        EXPECT_GT(least_orientation(patch), 0.0);
        for (std::size_t i = 0; i < patch.nodes.size(); ++i) {
          EXPECT_NEAR(patch.nodes[i].norm(), 1.0, 1e-14);
          if (!patch.is_free[i]) {
            EXPECT_EQ(patch.nodes[i], border[i]);
          }
        }
      }
    }
  }
}

TEST(SmoothSurface, PutsEverythingBackWhereTheBorderItselfIsFolded) {
  SurfacePatch patch = sphere_patch(2, false, 0.5);
  // The middle of the lower border edge, pulled beyond its end: no inner node can mend that.
  patch.nodes[1] = on_sphere(0, {-0.9, -0.5}).point;
  const Points before = patch.nodes;
  const std::vector<Vec2> uv = patch.uv;

  EXPECT_FALSE(smooth_surface(patch, on_sphere));

  EXPECT_EQ(patch.nodes, before);
  EXPECT_EQ(patch.uv, uv);
}

}  // namespace
}  // namespace camber
