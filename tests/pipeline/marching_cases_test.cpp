// The paper's smoother on benign layers: first cell a tenth of the edge, started from the paper's
// transfer, which leaves the wall's displacement in the first cells.
#include <camber/elevate/apply_field.hpp>
#include <camber/elevate/rescue.hpp>
#include <camber/geom/analytic_model.hpp>
#include <camber/mesh/raise_orders.hpp>
#include <camber/pipeline/curve.hpp>
#include <camber/pipeline/marching_boundary.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "layer_meshes.hpp"

namespace camber {
namespace {

using namespace testing;

std::unique_ptr<Case> sphere(const std::vector<double>& heights) {
  const SurfaceMesh surface = icosphere(1);
  std::vector<double> lengths;
  for (double z : heights) lengths.push_back(z * mean_edge(surface));
  return make_case(
      layers_on(surface, lengths, [](const Vec3& x) -> Vec3 { return x.normalized(); }),
      make_sphere(Vec3::Zero(), 1.0));
}

/// The nose of a wing with an elliptic section of 10 : 1, hexahedra. Its normal turns by the same
/// angle along every edge of the section, and heights count in lengths of the edge below.
std::unique_ptr<Case> wing_nose(int edges, const std::vector<double>& heights) {
  constexpr double a = 1.0, b = 0.1, half_turn = M_PI / 3.0;
  constexpr double span = 4.0, end = 0.01;  // in z
  const Vec3 axes(a, b, span);
  const auto point = [&](double u, double v) {
    const double t = std::atan(b / a * std::tan((2.0 * u - 1.0) * half_turn));
    const double z = (2.0 * v - 1.0) * end, shrink = std::sqrt(1.0 - z * z / (span * span));
    return Vec3(a * std::cos(t) * shrink, b * std::sin(t) * shrink, z);
  };
  const auto edge_outwards = [&](const Vec3& x) -> Vec3 {
    const double t = std::atan2(x.y() / b, x.x() / a);
    const double radius = std::pow(std::hypot(a * std::sin(t), b * std::cos(t)), 3) / (a * b);
    const Vec3 outwards(x.x() / (a * a), x.y() / (b * b), 0.0);
    return radius * (2.0 * half_turn / edges) * outwards.normalized();
  };
  LayerOptions sides;  // planes across the span
  sides.lateral_entity = [](const Vec3& x) {
    return x.z() < -0.99 * end ? 1002 : x.z() > 0.99 * end ? 1003 : 1001;
  };
  return make_case(layers_on(grid(edges, 4, point), heights, edge_outwards, sides),
                   make_ellipsoid(Vec3::Zero(), axes));
}

/// Cells on the wall get the order, their neighbours what the jump rule asks.
CurvedMesh started(const Case& c, int wall_order) {
  std::vector<std::uint8_t> orders(c.mesh.cell_count(), 1);
  for (Index e : c.wall.edges) {
    for (Index cell : c.topology.cells_of_edge(e)) {
      orders[at(cell)] = static_cast<std::uint8_t>(wall_order);
    }
  }
  limit_order_jumps(c.topology, orders);
  CurvedMesh curved(c.mesh, c.topology, minimum_rule(c.topology, orders));
  LayerFieldOptions options;
  options.decay = Decay::cell;
  apply_field(c.field(options), curved);
  return curved;
}

MarchingBoundary boundary_of(const Case& c) {
  return marching_boundary(c.mesh, c.topology, *c.model,
                           {c.association, c.wall, *c.placement, c.columns, {}});
}

const std::vector<double> k_benign{0.0, 0.1, 0.22, 0.5};

/// What the paper says of its smoothing: inversions go, the active set shrinks, cells are raised.
void expect_the_papers_behaviour(const Case& c, CurvedMesh curved, int order) {
  MarchingOptions options;
  options.max_order = order;

  const MarchingResult result = smooth_by_marching(curved, boundary_of(c), options);

  EXPECT_TRUE(result.uncertified.empty());
  EXPECT_TRUE(uncertified_cells(curved, all_cells(c.mesh)).empty());
  EXPECT_EQ(result.rows.back().negative_elements, 0u);
  EXPECT_GT(result.rows.back().worst_cost, 0.0);
  EXPECT_GT(result.raised_cells, 0u);
  std::size_t most_active = 0;
  for (const SmoothRow& row : result.rows) most_active = std::max(most_active, row.active_nodes);
  EXPECT_LT(result.rows.back().active_nodes, most_active);
  EXPECT_LT(largest_gap(curved), 1e-13);
  EXPECT_LE(largest_order_jump(c.topology, curved.orders()), 1);
  for (Index f : c.wall.faces) {
    for (const Vec3& x : curved.face_nodes(f)) {
      EXPECT_LT(
          project_to_group(*c.model->projector(), c.association.patch_of(f)->group, x).distance,
          1e-12);
    }
  }
}

TEST(MarchingOnASphere, UntanglesAndRaisesCellsInTwoPasses) {
  const auto c = sphere(k_benign);
  const CurvedMesh curved = started(*c, 2);
  ASSERT_EQ(uncertified_cells(curved, all_cells(c->mesh)).size(), 80u) << "all on the wall";

  expect_the_papers_behaviour(*c, curved, 2);
}

TEST(MarchingOnAWingNose, UntanglesAndRaisesCells) {
  const auto c = wing_nose(6, k_benign);

  expect_the_papers_behaviour(*c, started(*c, 3), 3);
}

TEST(MarchingOnAWingNose, LeavesFewerAndFewerNodesActive) {
  const auto c = wing_nose(10, k_benign);
  CurvedMesh curved = started(*c, 3);

  const MarchingResult result = smooth_by_marching(curved, boundary_of(*c), {});

  // The set grows while a move spreads, then shrinks.
  for (const char* stage : {"surface", "volume"}) {
    std::vector<std::size_t> active;
    for (const SmoothRow& row : result.rows) {
      if (row.stage == stage) active.push_back(row.active_nodes);
    }
    ASSERT_GT(active.size(), 50u) << stage;
    EXPECT_LT(static_cast<double>(active.back()),
              0.95 * static_cast<double>(*std::max_element(active.begin(), active.end())))
        << stage;
  }
  EXPECT_TRUE(result.uncertified.empty());
}

TEST(MarchingOnASphere, BringsWallNodesBackThatSlidOnTheSurface) {
  const auto c = sphere({0.0, 0.5, 1.0});
  CurvedMesh curved = started(*c, 2);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-0.12, 0.12);
  for (Index e : c->wall.edges) {
    for (Vec3& x : curved.edge_nodes(e)) {
      x = (x + Vec3(uniform(random), uniform(random), uniform(random))).normalized();
    }
  }

  const MarchingResult result = smooth_by_marching(curved, boundary_of(*c), {});

  std::vector<SmoothRow> surface = result.rows;
  std::erase_if(surface, [](const SmoothRow& row) { return row.stage != "surface"; });
  ASSERT_GT(surface.size(), 2u);
  EXPECT_GT(surface.back().worst_cost, surface.front().worst_cost);
  EXPECT_LT(surface.back().active_nodes, surface.front().active_nodes);
  for (Index e : c->wall.edges) {
    for (const Vec3& x : curved.edge_nodes(e)) EXPECT_NEAR(x.norm(), 1.0, 1e-14);
  }
  EXPECT_TRUE(result.uncertified.empty());
}

TEST(CarriedWall, KeepsThinCellsValidWhereTheWallSlidByManyOfTheirHeights) {
  const auto c = sphere({0.0, 1e-4, 3e-4, 0.3, 1.0});
  const CurvedMesh before = carried(*c, c->field(), 2);
  CurvedMesh after = before;
  for (Index e : c->wall.edges) {
    Vec3& x = after.edge_nodes(e)[0];
    x = (x + 0.02 * Vec3(std::sin(9.0 * x.y()), std::cos(7.0 * x.z()), x.x())).normalized();
  }
  const FieldSource source{c->association, c->wall, *c->placement, c->columns, {}};
  ASSERT_TRUE(uncertified_cells(before, all_cells(c->mesh)).empty());
  ASSERT_FALSE(uncertified_cells(after, all_cells(c->mesh)).empty());

  CurvedMesh moved = after, same = before;
  carry_wall(before, moved, source);
  carry_wall(before, same, source);

  EXPECT_TRUE(uncertified_cells(moved, all_cells(c->mesh)).empty());
  EXPECT_TRUE(std::ranges::equal(same.high_order_nodes(), before.high_order_nodes()));
  for (Index e : c->wall.edges) {
    EXPECT_TRUE(std::ranges::equal(moved.edge_nodes(e), after.edge_nodes(e)));
  }
}

TEST(MarchingInAWholeRun, KeepsEveryCertificateAndSaysWhatItDid) {
  const SurfaceMesh surface = icosphere(1);
  const MeshData data = layers_on(surface, {0.0, 0.06, 0.15, 0.4, 0.9},
                                  [](const Vec3& x) -> Vec3 { return x.normalized(); });
  const auto run = [&](Smoothing smoothing) {
    CurveOptions options;
    options.orders.max_order = 3;
    options.smoothing = smoothing;
    const std::unique_ptr<GeometryModel> model = make_sphere(Vec3::Zero(), 1.0);
    return curve(data, *model, options).report;
  };

  const Report none = run(Smoothing::none), marched = run(Smoothing::marching);

  EXPECT_TRUE(none.smooth.empty());
  ASSERT_FALSE(marched.smooth.empty());
  EXPECT_EQ(marched.validity.invalid + marched.validity.undecided, 0u);
  EXPECT_GE(marched.quality.minimum, none.quality.minimum);
  EXPECT_GE(marched.quality.average, none.quality.average);
  EXPECT_LE(marched.surface.faces_over_deviation, none.surface.faces_over_deviation);
  EXPECT_LT(marched.conformity.max_gap, 1e-13);
  const SmoothRow& last = marched.smooth.back();
  const auto first = std::find_if(marched.smooth.begin(), marched.smooth.end(),
                                  [](const SmoothRow& row) { return row.stage == "volume"; });
  ASSERT_NE(first, marched.smooth.end());
  EXPECT_GE(last.worst_cost, first->worst_cost);
  EXPECT_NE(last.shape, Shape::point);
  EXPECT_GT(last.element, 0);
}

}  // namespace
}  // namespace camber
