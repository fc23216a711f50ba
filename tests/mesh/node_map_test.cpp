#include <camber/mesh/node_map.hpp>

#include <random>

#include <gtest/gtest.h>

#include "../support/cube_mesh.hpp"
#include "../support/random_nodes.hpp"

namespace camber {
namespace {

using testing::cube_mesh;
using testing::k_fillings;
using testing::random_orders;
using testing::shake;

std::vector<Index> all_cells(const LinearMesh& mesh) {
  std::vector<Index> cells(mesh.cell_count());
  for (std::size_t c = 0; c < cells.size(); ++c) cells[c] = static_cast<Index>(c);
  return cells;
}

TEST(NodeMap, GivesTheNodesThatGatherGives) {
  std::mt19937 random(5);
  for (const testing::Filling filling : k_fillings) {
    const LinearMesh mesh = build_linear_mesh(cube_mesh(filling, 2, 3));
    const Topology topology = build_topology(mesh);
    CurvedMesh curved(mesh, topology,
                      minimum_rule(topology, random_orders(mesh.cell_count(), 4, random)));
    shake(curved, 0.1, random);
    const NodeMap map(curved, all_cells(mesh));
    Points nodes;
    for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
      curved.gather(static_cast<Index>(c), curved.cell_order(static_cast<Index>(c)), nodes);
      ASSERT_EQ(map.node_total(c), nodes.size());
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        Vec3 x = Vec3::Zero();
        double sum = 0.0;
        for (const NodeMap::Entry& e : map.row(c, n)) {
          const std::size_t column = at(e.column), vertices = mesh.vertices.size();
          x += e.coefficient * (column < vertices ? mesh.vertices[column]
                                                  : curved.high_order_nodes()[column - vertices]);
          sum += e.coefficient;
        }
        EXPECT_LT((x - nodes[n]).norm(), 1e-14);
        EXPECT_NEAR(sum, 1.0, 1e-13);
      }
    }
  }
}

TEST(NodeMap, HasOneEntryANodeWhereAllOrdersAreEqual) {
  const LinearMesh mesh = build_linear_mesh(cube_mesh(testing::Filling::hybrid, 2, 3));
  const Topology topology = build_topology(mesh);
  const CurvedMesh curved(
      mesh, topology,
      minimum_rule(topology, std::vector<std::uint8_t>(mesh.cell_count(), std::uint8_t{3})));
  const NodeMap map(curved, all_cells(mesh));
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    for (std::size_t n = 0; n < map.node_total(c); ++n) {
      ASSERT_EQ(map.row(c, n).size(), 1u);
      EXPECT_EQ(map.row(c, n)[0].coefficient, 1.0);
    }
  }
}

}  // namespace
}  // namespace camber
