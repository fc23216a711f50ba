#pragma once
// The paper's cost of one sub-triangle or sub-tetrahedron, for double and for dual numbers.
#include <camber/metric/biased_average.hpp>
#include <camber/metric/cost.hpp>
#include <camber/metric/weight_matrix.hpp>

#include <array>
#include <cmath>
#include <span>

namespace camber {

/// Corners of a sub-triangle (d = 2) or sub-tetrahedron (d = 3) in space.
template <Scalar T, int d>
using SimplexCorners = std::array<Vec<T, 3>, static_cast<std::size_t>(d) + 1>;

/// |x_a - x_b| of all edges, in the order of the weight matrices: 01, 02, (03,) 12, (13, 23).
template <Scalar T>
[[nodiscard]] std::array<T, 3> edge_lengths(const SimplexCorners<T, 2>& x) {
  return {frobenius_norm(x[1] - x[0]), frobenius_norm(x[2] - x[0]), frobenius_norm(x[2] - x[1])};
}
template <Scalar T>
[[nodiscard]] std::array<T, 6> edge_lengths(const SimplexCorners<T, 3>& x) {
  return {frobenius_norm(x[1] - x[0]), frobenius_norm(x[2] - x[0]), frobenius_norm(x[3] - x[0]),
          frobenius_norm(x[2] - x[1]), frobenius_norm(x[3] - x[1]), frobenius_norm(x[3] - x[2])};
}

/// a x b.
template <Scalar T>
[[nodiscard]] Vec<T, 3> cross_product(const Vec<T, 3>& a, const Vec<T, 3>& b) {
  return {a(1) * b(2) - a(2) * b(1), a(2) * b(0) - a(0) * b(2), a(0) * b(1) - a(1) * b(0)};
}

/// What a sub-simplex is compared with: itself on the computational mesh.
template <int d>
struct IdealSimplex {
  Mat<double, d> W_inverse;       // of the weight matrix from the edge lengths, Figs 6 and 9
  Vec3 normal = Vec3::Zero();     // d = 2: of the computational triangle, twice its area long
  double inscribed_radius = 0.0;  // [length]
};
[[nodiscard]] IdealSimplex<2> ideal_simplex(const SimplexCorners<double, 2>& X);
[[nodiscard]] IdealSimplex<3> ideal_simplex(const SimplexCorners<double, 3>& X);

/// Weighted condition number of a sub-triangle, eq. (4), from the lengths of its edges.
template <Scalar T>
[[nodiscard]] T sub_condition_number(const SimplexCorners<T, 2>& x, const IdealSimplex<2>& ideal) {
  return weighted_condition_number<T, 2>(triangle_weight_matrix<T>(edge_lengths<T>(x)),
                                         ideal.W_inverse);
}

/// Normalised Jacobian by the area of the sub-triangle, signed by the normals (Fig. 8a).
template <Scalar T>
[[nodiscard]] T sub_normalized_jacobian(const SimplexCorners<T, 2>& x,
                                        const IdealSimplex<2>& ideal) {
  return surface_normalized_jacobian<T>(cross_product<T>(x[1] - x[0], x[2] - x[0]), ideal.normal);
}

/// S = A W^-1 of a sub-tetrahedron, from its edge vectors: equal to that from its edge lengths
/// (Fig. 9) up to a rotation or reflection, which the norms in eq. (6) do not see. WCN is
/// condition_number(S), the normalised Jacobian by volume (Fig. 11a) det S.
[[nodiscard]] Mat3 sub_map(const SimplexCorners<double, 3>& x, const IdealSimplex<3>& ideal);

/// Biased weighting, eq. (5), of the normalised Jacobians at points of a sub-simplex, C = F = tau
/// (Figs 8b, 8c, 11b, 11c). "Assuming the range is from 0 to 1": larger values count as 1, as in
/// eq. (2). The lowest is returned as it is where it is not positive.
/// @param tau  not empty [-]
template <Scalar T>
[[nodiscard]] T biased_jacobian(std::span<const T> tau) {
  using std::min;
  T lowest = min(T(1.0), tau[0]), sum(0.0);
  for (const T& t : tau) {
    const T capped = min(T(1.0), t);
    lowest = min(lowest, capped);
    sum += capped;
  }
  return biased_average<T, T>(lowest, lowest, sum / T(static_cast<double>(tau.size())));
}

}  // namespace camber
