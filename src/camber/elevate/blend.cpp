#include <camber/basis/lagrange.hpp>
#include <camber/elevate/blend.hpp>

namespace camber {
namespace {

/// The edge's displacement at s, walking from its first to its second corner.
Vec3 edge_value(const LatticeMap& map, std::size_t edge, int q, std::span<const Vec3> u, double s) {
  std::array<double, 8> N{};
  lagrange_values(Shape::line, q, Vec3(s, 0.0, 0.0),
                  std::span(N.data(), static_cast<std::size_t>(q) + 1));
  Vec3 sum = Vec3::Zero();
  for (std::size_t k = 0; k < map.edge[edge].size(); ++k) {
    sum += N[k] * u[static_cast<std::size_t>(map.edge[edge][k])];
  }
  return sum;
}

}  // namespace

void corner_weights(Shape shape, const Vec3& xi, std::array<double, 4>& weight) {
  const double x = xi.x(), y = xi.y();
  if (shape == Shape::triangle) {
    weight = {1.0 - x - y, x, y, 0.0};
  } else {
    weight = {(1.0 - x) * (1.0 - y), x * (1.0 - y), x * y, (1.0 - x) * y};
  }
}

void blend_face_interior(Shape shape, int q, std::span<Vec3> u) {
  const LatticeMap& map = lattice_map(shape, q);
  for (int node : interior_nodes(shape, q)) {
    const Vec3& xi = lattice_xi(shape, q)[static_cast<std::size_t>(node)];
    Vec3 sum = Vec3::Zero();
    if (shape == Shape::triangle) {
      std::array<double, 4> l{};
      corner_weights(shape, xi, l);
      for (std::size_t e = 0; e < 3; ++e) {
        const double a = l[e], b = l[(e + 1) % 3];
        sum += (a + b) * edge_value(map, e, q, u, b / (a + b));
      }
    } else {
      const double x = xi.x(), y = xi.y();
      sum = (1.0 - y) * edge_value(map, 0, q, u, x) + x * edge_value(map, 1, q, u, y) +
            y * edge_value(map, 2, q, u, 1.0 - x) + (1.0 - x) * edge_value(map, 3, q, u, 1.0 - y);
    }
    u[static_cast<std::size_t>(node)] = sum;
  }
}

}  // namespace camber
