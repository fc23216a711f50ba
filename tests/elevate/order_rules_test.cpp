#include <camber/elevate/apply_field.hpp>
#include <camber/elevate/order_rules.hpp>
#include <camber/elevate/rescue.hpp>
#include <camber/geom/analytic_model.hpp>

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "layer_meshes.hpp"

namespace camber {
namespace {

using namespace testing;

Vec3 outwards(const Vec3& x) { return x.normalized(); }

const Vec3 k_axes(3.0, 1.0, 0.5);

std::unique_ptr<Case> ellipsoid(double first) {
  const auto direction = [](const Vec3& x) -> Vec3 {
    return x.cwiseQuotient(k_axes.cwiseProduct(k_axes)).normalized();
  };
  return make_case(layers_on(stretched(icosphere(2), k_axes),
                             {0.0, first, 3.0 * first, 0.05, 0.15, 0.4}, direction),
                   make_ellipsoid(Vec3::Zero(), k_axes));
}

OrderRequests requests_of(const Case& c, const LayerField& field, const OrderOptions& options) {
  return request_orders(c.mesh, c.topology, c.wall, *c.placement, field, options);
}

std::size_t asked(const OrderRequests& requests) {
  std::size_t sum = 0;
  for (std::uint8_t q : requests.edge) sum += q;
  for (std::uint8_t q : requests.face) sum += q;
  return sum;
}

TEST(OrderRules, SettledOrdersJumpByOneAndNeverFallBelowARequest) {
  const auto c = ellipsoid(1e-3);
  std::mt19937 random(9);
  for (int trial = 0; trial < 5; ++trial) {
    OrderRequests requests;
    requests.edge.assign(c->topology.edge_count(), 1);
    requests.face.assign(c->topology.face_count(), 1);
    for (int k = 0; k < 6; ++k) {
      requests.edge[random() % requests.edge.size()] = static_cast<std::uint8_t>(1 + random() % 4);
      requests.face[random() % requests.face.size()] = static_cast<std::uint8_t>(1 + random() % 4);
    }
    OrderOptions options;
    options.min_order = trial == 4 ? 2 : 1;

    const OrderField orders = settle_orders(c->mesh, c->topology, requests, options);

    EXPECT_LE(largest_order_jump(c->topology, orders), 1);
    for (std::size_t e = 0; e < requests.edge.size(); ++e) {
      EXPECT_GE(orders.edge[e], requests.edge[e]);
    }
    for (std::size_t f = 0; f < requests.face.size(); ++f) {
      EXPECT_GE(orders.face[f], requests.face[f]);
    }
    for (Index cell = 0; at(cell) < c->mesh.cell_count(); ++cell) {
      EXPECT_GE(orders.cell[at(cell)], options.min_order);
      for (Index f : c->topology.faces_of_cell(cell)) {
        EXPECT_LE(orders.face[at(f)], orders.cell[at(cell)]);
      }
    }
  }
}

TEST(OrderRules, OneRequestStepsDownOverItsNeighbours) {
  const auto c = ellipsoid(1e-3);
  OrderRequests requests;
  requests.edge.assign(c->topology.edge_count(), 1);
  requests.face.assign(c->topology.face_count(), 1);
  requests.face[at(c->wall.faces[0])] = 4;
  const OrderField orders = settle_orders(c->mesh, c->topology, requests, {});

  std::vector<int> distance(c->mesh.cell_count(), 99);
  distance[at(c->topology.face2cell[at(c->wall.faces[0])][0])] = 0;
  for (int pass = 0; pass < 4; ++pass) {
    for (const auto& [a, b] : c->topology.face2cell) {
      if (b == k_none) continue;
      distance[at(a)] = std::min(distance[at(a)], distance[at(b)] + 1);
      distance[at(b)] = std::min(distance[at(b)], distance[at(a)] + 1);
    }
  }
  for (std::size_t cell = 0; cell < distance.size(); ++cell) {
    EXPECT_EQ(orders.cell[cell], std::max(1, 4 - distance[cell]));
  }
}

TEST(OrderRules, AskMoreForATighterTolerance) {
  const auto c = ellipsoid(1e-2);
  const LayerField field = c->field();
  OrderOptions options;
  OrderRequests before;
  for (double deviation : {0.3, 0.05, 0.01, 1e-3, 1e-4}) {
    options.deviation = deviation;
    const OrderRequests now = requests_of(*c, field, options);
    EXPECT_EQ(
        largest_order_jump(c->topology, settle_orders(c->mesh, c->topology, now, options)) <= 1,
        true);
    for (std::size_t s = 0; s < c->wall.face_count() && !before.face.empty(); ++s) {
      EXPECT_GE(now.face[at(c->wall.faces[s])], before.face[at(c->wall.faces[s])]);
    }
    if (!before.face.empty()) {
      EXPECT_GT(asked(now), asked(before));
    }
    before = now;
  }
}

TEST(OrderRules, ChosenOrdersMeetTheToleranceOrAreTheHighest) {
  const auto c = ellipsoid(1e-2);
  OrderOptions options;
  options.deviation = 3e-3;
  const OrderRequests requests = requests_of(*c, c->field(), options);
  const std::vector<double> shortest = shortest_edges(c->mesh, c->topology);
  for (Index slot = 0; at(slot) < c->wall.face_count(); ++slot) {
    const Index f = c->wall.faces[at(slot)];
    const int q = requests.face[at(f)];
    const double allowed =
        options.deviation * deviation_length(c->mesh, c->topology, f, shortest, options);
    if (q < 4) {
      EXPECT_LE(c->placement->face_deviation(slot, q).maximum, allowed);
    }
  }
}

TEST(OrderRules, AFlatWallAsksForNothing) {
  const SurfaceMesh square = grid(3, 3, [](double u, double v) { return Vec3(u, v, 0.0); });
  LayerOptions sides;
  sides.lateral_entity = [](const Vec3& x) {
    return x.x() < 1e-9 ? 11 : x.x() > 1.0 - 1e-9 ? 12 : x.y() < 1e-9 ? 13 : 14;
  };
  const auto c = make_case(
      layers_on(
          square, {0.0, 1e-4, 0.2, 0.5}, [](const Vec3&) -> Vec3 { return Vec3::UnitZ(); }, sides),
      make_plane(Vec3::Zero(), Vec3::UnitX(), Vec3::UnitY()));
  const OrderRequests requests = requests_of(*c, c->field(), {});

  EXPECT_EQ(requests.by_surface + requests.by_volume, 0u);
  EXPECT_EQ(asked(requests), requests.edge.size() + requests.face.size());
}

TEST(OrderRules, ThePapersCellLengthAsksMoreOnThinLayers) {
  const auto c = ellipsoid(1e-4);
  const LayerField field = c->field();
  OrderOptions face, cell;
  cell.deviation_length = DeviationLength::cell;
  face.deviation = cell.deviation = 0.05;
  const OrderRequests by_face = requests_of(*c, field, face),
                      by_cell = requests_of(*c, field, cell);

  EXPECT_GT(asked(by_cell), asked(by_face));
  for (Index f : c->wall.faces) {
    EXPECT_GE(by_cell.face[at(f)], by_face.face[at(f)]);
    EXPECT_GE(by_cell.face[at(f)], 3) << "5 % of the first cell's height is next to nothing";
  }
}

TEST(OrderRules, LengthsAreThoseOfFaceCellOrUser) {
  const auto c = make_case(layers_on(icosphere(0), {0.0, 0.01, 0.3}, outwards),
                           make_sphere(Vec3::Zero(), 1.0), 2);
  const std::vector<double> shortest = shortest_edges(c->mesh, c->topology);
  const Index f = c->wall.faces[0];
  OrderOptions options;
  EXPECT_NEAR(deviation_length(c->mesh, c->topology, f, shortest, options), mean_edge(icosphere(0)),
              1e-14);
  options.deviation_length = DeviationLength::cell;
  EXPECT_NEAR(deviation_length(c->mesh, c->topology, f, shortest, options), 0.01, 1e-14);
  options.deviation_length = DeviationLength::given;
  options.length = 7.5;
  EXPECT_EQ(deviation_length(c->mesh, c->topology, f, shortest, options), 7.5);
}

TEST(OrderRules, AThinNeighbourIsRaisedByTheVolumeTestAThickOneIsNot) {
  // Displacement at the top of the first layer: most of it, since the layer is low. What a linear
  // second layer would miss there is compared with its own height.
  for (double second : {1e-3, 10.0}) {
    const auto c = make_case(layers_on(icosphere(1), {0.0, 0.01, 0.01 + second}, outwards),
                             make_sphere(Vec3::Zero(), 1.0));
    OrderOptions options;
    options.max_order = 2;
    options.deviation = 1e-6;
    options.volume_deviation = second < 1.0 ? 0.05 : 20.0;
    options.wall_cell_deviation = options.volume_deviation;
    const OrderField orders =
        settle_orders(c->mesh, c->topology, requests_of(*c, c->field(), options), options);
    for (Index cell = 0; at(cell) < c->mesh.cell_count(); ++cell) {
      const bool is_first = c->columns.height[at(c->mesh.cell(cell)[0])] == 0.0;
      EXPECT_EQ(orders.cell[at(cell)], is_first || second < 1.0 ? 2 : 1);
    }
  }
}

TEST(OrderRules, AFirstCellLetsLessBeMissedThanOthers) {
  // As above with a thick second layer, but what lies on a first cell may miss next to nothing.
  const auto c = make_case(layers_on(icosphere(1), {0.0, 0.01, 10.01}, outwards),
                           make_sphere(Vec3::Zero(), 1.0));
  OrderOptions options;
  options.max_order = 2;
  options.deviation = 1e-6;
  options.volume_deviation = 20.0;
  options.wall_cell_deviation = 0.01;
  const OrderField orders =
      settle_orders(c->mesh, c->topology, requests_of(*c, c->field(), options), options);
  for (std::uint8_t q : orders.cell) EXPECT_EQ(q, 2);
}

TEST(OrderRules, MixedOrdersStayCertifiedOnThinLayersWithoutAskingForTheHighest) {
  for (double first : {1e-3, 1e-6}) {
    const auto c = ellipsoid(first);
    const LayerField field = c->field();
    for (double deviation : {0.05, 0.01}) {
      OrderOptions options;
      options.deviation = deviation;
      CurvedMesh curved(
          c->mesh, c->topology,
          settle_orders(c->mesh, c->topology, requests_of(*c, field, options), options));
      const std::vector<std::uint8_t>& orders = curved.orders().cell;
      CurvedMesh applied = curved;
      apply_field(field, applied);

      EXPECT_TRUE(uncertified_cells(applied, all_cells(c->mesh)).empty());
      const auto highest = std::count(orders.begin(), orders.end(), 4);
      EXPECT_LT(highest, static_cast<std::ptrdiff_t>(orders.size() / 4)) << first;
    }
  }
}

}  // namespace
}  // namespace camber
