#include <camber/mesh/raise_orders.hpp>
#include <camber/smooth/marching/marching.hpp>
#include <camber/validity/element_validity.hpp>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "../../support/cube_mesh.hpp"
#include "../../support/random_nodes.hpp"

namespace camber {
namespace {

struct Cube {
  LinearMesh mesh;
  Topology topology;

  explicit Cube(testing::Filling filling = testing::Filling::hybrid, int n = 2)
      : mesh(build_linear_mesh(testing::cube_mesh(filling, n, 3))),
        topology(build_topology(mesh)) {}
  Cube(const Cube&) = delete;
  Cube& operator=(const Cube&) = delete;

  [[nodiscard]] CurvedMesh of_order(int q) const {
    return {mesh, topology,
            minimum_rule(topology, std::vector<std::uint8_t>(mesh.cell_count(),
                                                             static_cast<std::uint8_t>(q)))};
  }
  [[nodiscard]] std::size_t invalid(const CurvedMesh& curved) const {
    std::size_t n = 0;
    Points nodes;
    for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
      curved.gather(c, curved.cell_order(c), nodes);
      n += quick_verdict(mesh.cell_shape[at(c)], curved.cell_order(c), nodes) != Verdict::valid;
    }
    return n;
  }
};

/// Boundary nodes stay.
MarchingBoundary still() { return {}; }

/// Moves the nodes of inner edges and faces, and of insides.
void shake_inside(CurvedMesh& curved, double amplitude, unsigned seed) {
  const CurvedMesh before = curved;
  std::mt19937 random(seed);
  testing::shake(curved, amplitude, random);
  const FixedEntities fixed = boundary_entities(curved.topology());
  for (Index e = 0; at(e) < curved.topology().edge_count(); ++e) {
    if (fixed.edge[at(e)]) std::ranges::copy(before.edge_nodes(e), curved.edge_nodes(e).begin());
  }
  for (Index f = 0; at(f) < curved.topology().face_count(); ++f) {
    if (fixed.face[at(f)]) std::ranges::copy(before.face_nodes(f), curved.face_nodes(f).begin());
  }
}

TEST(Marching, UntanglesAShakenCubeOfAllShapes) {
  const Cube cube;
  CurvedMesh curved = cube.of_order(2);
  shake_inside(curved, 0.1, 1);
  ASSERT_GT(cube.invalid(curved), 0u);

  MarchingOptions options;
  options.max_sweeps = 300;
  const MarchingResult result = smooth_by_marching(curved, still(), options);

  EXPECT_EQ(cube.invalid(curved), 0u);
  EXPECT_TRUE(result.uncertified.empty());
  EXPECT_GT(result.rows.front().negative_elements, 0u);
  EXPECT_EQ(result.rows.back().negative_elements, 0u);
  EXPECT_LT(result.rows.back().active_nodes, result.rows.front().active_nodes);
}

TEST(Marching, DoesNotTouchAMeshWhoseNodesAllReachTheThreshold) {
  const Cube cube;
  CurvedMesh curved = cube.of_order(2);
  shake_inside(curved, 1e-3, 2);
  const CurvedMesh before = curved;

  const MarchingResult result = smooth_by_marching(curved, still(), {});

  ASSERT_EQ(result.rows.size(), 1u);
  EXPECT_EQ(result.rows[0].active_nodes, 0u);
  for (Index e = 0; at(e) < cube.topology.edge_count(); ++e) {
    EXPECT_TRUE(std::ranges::equal(curved.edge_nodes(e), before.edge_nodes(e)));
  }
}

TEST(Marching, LeavesTheBestStateItSaw) {
  const Cube cube;
  CurvedMesh curved = cube.of_order(2);
  shake_inside(curved, 0.05, 3);
  MarchingOptions options;
  options.relaxation = 1.5;  // overshoots
  options.max_sweeps = 40;
  MarchProblem before = volume_problem(curved, boundary_entities(cube.topology));
  const MarchState start = Marcher<3>(before, {}).state();

  static_cast<void>(smooth_by_marching(curved, still(), options));

  MarchProblem after = volume_problem(curved, boundary_entities(cube.topology));
  const MarchState end = Marcher<3>(after, {}).state();
  EXPECT_LE(end.negative_elements, start.negative_elements);
  EXPECT_GE(end.worst_cost, start.worst_cost);
  EXPECT_GE(end.mean_cost, start.mean_cost);
}

TEST(Marching, StopsWhenTheListenerThrowsBetweenTwoSweeps) {
  struct Enough {};
  const Cube cube;
  CurvedMesh curved = cube.of_order(2);
  shake_inside(curved, 0.05, 4);
  int rows = 0;

  EXPECT_THROW(static_cast<void>(smooth_by_marching(curved, still(), {},
                                                    [&](const SmoothRow&) {
                                                      if (++rows == 3) throw Enough{};
                                                    })),
               Enough);
  EXPECT_EQ(rows, 3);
}

TEST(DistanceToLowerOrder, IsThatOfTheBubbleThatTheLowerOrderCannotHold) {
  // A parabola of height 0.25 over the chord.
  const Points parabola{Vec3(0, 0, 0), Vec3(0.5, 0.25, 0), Vec3(1, 0, 0)};
  EXPECT_NEAR(distance_to_lower_order(Shape::line, 2, parabola), 0.25, 1e-15);
  // The same as a cubic: its second order is the parabola again.
  const Points cubic{Vec3(0, 0, 0), Vec3(1.0 / 3, 2.0 / 9, 0), Vec3(2.0 / 3, 2.0 / 9, 0),
                     Vec3(1, 0, 0)};
  EXPECT_NEAR(distance_to_lower_order(Shape::line, 3, cubic), 0.0, 1e-15);
}

/// Cells in the lower half get order 3, the others 2; the bottom is bent.
struct Bent {
  Cube cube{testing::Filling::hexes, 2};
  CurvedMesh curved;

  explicit Bent(double height)
      : curved(cube.mesh, cube.topology, minimum_rule(cube.topology, orders())) {
    const auto move = [&](std::span<Vec3> own) {
      for (Vec3& x : own) {
        if (x.z() < 0.6) x.z() += height * bump(x.x()) * bump(x.y()) * (1.0 - x.z() / 0.6);
      }
    };
    for (Index e = 0; at(e) < cube.topology.edge_count(); ++e) move(curved.edge_nodes(e));
    for (Index f = 0; at(f) < cube.topology.face_count(); ++f) move(curved.face_nodes(f));
    for (Index c = 0; at(c) < cube.mesh.cell_count(); ++c) move(curved.cell_nodes(c));
  }
  [[nodiscard]] std::vector<std::uint8_t> orders() const {
    std::vector<std::uint8_t> orders;
    for (Index c = 0; at(c) < cube.mesh.cell_count(); ++c) {
      double z = 0.0;
      for (Index v : cube.mesh.cell(c)) z += cube.mesh.vertices[at(v)].z() / 8.0;
      orders.push_back(z < 0.5 ? 3 : 2);
    }
    return orders;
  }
  /// Zero at the vertices of the mesh of two cells a side.
  static double bump(double x) { return std::sin(2.0 * M_PI * x); }
};

TEST(Elevation, RaisesCellsWhoseNeighbourOfHigherOrderWouldBendTheirFace) {
  Bent bent(0.2);
  const FixedEntities fixed = boundary_entities(bent.cube.topology);
  ElevationOptions options;
  options.volume_deviation = 0.01;

  const std::vector<Index> marked = cells_to_raise(bent.curved, fixed, options);

  EXPECT_FALSE(marked.empty());
  for (Index c : marked) EXPECT_EQ(bent.curved.cell_order(c), 2);
  const std::vector<std::uint8_t> orders = raised_orders(bent.curved, marked);
  for (Index c : marked) EXPECT_EQ(orders[at(c)], 3);
}

TEST(Elevation, AsksNothingWhereTheInterfaceIsAtRestOrTheOrderIsTheHighest) {
  Bent straight(0.0), bent(0.2);
  const FixedEntities fixed = boundary_entities(straight.cube.topology);
  ElevationOptions options;
  options.volume_deviation = 0.01;

  EXPECT_TRUE(cells_to_raise(straight.curved, fixed, options).empty());
  options.max_order = 2;
  EXPECT_TRUE(cells_to_raise(bent.curved, fixed, options).empty());
}

TEST(Elevation, HappensWhileSmoothingAndKeepsInterfacesEqual) {
  Bent bent(0.2);
  MarchingOptions options;
  options.volume_deviation = 0.01;
  options.deviation_interval = 10;
  options.max_sweeps = 30;
  options.release_sweeps = 30;
  std::vector<std::size_t> raised;

  const MarchingResult result =
      smooth_by_marching(bent.curved, still(), options,
                         [&](const SmoothRow& row) { raised.push_back(row.elevated_elements); });

  EXPECT_GT(result.raised_cells, 0u);
  EXPECT_EQ(raised.front(), 0u);
  EXPECT_EQ(raised.back(), result.raised_cells);
  EXPECT_LT(largest_gap(bent.curved), 1e-14);
  EXPECT_TRUE(result.uncertified.empty());
}

}  // namespace
}  // namespace camber
