#include <camber/geom/analytic_model.hpp>

#include <cmath>
#include <numbers>

#include "bodies.hpp"

namespace camber::testing {
namespace {

constexpr int k_poles = 9;

double rise(double along, double away) {
  if (away <= 0.0 || away >= 1.0) return 0.0;
  return 0.12 * std::pow(std::sin(std::numbers::pi * away), 2) * (0.5 + along);
}

BsplineSurface floor_surface() {
  return bump([](double x, double y) { return rise(y, x); }, k_poles);
}
BsplineSurface wall_surface() {
  return bump([](double y, double z) { return rise(y, z); }, k_poles, Vec3::UnitY(), Vec3::UnitZ());
}

}  // namespace

MeshData concave_corner(const std::vector<double>& heights, Index m) {
  const BsplineSurface floor = floor_surface(), wall = wall_surface();
  const Index n = static_cast<Index>(heights.size());
  MeshData data;
  data.source = "corner";
  const auto vertex = [&](Index i, Index j, Index k) { return i + n * (j + m * k); };
  for (Index k = 0; k < n; ++k) {
    for (Index j = 0; j < m; ++j) {
      for (Index i = 0; i < n; ++i) {
        const double x = heights[at(i)], z = heights[at(k)], y = static_cast<double>(j) / (m - 1);
        data.points.emplace_back(x + (1.0 - x) * wall.jet({y, z}).s.x(), y,
                                 z + (1.0 - z) * floor.jet({x, y}).s.z());
      }
    }
  }
  const auto quad = [&](int entity, Index a, Index b, Index c, Index d) {
    append_element(data, Shape::quadrilateral, entity, {a, b, c, d});
  };
  for (Index k = 0; k + 1 < n; ++k) {
    for (Index j = 0; j + 1 < m; ++j) {
      for (Index i = 0; i + 1 < n; ++i) {
        std::array<Index, 8> v{};
        for (std::size_t b = 0; b < 8; ++b) {
          v[b] = vertex(i + static_cast<Index>(b & 1), j + static_cast<Index>((b >> 1) & 1),
                        k + static_cast<Index>(b >> 2));
        }
        append_element(data, Shape::hexahedron, 1,
                       {v[0], v[1], v[3], v[2], v[4], v[5], v[7], v[6]});
        if (k == 0) quad(1, v[0], v[1], v[3], v[2]);
        if (i == 0) quad(2, v[0], v[2], v[6], v[4]);
        if (k + 2 == n) quad(11, v[4], v[5], v[7], v[6]);
        if (i + 2 == n) quad(12, v[1], v[3], v[7], v[5]);
        if (j == 0) quad(13, v[0], v[1], v[5], v[4]);
        if (j + 2 == m) quad(14, v[2], v[3], v[7], v[6]);
      }
    }
  }
  return data;
}

std::unique_ptr<GeometryModel> concave_corner_model() {
  std::vector<std::unique_ptr<GeometryModel>> parts;
  parts.push_back(make_bspline_patch(floor_surface()));
  parts.push_back(make_bspline_patch(wall_surface()));
  return joined(std::move(parts));
}

}  // namespace camber::testing
