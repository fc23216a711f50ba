#include <camber/basis/lagrange.hpp>
#include <camber/reference/sampled_jacobian.hpp>

#include <array>
#include <limits>
#include <map>
#include <mutex>
#include <vector>

namespace camber::reference {

namespace {

// Basis gradients at the lattice of order n, tabulated once for each (shape, p, n).
const Tabulation& survey(Shape shape, int p, int n) {
  static std::mutex mutex;
  static std::map<std::array<int, 3>, Tabulation> tables;
  const std::scoped_lock lock(mutex);
  const std::array<int, 3> key{static_cast<int>(shape), p, n};
  const auto found = tables.find(key);
  return found != tables.end()
             ? found->second
             : tables.emplace(key, tabulate(shape, p, lattice_xi(shape, n))).first->second;
}

// dx/dxi at every lattice point.
std::vector<Mat3> jacobians(Shape shape, int p, std::span<const Vec3> nodes, int n) {
  const Tabulation& table = survey(shape, p, n);
  MatX x(static_cast<Eigen::Index>(nodes.size()), 3);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    x.row(static_cast<Eigen::Index>(i)) = nodes[i].transpose();
  }
  std::vector<Mat3> all(static_cast<std::size_t>(table.values.rows()), Mat3::Zero());
  for (int d = 0; d < dimension(shape); ++d) {
    const MatX along = table.gradient[static_cast<std::size_t>(d)] * x;
    for (std::size_t q = 0; q < all.size(); ++q) {
      all[q].col(d) = along.row(static_cast<Eigen::Index>(q)).transpose();
    }
  }
  return all;
}

std::vector<Mat3> straight_jacobians(Shape shape, int p, std::span<const Vec3> nodes, int n) {
  Points corner;
  for (int c : lattice_map(shape, p).corner) corner.push_back(nodes[static_cast<std::size_t>(c)]);
  return jacobians(shape, p, straight_nodes(shape, p, corner), n);
}

// Range of value(q) over the lattice points q.
template <class Value>
SampledRange sample(Shape shape, int n, const Value& value) {
  SampledRange range{std::numeric_limits<double>::infinity(),
                     -std::numeric_limits<double>::infinity(), Vec3::Zero()};
  const std::span<const Vec3> points = lattice_xi(shape, n);
  for (std::size_t q = 0; q < points.size(); ++q) {
    if (shape == Shape::pyramid && points[q].z() == 1.0) continue;
    const double v = value(q);
    if (v < range.minimum) {
      range.minimum = v;
      range.at_minimum = points[q];
    }
    range.maximum = v > range.maximum ? v : range.maximum;
  }
  return range;
}

Vec3 normal(const Mat3& A) { return A.col(0).cross(A.col(1)); }

}  // namespace

double jacobian_determinant(Shape shape, int p, std::span<const Vec3> nodes, const Vec3& xi) {
  return jacobian(shape, p, nodes, xi).determinant();
}

SampledRange sampled_jacobian(Shape shape, int p, std::span<const Vec3> nodes, int n) {
  const std::vector<Mat3> A = jacobians(shape, p, nodes, n);
  return sample(shape, n, [&](std::size_t q) { return A[q].determinant(); });
}

SampledRange sampled_ratio(Shape shape, int p, std::span<const Vec3> nodes, int n) {
  const std::vector<Mat3> A = jacobians(shape, p, nodes, n);
  const std::vector<Mat3> W = straight_jacobians(shape, p, nodes, n);
  return sample(shape, n, [&](std::size_t q) { return A[q].determinant() / W[q].determinant(); });
}

SampledRange sampled_normal(Shape shape, int p, std::span<const Vec3> nodes, int n) {
  const std::vector<Mat3> A = jacobians(shape, p, nodes, n);
  const std::vector<Mat3> W = straight_jacobians(shape, p, nodes, n);
  return sample(shape, n, [&](std::size_t q) {
    const Vec3 N = normal(W[q]);
    return normal(A[q]).dot(N) / N.squaredNorm();
  });
}

}  // namespace camber::reference
