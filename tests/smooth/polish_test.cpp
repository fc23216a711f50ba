#include <camber/base/parallel.hpp>
#include <camber/smooth/patch.hpp>
#include <camber/smooth/polish.hpp>
#include <camber/validity/element_validity.hpp>

#include <algorithm>
#include <numeric>
#include <random>

#include <gtest/gtest.h>

#include "../support/cube_mesh.hpp"
#include "../support/random_nodes.hpp"

namespace camber {
namespace {

/// A cube of all shapes at order 3 with inner nodes shaken as far as all cells stay certified.
struct Shaken {
  LinearMesh mesh;
  Topology topology;
  CurvedMesh curved;
  std::vector<std::uint8_t> is_free;

  explicit Shaken(unsigned seed)
      : mesh(build_linear_mesh(testing::cube_mesh(testing::Filling::hybrid, 2, seed))),
        topology(build_topology(mesh)),
        curved(
            mesh, topology,
            minimum_rule(topology, std::vector<std::uint8_t>(mesh.cell_count(), std::uint8_t{3}))),
        is_free(free_nodes(curved)) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-0.01, 0.01);
    for (std::size_t i = 0; i < is_free.size(); ++i) {
      if (!is_free[i]) continue;
      curved.high_order_nodes()[i] += Vec3(uniform(random), uniform(random), uniform(random));
    }
  }
  Shaken(const Shaken&) = delete;
  Shaken& operator=(const Shaken&) = delete;

  [[nodiscard]] bool is_certified() const {
    Points nodes;
    for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
      curved.gather(c, 3, nodes);
      if (quick_verdict(mesh.cell_shape[at(c)], 3, nodes) != Verdict::valid) return false;
    }
    return true;
  }
  [[nodiscard]] Points nodes() const {
    return {curved.high_order_nodes().begin(), curved.high_order_nodes().end()};
  }
};

double lowest(const std::vector<double>& v) { return *std::min_element(v.begin(), v.end()); }
double mean(const std::vector<double>& v) {
  return std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
}

TEST(Polish, RaisesTheLowestAndTheMeanCostAndKeepsEveryCertificate) {
  for (unsigned seed : {1u, 2u, 3u}) {
    Shaken cube(seed);
    ASSERT_TRUE(cube.is_certified());
    const std::vector<double> before = cell_costs(cube.curved);
    ASSERT_LT(lowest(before), 0.9);
    std::vector<double> costs = before;
    PolishOptions options;
    options.cost_target = 0.95;

    const PolishResult result = polish(cube.curved, cube.is_free, costs, options);

    EXPECT_GT(result.seeds, 0u);
    EXPECT_GT(result.improved, 0u);
    EXPECT_EQ(costs, cell_costs(cube.curved)) << "costs are those of the mesh";
    EXPECT_GE(lowest(costs), lowest(before));
    EXPECT_GT(mean(costs), mean(before));
    for (std::size_t c = 0; c < costs.size(); ++c) {
      if (before[c] >= 0.95) {
        EXPECT_GE(costs[c], 0.95);
      }
    }
    EXPECT_TRUE(cube.is_certified());
  }
}

TEST(Polish, FindsBackToTheStraightMeshWhereNothingHoldsTheNodes) {
  Shaken cube(4);
  const CurvedMesh straight(cube.mesh, cube.topology, cube.curved.orders());
  std::vector<double> costs = cell_costs(cube.curved);
  PolishOptions options;
  options.cost_target = 1.0;
  options.max_evaluations = 200;
  options.gradient_tolerance = 1e-6;

  polish(cube.curved, cube.is_free, costs, options);

  // The boundary is straight: the optimum is the straight copy, cost 1 everywhere.
  EXPECT_GT(lowest(costs), 0.99);
}

TEST(Polish, LeavesGoodCellsAndFixedNodesAlone) {
  Shaken cube(5);
  const Points before = cube.nodes();
  std::vector<double> costs = cell_costs(cube.curved);
  PolishOptions options;
  options.cost_target = lowest(costs) - 1e-9;
  const PolishResult nothing = polish(cube.curved, cube.is_free, costs, options);
  EXPECT_EQ(nothing.patches, 0u);
  EXPECT_EQ(cube.nodes(), before);

  options.cost_target = 0.95;
  polish(cube.curved, cube.is_free, costs, options);
  const Points after = cube.nodes();
  for (std::size_t i = 0; i < before.size(); ++i) {
    if (!cube.is_free[i]) {
      EXPECT_EQ(after[i], before[i]);
    }
  }
}

TEST(Polish, ReportsEveryPatchAndTheEnd) {
  Shaken cube(6);
  std::vector<double> costs = cell_costs(cube.curved);
  const double first = lowest(costs);
  PolishOptions options;
  options.cost_target = 0.95;
  std::vector<double> heard;

  const PolishResult result =
      polish(cube.curved, cube.is_free, costs, options,
             [&](const SmoothRow& row) { heard.push_back(row.worst_cost); });

  ASSERT_EQ(result.rows.size(), result.patches + 1);
  ASSERT_EQ(heard.size(), result.rows.size());
  EXPECT_EQ(result.rows.front().worst_cost, first);
  EXPECT_EQ(result.rows.back().worst_cost, lowest(costs));
  EXPECT_EQ(result.rows.back().active_nodes, 0u);
}

TEST(Polish, HasTheSameBitsForAnyNumberOfThreads) {
  std::vector<Points> seen;
  for (int threads : {1, 3}) {
    const ThreadLimit limit(threads);
    Shaken cube(7);
    std::vector<double> costs = cell_costs(cube.curved);
    PolishOptions options;
    options.cost_target = 0.95;
    polish(cube.curved, cube.is_free, costs, options);
    seen.push_back(cube.nodes());
  }
  EXPECT_EQ(seen[1], seen[0]);
}

}  // namespace
}  // namespace camber
