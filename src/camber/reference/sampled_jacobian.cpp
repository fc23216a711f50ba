#include <camber/basis/lagrange.hpp>
#include <camber/reference/sampled_jacobian.hpp>

#include <limits>

namespace camber::reference {

namespace {

Points corner_points(Shape shape, int p, std::span<const Vec3> nodes) {
  Points x;
  for (int n : lattice_map(shape, p).corner) x.push_back(nodes[static_cast<std::size_t>(n)]);
  return x;
}

template <class Value>
SampledRange sample(Shape shape, int n, const Value& value) {
  SampledRange range{std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity(), Vec3::Zero()};
  for (const Vec3& xi : lattice_xi(shape, n)) {
    if (shape == Shape::pyramid && xi.z() == 1.0) continue;
    const double v = value(xi);
    if (v < range.minimum) {
      range.minimum = v;
      range.at_minimum = xi;
    }
    range.maximum = v > range.maximum ? v : range.maximum;
  }
  return range;
}

Vec3 normal(Shape shape, int p, std::span<const Vec3> nodes, const Vec3& xi) {
  const Mat3 A = jacobian(shape, p, nodes, xi);
  return A.col(0).cross(A.col(1));
}

}  // namespace

double jacobian_determinant(Shape shape, int p, std::span<const Vec3> nodes, const Vec3& xi) {
  return jacobian(shape, p, nodes, xi).determinant();
}

SampledRange sampled_jacobian(Shape shape, int p, std::span<const Vec3> nodes, int n) {
  return sample(shape, n,
                [&](const Vec3& xi) { return jacobian_determinant(shape, p, nodes, xi); });
}

SampledRange sampled_ratio(Shape shape, int p, std::span<const Vec3> nodes, int n) {
  const Points straight = straight_nodes(shape, p, corner_points(shape, p, nodes));
  return sample(shape, n, [&](const Vec3& xi) {
    return jacobian_determinant(shape, p, nodes, xi) / jacobian_determinant(shape, p, straight, xi);
  });
}

SampledRange sampled_normal(Shape shape, int p, std::span<const Vec3> nodes, int n) {
  const Points straight = straight_nodes(shape, p, corner_points(shape, p, nodes));
  return sample(shape, n, [&](const Vec3& xi) {
    const Vec3 N = normal(shape, p, straight, xi);
    return normal(shape, p, nodes, xi).dot(N) / N.squaredNorm();
  });
}

}  // namespace camber::reference
