#include <camber/basis/lagrange.hpp>
#include <camber/geom/analytic_model.hpp>
#include <camber/validity/element_validity.hpp>

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "layer_meshes.hpp"

namespace camber {
namespace {

using namespace testing;

Vec3 outwards(const Vec3& x) { return x.normalized(); }

std::unique_ptr<Case> sphere(const SurfaceMesh& surface) {
  return make_case(layers_on(surface, {0.0, 0.2}, outwards), make_sphere(Vec3::Zero(), 1.0));
}

/// All nodes of a wall face at order q.
Points face_points(const Case& c, Index slot, int q) {
  const Index f = c.wall.faces[at(slot)];
  Points corner;
  for (int i = 0; i < c.topology.corners_of_face(f); ++i) {
    corner.push_back(
        c.mesh.vertices[at(c.topology.face2vertex[at(f)][static_cast<std::size_t>(i)])]);
  }
  Points nodes = straight_nodes(c.topology.face_shape[at(f)], q, corner);
  if (q == 1) return nodes;
  const std::span<const Vec3> u = c.placement->face_displacement(slot, q);
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] += u[i];
  return nodes;
}

/// Largest difference between what a face says of its edges and what the edges say.
double largest_gap(const Case& c, int q) {
  double gap = 0.0;
  for (Index slot = 0; at(slot) < c.wall.face_count(); ++slot) {
    const Index f = c.wall.faces[at(slot)];
    const Points nodes = face_points(c, slot, q);
    const LatticeMap& map = lattice_map(c.topology.face_shape[at(f)], q);
    for (std::size_t i = 0; i < map.edge_interior.size(); ++i) {
      const Index e = c.topology.face2edge[at(f)][i];
      std::span<const Vec3> own = c.placement->edge_nodes(c.wall.edge_slot[at(e)], q);
      const bool is_reversed = c.topology.edge2vertex[at(e)][0] != c.topology.face2vertex[at(f)][i];
      for (std::size_t k = 0; k < own.size(); ++k) {
        const Vec3& on_edge = own[is_reversed ? own.size() - 1 - k : k];
        gap = std::max(gap,
                       (nodes[static_cast<std::size_t>(map.edge_interior[i][k])] - on_edge).norm());
      }
    }
  }
  return gap;
}

TEST(Placement, PutsEveryNodeOnTheSphere) {
  for (const SurfaceMesh& surface : {icosphere(1), cubed_sphere(3)}) {
    const auto c = sphere(surface);
    for (int q = 2; q <= 4; ++q) {
      for (Index slot = 0; at(slot) < c->wall.face_count(); ++slot) {
        for (const Vec3& x : face_points(*c, slot, q)) ASSERT_NEAR(x.norm(), 1.0, 1e-14);
        EXPECT_FALSE(c->placement->is_face_unplaced(slot));
      }
      EXPECT_LE(largest_gap(*c, q), 1e-15);
    }
  }
}

TEST(Placement, OfTheMiddleOfAnArcIsTheArcsMiddle) {
  const auto c = sphere(icosphere(0));
  for (Index slot = 0; at(slot) < c->wall.edge_count(); ++slot) {
    const std::array<Index, 2>& v = c->topology.edge2vertex[at(c->wall.edges[at(slot)])];
    const Vec3 middle = (c->mesh.vertices[at(v[0])] + c->mesh.vertices[at(v[1])]).normalized();
    EXPECT_LT((c->placement->edge_nodes(slot, 2)[0] - middle).norm(), 1e-14);
  }
}

TEST(Placement, KeepsFacesThatTurnFarUnfolded) {
  // 80 triangles on an ellipsoid 3:1:0.5: closest points fold 92 cells, lines along the normals
  // none.
  const Vec3 axes(3.0, 1.0, 0.5);
  const auto c = make_case(layers_on(stretched(icosphere(1), axes), {0.0, 1e-3},
                                     [&](const Vec3& x) -> Vec3 {
                                       return x.cwiseQuotient(axes.cwiseProduct(axes)).normalized();
                                     }),
                           make_ellipsoid(Vec3::Zero(), axes));
  double lowest = 1.0;
  // At order 3 two of these faces turn a little beyond 90 degrees (lowest ratio -0.009).
  for (int q : {2, 4}) {
    for (Index slot = 0; at(slot) < c->wall.face_count(); ++slot) {
      const Points nodes = face_points(*c, slot, q);
      const JacobianBounds bounds = certify_face(Shape::triangle, q, nodes);
      EXPECT_EQ(bounds.verdict, Verdict::valid) << "order " << q << ", face " << slot;
      lowest = std::min(lowest, bounds.jacobian_ratio);
      for (const Vec3& x : nodes) EXPECT_NEAR(x.cwiseQuotient(axes).norm(), 1.0, 1e-13);
    }
  }
  EXPECT_GT(lowest, 0.0);
}

TEST(Placement, StaysInThePlaneThatTheWallEndsOn) {
  // A quarter of a torus: its cut faces lie in the planes y = 0 and x = 0.
  const auto point = [](double u, double v) {
    const double a = 0.5 * M_PI * u, b = 2.0 * M_PI * v;
    const double w = 3.0 + std::cos(b);
    return Vec3(w * std::cos(a), w * std::sin(a), std::sin(b));
  };
  SurfaceMesh strip = grid(3, 8, point);
  LayerOptions options;
  options.lateral_entity = [](const Vec3& x) {
    if (x.y() < 1e-9) return 11;
    return x.x() < 1e-9 ? 12 : 13;
  };
  // The strip is not closed around the tube: its seam (z = 0, outside) is patch 13 and stays
  // straight.
  const auto away = [](const Vec3& x) -> Vec3 {
    return (x - 3.0 * Vec3(x.x(), x.y(), 0.0).normalized()).normalized();
  };
  const auto c = make_case(layers_on(strip, {0.0, 0.1}, away, options),
                           make_torus(Vec3::Zero(), Vec3::UnitZ(), 3.0, 1.0));
  std::size_t in_planes = 0;
  for (Index slot = 0; at(slot) < c->wall.edge_count(); ++slot) {
    const std::array<Index, 2>& v = c->topology.edge2vertex[at(c->wall.edges[at(slot)])];
    for (Eigen::Index axis : {0, 1}) {
      if (std::abs(c->mesh.vertices[at(v[0])][axis]) > 1e-9) continue;
      if (std::abs(c->mesh.vertices[at(v[1])][axis]) > 1e-9) continue;
      ++in_planes;
      for (const Vec3& x : c->placement->edge_nodes(slot, 4)) {
        EXPECT_NEAR(x[axis], 0.0, 4e-16);
        const double tube = std::hypot(std::hypot(x.x(), x.y()) - 3.0, x.z());
        EXPECT_NEAR(tube, 1.0, 1e-13);
      }
    }
  }
  EXPECT_EQ(in_planes, 16u);
}

TEST(Placement, LoweredFaceIsTheElevatedLowerPolynomialAndNeighboursFollow) {
  for (int cap : {1, 2, 3}) {
    const auto c = sphere(icosphere(1));
    const Points low = face_points(*c, 7, cap);

    const std::vector<Index> changed = c->placement->lower({{7, cap}});

    EXPECT_EQ(c->placement->face_cap(7), cap);
    const Points high = face_points(*c, 7, 4);
    const MatX& elevate = elevation_matrix(Shape::triangle, cap, 4);
    for (std::size_t r = 0; r < high.size(); ++r) {
      Vec3 expected = Vec3::Zero();
      for (std::size_t k = 0; k < low.size(); ++k) {
        expected += elevate(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k)) * low[k];
      }
      EXPECT_LT((high[r] - expected).norm(), 1e-14);
    }
    EXPECT_EQ(changed.size(), 4u);  // the face and the three across its edges
    EXPECT_TRUE(std::is_sorted(changed.begin(), changed.end()));
    for (int q = 2; q <= 4; ++q) EXPECT_LE(largest_gap(*c, q), 1e-15);
    for (Index slot : changed) {
      if (slot == 7) continue;
      const Points nodes = face_points(*c, slot, 4);
      for (int node : interior_nodes(Shape::triangle, 4)) {
        EXPECT_NEAR(nodes[static_cast<std::size_t>(node)].norm(), 1.0, 1e-14);
      }
    }
    EXPECT_TRUE(c->placement->lower({{7, cap}}).empty()) << "caps only fall";
    EXPECT_TRUE(c->placement->lower({{7, 4}}).empty()) << "caps only fall";
  }
}

TEST(Placement, LoweredStepByStepEndsLikeLoweredAtOnce) {
  const auto a = sphere(cubed_sphere(2)), b = sphere(cubed_sphere(2));

  static_cast<void>(a->placement->lower({{3, 3}}));
  static_cast<void>(a->placement->lower({{3, 1}}));
  static_cast<void>(b->placement->lower({{3, 1}}));

  for (Index slot = 0; at(slot) < a->wall.face_count(); ++slot) {
    for (int q = 2; q <= 4; ++q) EXPECT_EQ(face_points(*a, slot, q), face_points(*b, slot, q));
  }
  for (const Vec3& u : a->placement->face_displacement(3, 4)) EXPECT_EQ(u, Vec3::Zero());
}

}  // namespace
}  // namespace camber
