#include <camber/base/parallel.hpp>
#include <camber/mesh/raise_orders.hpp>
#include <camber/reference/naive_marching.hpp>
#include <camber/smooth/marching/marcher.hpp>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "../../mesh/hybrid_mesh.hpp"
#include "../../support/cube_mesh.hpp"
#include "../../support/random_nodes.hpp"

namespace camber {
namespace {

FixedEntities nothing_fixed(const Topology& topology) {
  return {std::vector<std::uint8_t>(topology.edge_count(), 0),
          std::vector<std::uint8_t>(topology.face_count(), 0)};
}

/// All four shapes, every cell of its own order.
struct Hybrid {
  LinearMesh mesh;
  Topology topology;

  Hybrid() : mesh(build_linear_mesh(bent())), topology(build_topology(mesh)) {}
  Hybrid(const Hybrid&) = delete;
  Hybrid& operator=(const Hybrid&) = delete;

  static MeshData bent() {
    MeshData data = testing::hybrid_mesh();
    testing::bend(data);
    return data;
  }
  [[nodiscard]] CurvedMesh shaken(std::vector<std::uint8_t> orders, double amplitude) const {
    CurvedMesh curved(mesh, topology, minimum_rule(topology, std::move(orders)));
    std::mt19937 random(7);
    testing::shake(curved, amplitude, random);
    return curved;
  }
};

Points positions(const CurvedMesh& curved) {
  Points all;
  const auto add = [&](std::span<const Vec3> own) {
    all.insert(all.end(), own.begin(), own.end());
  };
  for (Index e = 0; at(e) < curved.topology().edge_count(); ++e) add(curved.edge_nodes(e));
  for (Index f = 0; at(f) < curved.topology().face_count(); ++f) add(curved.face_nodes(f));
  for (Index c = 0; at(c) < curved.linear().cell_count(); ++c) add(curved.cell_nodes(c));
  return all;
}

template <int d>
Points one_step(const CurvedMesh& curved, MarchProblem problem, int level) {
  MarcherOptions options;
  options.level = level;
  Marcher<d> marcher(problem, options);
  marcher.sweep();
  CurvedMesh moved = curved;
  store(problem, moved);
  Points step = positions(moved);
  const Points before = positions(curved);
  for (std::size_t i = 0; i < step.size(); ++i) step[i] -= before[i];
  return step;
}

reference::NaiveMarching naive(const FixedEntities& fixed, int level) {
  reference::NaiveMarching options;
  options.level = level;
  options.fixed_edge = fixed.edge;
  options.fixed_face = fixed.face;
  return options;
}

double largest_difference(const Points& a, const Points& b) {
  EXPECT_EQ(a.size(), b.size());
  double largest = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

double longest(const Points& steps) {
  double length = 0.0;
  for (const Vec3& step : steps) length = std::max(length, step.norm());
  return length;
}

/// Orders of hexahedron, pyramid, prism, tet in the order of the file's blocks.
const std::vector<std::vector<std::uint8_t>> k_orders{{2, 2, 2, 2}, {3, 2, 4, 2}, {2, 4, 3, 4}};

TEST(OneStepInTheVolume, IsThatOfTheNaiveReferenceForAllShapesAndMixedOrders) {
  const Hybrid hybrid;
  const FixedEntities fixed = nothing_fixed(hybrid.topology);
  for (const std::vector<std::uint8_t>& orders : k_orders) {
    for (double amplitude : {0.03, 0.12}) {  // the larger one inverts
      const CurvedMesh curved = hybrid.shaken(orders, amplitude);

      const Points step = one_step<3>(curved, volume_problem(curved, fixed), 0);

      EXPECT_GT(longest(step), 1e-4);
      EXPECT_LT(largest_difference(step, naive_volume_step(curved, naive(fixed, 0))), 1e-12);
    }
  }
}

TEST(OneStepInTheVolume, IsThatOfTheNaiveReferenceWithSubdivision) {
  const Hybrid hybrid;
  const FixedEntities fixed = boundary_entities(hybrid.topology);
  const CurvedMesh curved = hybrid.shaken({2, 3, 2, 3}, 0.06);
  for (int level : {1, 2}) {
    const Points step = one_step<3>(curved, volume_problem(curved, fixed), level);

    EXPECT_GT(longest(step), 1e-4);
    EXPECT_LT(largest_difference(step, naive_volume_step(curved, naive(fixed, level))), 1e-12);
  }
}

TEST(OneStepOnTheSurface, IsThatOfTheNaiveReference) {
  const Hybrid hybrid;
  const FixedEntities fixed = nothing_fixed(hybrid.topology);
  std::vector<Index> faces;
  for (Index f = 0; at(f) < hybrid.topology.face_count(); ++f) {
    if (hybrid.topology.is_boundary(f)) faces.push_back(f);
  }
  for (int level : {0, 1, 2}) {
    const CurvedMesh curved = hybrid.shaken({3, 2, 4, 3}, level == 0 ? 0.1 : 0.04);
    std::vector<Index> curved_faces = faces;
    std::erase_if(curved_faces, [&](Index f) { return curved.face_order(f) < 2; });

    const Points step = one_step<2>(curved, surface_problem(curved, fixed, faces), level);

    EXPECT_GT(longest(step), 1e-4);
    EXPECT_LT(
        largest_difference(step, naive_surface_step(curved, naive(fixed, level), curved_faces)),
        1e-12);
  }
}

TEST(MarchProblem, GathersTheSameElementNodesAsTheMesh) {
  const Hybrid hybrid;
  const CurvedMesh curved = hybrid.shaken({3, 2, 4, 2}, 0.1);
  const MarchProblem problem = volume_problem(curved, boundary_entities(hybrid.topology));
  Points x, expected;

  for (const MarchElement& element : problem.elements) {
    element.gather(problem.x, x);
    curved.gather(element.entity, element.order, expected);
    EXPECT_LT(largest_difference(x, expected), 1e-14);
  }
}

TEST(MarchingStep, IsRelaxationTimesRadiusTimesTheDifferenceToOneAtMostOne) {
  EXPECT_DOUBLE_EQ(marching_step(0.05, 2.0, 0.75), 0.025);
  EXPECT_DOUBLE_EQ(marching_step(0.05, 2.0, -3.0), 0.1);
}

TEST(NodalCost, WeighsTheWorstSubSimplexByWhatItLacks) {
  NodalCost node;
  node.add(0.5, Vec3(1, 0, 0));
  node.add(1.0, Vec3(0, 1, 0));

  EXPECT_DOUBLE_EQ(node.cost(), 0.5 * 0.5 + 0.75 * 0.5);
  EXPECT_EQ(node.slope(), Vec3(0.5 + 0.25, 0.25, 0.0));

  node.add(-0.5, Vec3(0, 0, 2));  // a negative one counts alone
  EXPECT_EQ(node.cost(), -0.5);
  EXPECT_EQ(node.slope(), Vec3(0, 0, 2));
}

TEST(Marcher, MovesOnlyActiveNodesAndNoFurtherThanTheirStep) {
  const Hybrid hybrid;
  CurvedMesh curved = hybrid.shaken({2, 2, 2, 2}, 0.0);
  curved.cell_nodes(0)[0] += Vec3(0.2, 0.1, 0.0);  // inside of the hexahedron
  MarchProblem problem = volume_problem(curved, nothing_fixed(hybrid.topology));
  Marcher<3> marcher(problem, {});
  const Points before = problem.x;
  std::vector<double> cost;
  for (std::size_t i = 0; i < before.size(); ++i) cost.push_back(marcher.node_cost(i));

  marcher.sweep();

  std::size_t moved = 0;
  for (std::size_t i = 0; i < before.size(); ++i) {
    const double length = (problem.x[i] - before[i]).norm();
    moved += length > 0.0;
    EXPECT_TRUE(cost[i] < 0.95 || length == 0.0);
    EXPECT_LE(length, marching_step(0.05, marcher.inscribed_radius(i), cost[i]) * (1.0 + 1e-12));
  }
  EXPECT_GT(moved, 0u);
  EXPECT_LT(moved, before.size());
}

TEST(Marcher, KnowsAfterASweepWhatAFreshOneFinds) {
  const Hybrid hybrid;
  const CurvedMesh curved = hybrid.shaken({3, 2, 3, 2}, 0.05);
  MarchProblem problem = volume_problem(curved, boundary_entities(hybrid.topology));
  Marcher<3> marcher(problem, {});
  for (int sweep = 0; sweep < 5; ++sweep) marcher.sweep();

  Marcher<3> fresh(problem, {});

  for (std::size_t i = 0; i < problem.x.size(); ++i) {
    EXPECT_EQ(marcher.node_cost(i), fresh.node_cost(i));
  }
  EXPECT_EQ(marcher.state().worst_cost, fresh.state().worst_cost);
}

TEST(Marcher, GivesTheSameBitsForAnyNumberOfThreads) {
  const LinearMesh mesh = build_linear_mesh(testing::cube_mesh(testing::Filling::hybrid, 2, 3));
  const Topology topology = build_topology(mesh);
  std::mt19937 random(5);
  CurvedMesh curved(mesh, topology,
                    minimum_rule(topology, testing::random_orders(mesh.cell_count(), 3, random)));
  testing::shake(curved, 0.02, random);
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    MarchProblem problem = volume_problem(curved, boundary_entities(topology));
    Marcher<3> marcher(problem, {});
    for (int sweep = 0; sweep < 3; ++sweep) marcher.sweep();
    return problem.x;
  };

  const Points one = run(1), many = run(8);

  for (std::size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i], many[i]);
}

}  // namespace
}  // namespace camber
