#include <camber/mesh/raise_orders.hpp>

#include <gtest/gtest.h>

#include "../support/cube_mesh.hpp"
#include "../support/random_nodes.hpp"

namespace camber {
namespace {

struct Cube {
  LinearMesh mesh;
  Topology topology;
  std::mt19937 random{11};

  Cube()
      : mesh(build_linear_mesh(testing::cube_mesh(testing::Filling::hybrid, 2, 4))),
        topology(build_topology(mesh)) {}
  Cube(const Cube&) = delete;
  Cube& operator=(const Cube&) = delete;

  CurvedMesh shaken(std::vector<std::uint8_t> orders) {
    CurvedMesh curved(mesh, topology, minimum_rule(topology, std::move(orders)));
    testing::shake(curved, 0.05, random);
    return curved;
  }
};

TEST(RaiseOrders, LeavesEveryShapeAsItIs) {
  Cube cube;
  const CurvedMesh curved =
      cube.shaken(testing::random_orders(cube.mesh.cell_count(), 3, cube.random));
  std::vector<std::uint8_t> orders = curved.orders().cell;
  for (std::uint8_t& p : orders) p = static_cast<std::uint8_t>(p + cube.random() % 2);

  const CurvedMesh raised = raise_orders(curved, orders);

  EXPECT_EQ(raised.orders().cell, orders);
  Points before, after;
  for (Index c = 0; at(c) < cube.mesh.cell_count(); ++c) {
    curved.gather(c, 4, before);
    raised.gather(c, 4, after);
    for (std::size_t n = 0; n < before.size(); ++n) {
      EXPECT_LT((before[n] - after[n]).norm(), 1e-14);
    }
  }
}

TEST(LargestGap, IsRoundOffWhateverTheOrdersAndShapesAre) {
  Cube cube;
  for (int highest : {2, 3, 4}) {
    const CurvedMesh curved =
        cube.shaken(testing::random_orders(cube.mesh.cell_count(), highest, cube.random));

    EXPECT_LT(largest_gap(curved), 1e-14);
  }
}

TEST(LimitOrderJumps, RaisesNeighboursUntilTheyDifferByOne) {
  Cube cube;
  std::vector<std::uint8_t> orders(cube.mesh.cell_count(), 1);
  orders[0] = 4;

  limit_order_jumps(cube.topology, orders);

  EXPECT_EQ(orders[0], 4);
  for (const auto& [a, b] : cube.topology.face2cell) {
    if (b == k_none) continue;
    EXPECT_LE(std::abs(orders[at(a)] - orders[at(b)]), 1);
    EXPECT_TRUE(a != 0 || orders[at(b)] == 3);
    EXPECT_TRUE(b != 0 || orders[at(a)] == 3);
  }
}

}  // namespace
}  // namespace camber
