#pragma once
// Surface meshes with and without sharp edges.
#include <camber/reconstruct/features.hpp>

#include <cmath>
#include <numbers>

#include "layer_meshes.hpp"

namespace camber::testing {

inline FacetMesh facets_of(const SurfaceMesh& surface) { return {surface.points, surface.faces}; }

/// Closed cylinder of radius 1 and height 2 round z: n quads round, caps of quads round a fan of
/// triangles.
inline FacetMesh capped_cylinder(int n) {
  FacetMesh mesh;
  const int layers = std::max(1, n / 3), rings = std::max(1, n / 6);
  const auto add_ring = [&](double radius, double z) {
    const Index first = static_cast<Index>(mesh.points.size());
    for (int i = 0; i < n; ++i) {
      const double a = 2.0 * std::numbers::pi * i / n;
      mesh.points.emplace_back(radius * std::cos(a), radius * std::sin(a), z);
    }
    return first;
  };
  const auto join = [&](Index low, Index high) {
    for (Index i = 0; i < n; ++i) {
      const Index j = (i + 1) % n;
      mesh.facets.push_back({low + i, low + j, high + j, high + i});
    }
  };
  const auto close = [&](Index ring, double z, bool is_top) {
    for (int r = rings - 1; r > 0; --r) {
      const Index inner = add_ring(static_cast<double>(r) / rings, z);
      is_top ? join(ring, inner) : join(inner, ring);
      ring = inner;
    }
    const Index centre = static_cast<Index>(mesh.points.size());
    mesh.points.emplace_back(0.0, 0.0, z);
    for (Index i = 0; i < n; ++i) {
      const Index a = ring + i, b = ring + (i + 1) % n;
      mesh.facets.push_back(is_top ? std::array<Index, 4>{a, b, centre, k_none}
                                   : std::array<Index, 4>{b, a, centre, k_none});
    }
  };
  Index ring = add_ring(1.0, -1.0);
  close(ring, -1.0, false);
  for (int k = 1; k <= layers; ++k) {
    const Index next = add_ring(1.0, -1.0 + 2.0 * k / layers);
    join(ring, next);
    ring = next;
  }
  close(ring, 1.0, true);
  return mesh;
}

/// Surface of [0,1]^3, n x n quads a side.
inline FacetMesh box_surface(int n) {
  FacetMesh mesh;
  for (Index k = 0; k <= n; ++k) {
    for (Index j = 0; j <= n; ++j) {
      for (Index i = 0; i <= n; ++i) mesh.points.push_back(Vec3(i, j, k) / n);
    }
  }
  const auto at3 = [n](int axis, Index side, Index a, Index b) {
    std::array<Index, 3> ijk{};
    ijk[static_cast<std::size_t>(axis)] = side;
    ijk[static_cast<std::size_t>((axis + 1) % 3)] = a;
    ijk[static_cast<std::size_t>((axis + 2) % 3)] = b;
    return ijk[0] + (n + 1) * (ijk[1] + (n + 1) * ijk[2]);
  };
  for (int axis = 0; axis < 3; ++axis) {
    for (Index a = 0; a < n; ++a) {
      for (Index b = 0; b < n; ++b) {
        const auto quad = [&](Index side) {
          return std::array<Index, 4>{at3(axis, side, a, b), at3(axis, side, a + 1, b),
                                      at3(axis, side, a + 1, b + 1), at3(axis, side, a, b + 1)};
        };
        mesh.facets.push_back(quad(n));
        std::array<Index, 4> low = quad(0);
        std::swap(low[1], low[3]);
        mesh.facets.push_back(low);
      }
    }
  }
  return mesh;
}

}  // namespace camber::testing
