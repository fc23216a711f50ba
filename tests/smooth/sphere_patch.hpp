#pragma once
// A patch of faces on the unit sphere whose inner nodes may slide.
#include <camber/basis/lagrange.hpp>
#include <camber/smooth/surface_patch.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>
#include <vector>

namespace camber::testing {

/// Unit sphere by longitude and latitude.
inline SurfaceSample on_sphere(Index, const Vec2& uv) {
  const double cu = std::cos(uv[0]), su = std::sin(uv[0]), cv = std::cos(uv[1]),
               sv = std::sin(uv[1]);
  return {{cv * cu, cv * su, sv}, {-cv * su, cv * cu, 0.0}, {-sv * cu, -sv * su, cv}};
}

/// Two by two quadrilaterals (or eight triangles) of longitude and latitude on the sphere; the
/// outer border is fixed, all else may slide. Every second face is walked clockwise, as frames of
/// faces are.
inline SurfacePatch sphere_patch(int order, bool is_triangles, double half_width) {
  SurfacePatch patch;
  patch.order = order;
  const int n = 2 * order;  // lattice steps across
  const auto node = [&](int i, int j) { return static_cast<Index>(j * (n + 1) + i); };
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) {
      const Vec2 uv(half_width * (2.0 * i / n - 1.0), half_width * (2.0 * j / n - 1.0));
      patch.uv.push_back(uv);
      patch.nodes.push_back(on_sphere(0, uv).point);
      const bool is_border = i == 0 || j == 0 || i == n || j == n;
      const bool is_corner = i % order == 0 && j % order == 0;
      patch.is_free.push_back(!is_border && !is_corner);
    }
  }
  const auto add = [&](Shape shape, std::vector<std::array<int, 2>> corners) {
    const bool is_clockwise = patch.faces.size() % 2 == 1;
    if (is_clockwise) std::reverse(corners.begin(), corners.end());
    SurfaceFace face;
    face.shape = shape;
    for (const Vec3& xi : lattice_xi(shape, order)) {
      std::array<double, 4> lattice{}, w{};
      lagrange_values(shape, 1, xi, std::span(lattice.data(), corners.size()));
      for (std::size_t c = 0; c < corners.size(); ++c) {
        w[c] = lattice[static_cast<std::size_t>(lattice_map(shape, 1).corner[c])];
      }
      double i = 0.0, j = 0.0;
      Vec3 straight = Vec3::Zero();
      for (std::size_t c = 0; c < corners.size(); ++c) {
        i += w[c] * corners[c][0];
        j += w[c] * corners[c][1];
        straight += w[c] * patch.nodes[at(node(corners[c][0], corners[c][1]))];
      }
      face.nodes.push_back(
          node(static_cast<int>(std::lround(i)), static_cast<int>(std::lround(j))));
      face.straight.push_back(straight);
    }
    for (std::size_t c = 0; c < corners.size(); ++c) {
      const Vec3& x = patch.nodes[at(node(corners[c][0], corners[c][1]))];
      face.corner_normal[c] = is_clockwise ? Vec3(-x) : x;
    }
    patch.faces.push_back(std::move(face));
  };
  for (int j = 0; j < n; j += order) {
    for (int i = 0; i < n; i += order) {
      const std::array<int, 2> a{i, j}, b{i + order, j}, c{i + order, j + order}, d{i, j + order};
      if (is_triangles) {
        add(Shape::triangle, {a, b, c});
        add(Shape::triangle, {a, c, d});
      } else {
        add(Shape::quadrilateral, {a, b, c, d});
      }
    }
  }
  return patch;
}

inline void shake(SurfacePatch& patch, double size, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform(-size, size);
  for (std::size_t i = 0; i < patch.nodes.size(); ++i) {
    if (!patch.is_free[i]) continue;
    patch.uv[i] += Vec2(uniform(random), uniform(random));
    patch.nodes[i] = on_sphere(0, patch.uv[i]).point;
  }
}

}  // namespace camber::testing
