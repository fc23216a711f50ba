#include <camber/elevate/rescue.hpp>
#include <camber/geom/analytic_model.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "layer_meshes.hpp"

namespace camber {
namespace {

using namespace testing;

std::unique_ptr<Case> sphere() {
  return make_case(layers_on(icosphere(1), {0.0, 0.05, 0.2, 0.6},
                             [](const Vec3& x) -> Vec3 { return x.normalized(); }),
                   make_sphere(Vec3::Zero(), 1.0), 2);
}

void shake(std::span<Vec3> nodes, double size, std::mt19937& random) {
  std::uniform_real_distribution<double> value(-size, size);
  for (Vec3& x : nodes) x += Vec3(value(random), value(random), value(random));
}

TEST(Rescue, AlwaysEndsCertifiedHoweverTangledTheStart) {
  const auto c = sphere();
  for (double size : {0.05, 1.0, 100.0}) {
    std::mt19937 random(5);
    CurvedMesh curved = c->straight(3);
    for (Index e = 0; at(e) < c->topology.edge_count(); ++e) {
      shake(curved.edge_nodes(e), size, random);
    }
    for (Index f = 0; at(f) < c->topology.face_count(); ++f) {
      shake(curved.face_nodes(f), size, random);
    }
    const std::vector<Index> bad = uncertified_cells(curved, all_cells(c->mesh));
    ASSERT_FALSE(bad.empty());

    const RescueResult result = scale_back(curved, bad);

    EXPECT_TRUE(uncertified_cells(curved, all_cells(c->mesh)).empty());
    EXPECT_GT(result.passes, 0);
    ASSERT_EQ(result.kept.size(), result.scaled_back.size());
    EXPECT_TRUE(std::includes(result.scaled_back.begin(), result.scaled_back.end(), bad.begin(),
                              bad.end()));
    for (double kept : result.kept) {
      EXPECT_GE(kept, 0.0);
      EXPECT_LE(kept, 0.5);
    }
  }
}

TEST(Rescue, HalvesOneBadEdgeUntilItsCellsAreValid) {
  // One edge is pulled away by hand; what is left of it is a power of two, the rest is as it was.
  const auto c = sphere();
  CurvedMesh curved = c->straight(2);
  const Index e = c->topology.edges_of_cell(10)[0];
  const Vec3 straight = curved.edge_nodes(e)[0], pull(0.9, -0.4, 0.7);
  curved.edge_nodes(e)[0] += pull;

  const RescueResult result = scale_back(curved, uncertified_cells(curved, all_cells(c->mesh)));

  const Vec3 left = curved.edge_nodes(e)[0] - straight;
  const double share = left.norm() / pull.norm();
  EXPECT_NEAR(std::log2(share), std::round(std::log2(share)), 1e-9);
  EXPECT_LT((left - share * pull).norm(), 1e-14);
  EXPECT_TRUE(uncertified_cells(curved, all_cells(c->mesh)).empty());
  const CurvedMesh reference = c->straight(2);
  for (Index other = 0; at(other) < c->topology.edge_count(); ++other) {
    if (other != e) {
      EXPECT_EQ(curved.edge_nodes(other)[0], reference.edge_nodes(other)[0]);
    }
  }
  EXPECT_FALSE(result.scaled_back.empty());
}

TEST(Rescue, LeavesAValidMeshAlone) {
  const auto c = sphere();
  CurvedMesh curved = c->straight(2);

  const RescueResult result = scale_back(curved, {});

  EXPECT_TRUE(result.scaled_back.empty());
  EXPECT_EQ(result.passes, 0);
}

}  // namespace
}  // namespace camber
