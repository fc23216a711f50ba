#include <camber/base/parallel.hpp>
#include <camber/smooth/patch.hpp>
#include <camber/validity/element_validity.hpp>

#include <algorithm>

#include <gtest/gtest.h>

#include "../support/cube_mesh.hpp"
#include "../support/random_nodes.hpp"

namespace camber {
namespace {

using testing::cube_mesh;
using testing::Filling;
using testing::shake;

std::vector<Index> bad_cells(const CurvedMesh& curved) {
  std::vector<Index> bad;
  Points nodes;
  for (Index c = 0; at(c) < curved.linear().cell_count(); ++c) {
    curved.gather(c, curved.cell_order(c), nodes);
    if (quick_verdict(curved.linear().cell_shape[at(c)], curved.cell_order(c), nodes) !=
        Verdict::valid) {
      bad.push_back(c);
    }
  }
  return bad;
}

/// All high-order nodes; with `fixed` only those that must stay.
Points snapshot(const CurvedMesh& curved, const FixedEntities* fixed = nullptr) {
  Points all;
  const auto add = [&](std::span<const Vec3> nodes) {
    all.insert(all.end(), nodes.begin(), nodes.end());
  };
  for (Index e = 0; at(e) < curved.topology().edge_count(); ++e) {
    if (!fixed || fixed->edge[at(e)]) add(curved.edge_nodes(e));
  }
  for (Index f = 0; at(f) < curved.topology().face_count(); ++f) {
    if (!fixed || fixed->face[at(f)]) add(curved.face_nodes(f));
  }
  if (fixed) return all;
  for (Index c = 0; at(c) < curved.linear().cell_count(); ++c) add(curved.cell_nodes(c));
  return all;
}

struct Cube {
  LinearMesh mesh;
  Topology topology;
  FixedEntities fixed;

  explicit Cube(unsigned seed, Filling filling = Filling::hybrid)
      : mesh(build_linear_mesh(cube_mesh(filling, 2, seed))),
        topology(build_topology(mesh)),
        fixed(boundary_entities(topology)) {}
  Cube(const Cube&) = delete;
  Cube& operator=(const Cube&) = delete;

  [[nodiscard]] CurvedMesh curved(int order) const {
    const auto p = static_cast<std::uint8_t>(order);
    return {mesh, topology,
            minimum_rule(topology, std::vector<std::uint8_t>(mesh.cell_count(), p))};
  }
  /// An edge (face) inside the cube, or on its surface.
  [[nodiscard]] Index edge(bool on_surface) const {
    const auto found = std::find(fixed.edge.begin(), fixed.edge.end(), on_surface ? 1 : 0);
    return static_cast<Index>(found - fixed.edge.begin());
  }
};

TEST(BoundaryEntities, AreAllThatLiesOnTheSurface) {
  const Cube cube(1, Filling::hexes);

  // 24 of the 36 faces; edges of 6 sides: 4 * 12 on their borders / 2 + 4 inside each = 48.
  EXPECT_EQ(std::count(cube.fixed.face.begin(), cube.fixed.face.end(), 1), 24);
  EXPECT_EQ(std::count(cube.fixed.edge.begin(), cube.fixed.edge.end(), 1), 48);
}

TEST(Untangle, BringsBackANodeThatWasThrownOver) {
  for (int order = 2; order <= 4; ++order) {
    const Cube cube(static_cast<unsigned>(order));
    CurvedMesh curved = cube.curved(order);
    std::mt19937 random(5);
    shake(curved, 0.002, random);
    curved.edge_nodes(cube.edge(false))[0] += Vec3(0.4, -0.3, 0.35);
    const std::vector<Index> bad = bad_cells(curved);
    ASSERT_FALSE(bad.empty());
    const Points wall = snapshot(curved, &cube.fixed);

    const UntangleResult result = untangle(curved, bad);

    EXPECT_EQ(result.patches, 1u);
    EXPECT_EQ(result.repaired, 1u);
    EXPECT_TRUE(result.still_bad.empty());
    EXPECT_TRUE(bad_cells(curved).empty()) << "order " << order;
    EXPECT_EQ(snapshot(curved, &cube.fixed), wall);
  }
}

TEST(Untangle, MakesRoomForASurfaceThatBulgesInwards) {
  // Free nodes must follow: with them straight the cells at the bulge are inverted.
  const Cube cube(6, Filling::hexes);
  CurvedMesh curved = cube.curved(2);
  Index face = 0;
  while (!cube.topology.is_boundary(face)) ++face;
  const Index cell = cube.topology.face2cell[at(face)][0];
  Vec3 inwards = Vec3::Zero();
  for (Index v : cube.mesh.cell(cell)) inwards += cube.mesh.vertices[at(v)] / 8.0;
  inwards -= curved.face_nodes(face)[0];
  curved.face_nodes(face)[0] += 1.2 * inwards;
  const std::vector<Index> bad = bad_cells(curved);
  ASSERT_EQ(bad, std::vector<Index>{cell});
  const Points wall = snapshot(curved, &cube.fixed);

  const UntangleResult result = untangle(curved, bad);

  EXPECT_EQ(result.repaired, 1u);
  EXPECT_TRUE(bad_cells(curved).empty());
  EXPECT_EQ(snapshot(curved, &cube.fixed), wall);
}

TEST(Untangle, PutsBackToTheLastBitWhatItCannotRepair) {
  for (int order : {2, 3}) {
    const Cube cube(8);
    CurvedMesh curved = cube.curved(order);
    std::mt19937 random(6);
    shake(curved, 0.002, random);
    // A surface edge that runs out beyond its own end and back: no cell on it can be valid.
    const Index e = cube.edge(true);
    const Vec3 along = cube.mesh.vertices[at(cube.topology.edge2vertex[at(e)][1])] -
                       cube.mesh.vertices[at(cube.topology.edge2vertex[at(e)][0])];
    curved.edge_nodes(e)[0] -= along;
    const std::vector<Index> bad = bad_cells(curved);
    ASSERT_FALSE(bad.empty());
    const Points before = snapshot(curved);
    UntangleOptions options;
    options.rings = 1;
    options.iterations_per_round = 5;

    const UntangleResult result = untangle(curved, bad, options);

    EXPECT_EQ(result.repaired, 0u);
    EXPECT_EQ(result.still_bad, bad);
    EXPECT_EQ(snapshot(curved), before);
  }
}

TEST(Untangle, LeavesPatchesAloneThatAreTooLarge) {
  const Cube cube(9);
  CurvedMesh curved = cube.curved(2);
  curved.edge_nodes(cube.edge(false))[0] += Vec3(0.4, -0.3, 0.35);
  const std::vector<Index> bad = bad_cells(curved);
  ASSERT_FALSE(bad.empty());
  const Points before = snapshot(curved);
  UntangleOptions options;
  options.max_cells = 1;

  const UntangleResult result = untangle(curved, bad, options);

  EXPECT_EQ(result.still_bad, bad);
  EXPECT_EQ(snapshot(curved), before);
}

TEST(Untangle, OfNothingDoesNothing) {
  const Cube cube(10);
  CurvedMesh curved = cube.curved(3);
  const Points before = snapshot(curved);

  const UntangleResult result = untangle(curved, {});

  EXPECT_EQ(result.patches, 0u);
  EXPECT_EQ(snapshot(curved), before);
}

TEST(Untangle, RepairsAMeshOfMixedOrdersToTheSameBitsForAnyNumberOfThreads) {
  const Cube cube(11);
  std::mt19937 random(7);
  std::vector<std::uint8_t> orders(cube.mesh.cell_count());
  for (std::uint8_t& p : orders) p = static_cast<std::uint8_t>(2 + random() % 3);
  std::vector<Points> results;
  for (int threads : {1, 2, 4, 1}) {
    const ThreadLimit limit(threads);
    CurvedMesh curved(cube.mesh, cube.topology, minimum_rule(cube.topology, orders));
    curved.edge_nodes(cube.edge(false))[0] += Vec3(0.4, -0.3, 0.35);
    const UntangleResult result = untangle(curved, bad_cells(curved));
    EXPECT_EQ(result.repaired, 1u);
    EXPECT_TRUE(bad_cells(curved).empty());
    results.push_back(snapshot(curved));
  }
  for (std::size_t i = 1; i < results.size(); ++i) EXPECT_EQ(results[i], results[0]);
}

}  // namespace
}  // namespace camber
