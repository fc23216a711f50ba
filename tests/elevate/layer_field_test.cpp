#include <camber/elevate/apply_field.hpp>
#include <camber/elevate/rescue.hpp>
#include <camber/geom/analytic_model.hpp>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "bodies.hpp"

namespace camber {
namespace {

using namespace testing;

Vec3 outwards(const Vec3& x) { return x.normalized(); }

std::unique_ptr<Case> sphere(const SurfaceMesh& surface, double first,
                             LayerFilling filling = LayerFilling::stacked) {
  LayerOptions options;
  options.filling = filling;
  return make_case(layers_on(surface, {0.0, first, 0.3, 0.8}, outwards, options),
                   make_sphere(Vec3::Zero(), 1.0));
}

/// Vertices of an edge one layer up.
Index edge_above(const Case& c, Index e, Index step) {
  const std::array<Index, 2>& v = c.topology.edge2vertex[at(e)];
  return c.topology.find_edge(v[0] + step, v[1] + step);
}

/// 96 quads on a sphere whose edges move by 3 per cent of the radius, two layers, pyramids on top.
std::unique_ptr<Case> capped_sphere(double cap_height) {
  LayerOptions options;
  options.filling = LayerFilling::capped;
  options.cap_height = cap_height;
  return make_case(layers_on(cubed_sphere(4), {0.0, 0.01, 0.03}, outwards, options),
                   make_sphere(Vec3::Zero(), 1.0));
}

TEST(Decay, IsShorterUnderFlatCaps) {
  const auto high = capped_sphere(0.5), flat = capped_sphere(0.1);
  const LayerField loose = high->field(), tight = flat->field();
  const double edge = mean_edge(cubed_sphere(4));
  int shorter = 0;
  for (Index v = 0; v < 98; ++v) {
    EXPECT_LE(tight.decay_length(v), loose.decay_length(v));
    shorter += tight.decay_length(v) < loose.decay_length(v);
    // As short as layers bear, or what is left at their top is little for the cap.
    const double d = flat->placement->largest_displacement();
    const double left = d * decay(0.03 / tight.decay_length(v));
    EXPECT_TRUE(tight.decay_length(v) <= 2.5 * d * (1.0 + 1e-12) || left <= 0.3 * 0.12 * edge);
  }
  EXPECT_EQ(shorter, 98);
}

TEST(Decay, IsOneAndFlatAtTheWallAndEndsFlat) {
  EXPECT_DOUBLE_EQ(decay(0.0), 1.0);
  EXPECT_DOUBLE_EQ(decay(0.5), 0.5);
  EXPECT_DOUBLE_EQ(decay(1.0), 0.0);
  EXPECT_DOUBLE_EQ(decay(7.0), 0.0);
  EXPECT_DOUBLE_EQ(decay(-1.0), 1.0);
  const double step = 1e-5;
  for (double s : {0.0, 0.3, 0.7, 1.0}) {
    const double slope = (decay(s + step) - decay(s - step)) / (2.0 * step);
    EXPECT_NEAR(slope, -6.0 * s * (1.0 - s), 1e-4);
  }
}

TEST(LayerField, IsTheWallsDisplacementOnTheWall) {
  const auto c = sphere(icosphere(1), 1e-3);
  const LayerField field = c->field();
  for (int q = 2; q <= 4; ++q) {
    Points u(static_cast<std::size_t>(q - 1));
    for (Index slot = 0; at(slot) < c->wall.edge_count(); ++slot) {
      field.edge(c->wall.edges[at(slot)], q, u);
      const std::span<const Vec3> d = c->placement->edge_displacement(slot, q);
      for (std::size_t i = 0; i < u.size(); ++i) EXPECT_EQ(u[i], d[i + 1]);
    }
  }
}

TEST(LayerField, FallsOffAlongTheColumnAsTheFormulaSays) {
  const SurfaceMesh surface = icosphere(1);
  const double first = 0.01;  // the still outer boundary is too far away to be felt there
  const auto c = sphere(surface, first);
  const LayerField field = c->field();
  const Index step = static_cast<Index>(surface.points.size());
  Points low(3), high(3);
  for (Index slot = 0; at(slot) < c->wall.edge_count(); ++slot) {
    const Index e = c->wall.edges[at(slot)], above = edge_above(*c, e, step);
    const std::array<Index, 2>& v = c->topology.edge2vertex[at(e)];
    field.edge(e, 4, low);
    field.edge(above, 4, high);
    for (std::size_t i = 0; i < 3; ++i) {
      const double s = static_cast<double>(i + 1) / 4.0;
      const double length = (1.0 - s) * field.decay_length(v[0]) + s * field.decay_length(v[1]);
      EXPECT_LT((high[i] - decay(first / length) * low[i]).norm(), 1e-14);
    }
  }
}

TEST(LayerField, DecaysOverTheMeanWallEdgeOrFiveDisplacements) {
  const SurfaceMesh surface = icosphere(0);  // all edges equal, sagitta large
  const auto c = sphere(surface, 1e-2);
  const double h = mean_edge(surface);
  const double largest = c->placement->largest_displacement();

  LayerFieldOptions by_edge;
  by_edge.reach = 0.7;
  by_edge.reach_per_sagitta = 0.0;
  EXPECT_NEAR(c->field(by_edge).decay_length(3), 0.7 * h, 1e-14);

  LayerFieldOptions by_displacement;
  by_displacement.reach = 0.0;
  EXPECT_NEAR(c->field(by_displacement).decay_length(3), 5.0 * largest, 1e-14);
  EXPECT_EQ(c->field().decay_length(static_cast<Index>(surface.points.size())), 0.0);
}

TEST(LayerField, EndsBeforeTheMiddleOfAGap) {
  // Walls at radius 1 and 1.2: half of the gap is 0.1, much less than an edge.
  std::vector<std::unique_ptr<GeometryModel>> parts;
  parts.push_back(make_sphere(Vec3::Zero(), 1.0));
  parts.push_back(make_sphere(Vec3::Zero(), 1.2));
  LayerOptions options;
  options.outer_entity = 2;
  const SurfaceMesh surface = icosphere(2);
  const auto c = make_case(layers_on(surface, {0.0, 0.05, 0.1, 0.15, 0.2}, outwards, options),
                           joined(std::move(parts)));
  const LayerField field = c->field();
  for (Index v = 0; at(v) < surface.points.size(); ++v) {
    EXPECT_GT(field.decay_length(v), 0.05);
    EXPECT_LT(field.decay_length(v), 0.1);
  }
  EXPECT_TRUE(uncertified_cells(carried(*c, field, 4), all_cells(c->mesh)).empty());
}

TEST(LayerField, KeepsTheFirstCellsHeight) {
  for (double first : {1e-2, 1e-4, 1e-7}) {
    for (LayerFilling filling : {LayerFilling::stacked, LayerFilling::tets}) {
      for (const SurfaceMesh& surface : {icosphere(1), cubed_sphere(3)}) {
        if (filling == LayerFilling::tets && surface.faces[0][3] != k_none) continue;
        const auto c = sphere(surface, first, filling);
        const LayerField field = c->field();
        const Index step = static_cast<Index>(surface.points.size());
        double largest = 0.0;
        Points low(3), high(3);
        for (Index e : c->wall.edges) {
          field.edge(e, 4, low);
          field.edge(edge_above(*c, e, step), 4, high);
          for (std::size_t i = 0; i < 3; ++i) {
            largest = std::max(largest, (high[i] - low[i]).norm() / first);
          }
        }
        EXPECT_LT(largest, filling == LayerFilling::tets ? 0.05 : 0.01) << first;
      }
    }
  }
}

TEST(LayerField, KeepsStillPlanesPlane) {
  const auto height = [](double x, double y) {
    return x <= 0.0 || x >= 1.0 ? 0.0 : 0.2 * std::sin(M_PI * x) * (1.0 + y);
  };
  const BsplineSurface surface = bump(height, 9);
  LayerOptions sides;
  sides.lateral_entity = [](const Vec3& x) {
    if (x.x() < 1e-9) return 11;
    if (x.x() > 1.0 - 1e-9) return 12;
    return x.y() < 1e-9 ? 13 : 14;
  };
  for (bool is_cut : {false, true}) {
    sides.filling = is_cut ? LayerFilling::tets : LayerFilling::stacked;
    const SurfaceMesh mesh = grid(
        6, 4,
        [&](double u, double v) {
          return surface.jet({u, v}).s;
        },
        is_cut);
    const auto c = make_case(layers_on(
                                 mesh, {0.0, 1e-3, 0.1, 0.5, 1.0},
                                 [](const Vec3&) -> Vec3 { return Vec3::UnitZ(); }, sides),
                             make_bspline_patch(bump(height, 9)));
    const CurvedMesh curved = carried(*c, c->field(), 4);
    std::size_t checked = 0;
    double moved = 0.0;
    for (Index f = 0; at(f) < c->topology.face_count(); ++f) {
      const Patch* patch = c->association.patch_of(f);
      if (!patch || patch->entity < 11 || patch->entity > 14) continue;
      const Eigen::Index axis = patch->entity <= 12 ? 0 : 1;
      const double plane = patch->entity % 2 == 1 ? 0.0 : 1.0;
      Points nodes(static_cast<std::size_t>(node_count(c->topology.face_shape[at(f)], 4)));
      curved.face_lattice(f, 4, nodes);
      for (const Vec3& x : nodes) EXPECT_NEAR(x[axis], plane, 1e-15);
      CurvedMesh straight = c->straight(4);
      Points before(nodes.size());
      straight.face_lattice(f, 4, before);
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        moved = std::max(moved, (nodes[i] - before[i]).norm());
      }
      ++checked;
      if (checked > 12) break;
    }
    EXPECT_GT(checked, 10u);
    EXPECT_GT(moved, 1e-3) << "the planes' nodes slide";
    EXPECT_TRUE(uncertified_cells(curved, all_cells(c->mesh)).empty());
  }
}

TEST(LayerField, KeepsBothWallsOfAConcaveCorner) {
  const std::vector<double> s{0.0, 1e-3, 0.15, 0.35, 0.6, 0.8, 1.0};
  constexpr Index n = 7, m = 4;  // lattice points across and along
  const auto vertex = [](Index i, Index j, Index k) { return i + n * (j + m * k); };
  const auto c = make_case(concave_corner(s, m), concave_corner_model());
  const LayerField field = c->field();
  const CurvedMesh curved = carried(*c, field, 4);

  EXPECT_TRUE(uncertified_cells(curved, all_cells(c->mesh)).empty());
  // Along both walls the first layer of cells keeps its height, away from the corner.
  Points low(3), high(3);
  double moved = 0.0, largest = 0.0;
  for (Index j = 0; j < m; ++j) {
    for (Index i = 2; i + 1 < n; ++i) {
      const std::array<std::array<Index, 4>, 2> pairs{
          std::array{vertex(i, j, 0), vertex(i + 1, j, 0), vertex(i, j, 1), vertex(i + 1, j, 1)},
          std::array{vertex(0, j, i), vertex(0, j, i + 1), vertex(1, j, i), vertex(1, j, i + 1)}};
      for (const std::array<Index, 4>& v : pairs) {
        field.edge(c->topology.find_edge(v[0], v[1]), 4, low);
        field.edge(c->topology.find_edge(v[2], v[3]), 4, high);
        for (std::size_t k = 0; k < 3; ++k) {
          moved = std::max(moved, low[k].norm());
          largest = std::max(largest, (high[k] - low[k]).norm());
        }
      }
    }
  }
  EXPECT_GT(moved, 1e-3);
  EXPECT_LT(largest, 0.01 * s[1]);
}

TEST(LayerField, AppliedToSomeCellsTouchesOnlyThese) {
  const auto c = sphere(icosphere(0), 1e-2);
  const LayerField field = c->field();
  const CurvedMesh all = carried(*c, field, 3);
  CurvedMesh some = c->straight(3);
  const CurvedMesh straight = c->straight(3);

  apply_field(field, some, {4});

  Points a, b;
  some.gather(4, 3, a);
  all.gather(4, 3, b);
  EXPECT_EQ(a, b);
  const std::span<const Index> own = c->topology.edges_of_cell(4);
  for (Index e = 0; at(e) < c->topology.edge_count(); ++e) {
    if (std::find(own.begin(), own.end(), e) != own.end()) continue;
    EXPECT_EQ(some.edge_nodes(e)[0], straight.edge_nodes(e)[0]);
  }
}

}  // namespace
}  // namespace camber
