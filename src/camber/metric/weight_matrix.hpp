#pragma once
#include <camber/dual/scalar.hpp>

#include <array>

namespace camber {

/// Edge matrix of a simplex from its vertices: column c = x[c+1] - x[0].
/// @param x  d + 1 vertices [length]
template <Scalar T, int d>
[[nodiscard]] Mat<T, d> edge_matrix(const std::array<Vec<T, d>, std::size_t{d} + 1>& x) {
  Mat<T, d> A;
  for (int c = 0; c < d; ++c) A.col(c) = x[static_cast<std::size_t>(c + 1)] - x[0];
  return A;
}

/// Edge matrix of a triangle from the lengths of its edges, in its own plane:
///   W = [ l01   l02 cos t ]      cos t = (l01^2 + l02^2 - l12^2) / (2 l01 l02)
///       [ 0     l02 sin t ]
/// Source: [karman2022] Fig. 6. Equal to the matrix of edge vectors up to a rotation.
/// @param lengths  l01, l02, l12 > 0 [length]; squares of lengths that fit no triangle give sin t =
/// 0
/// @return         upper triangular, det W = twice the area >= 0 [length^2]
template <Scalar T>
[[nodiscard]] Mat<T, 2> triangle_weight_matrix(const std::array<T, 3>& lengths) {
  using std::sqrt;
  const T& l01 = lengths[0];
  const T& l02 = lengths[1];
  const T& l12 = lengths[2];
  const T x = (l01 * l01 + l02 * l02 - l12 * l12) / (T(2.0) * l01);  // l02 cos t
  const T y_squared = l02 * l02 - x * x;                             // (l02 sin t)^2
  Mat<T, 2> W;
  W << l01, x, T(0.0), value(y_squared) > 0.0 ? sqrt(y_squared) : T(0.0);
  return W;
}

/// Edge matrix of a tetrahedron from the lengths of its six edges: vertex 1 on the first axis,
/// vertex 2 in the first plane, vertex 3 above it (the Cholesky factor of the Gram matrix of the
/// edges). Source: [karman2022] Fig. 9. Equal to the matrix of edge vectors up to a rotation (or
/// reflection: the lengths do not know the orientation; the ideal tetrahedron is taken as
/// positive).
/// @param lengths  l01, l02, l03, l12, l13, l23 > 0 [length]
/// @return         upper triangular, det W = six times the volume >= 0 [length^3]
template <Scalar T>
[[nodiscard]] Mat<T, 3> tetrahedron_weight_matrix(const std::array<T, 6>& lengths) {
  using std::sqrt;
  const auto& [l01, l02, l03, l12, l13, l23] = lengths;
  const Mat<T, 2> base = triangle_weight_matrix<T>({l01, l02, l12});
  const T two(2.0);
  // e_a . e_b = (|e_a|^2 + |e_b|^2 - |e_a - e_b|^2) / 2
  const T g13 = (l01 * l01 + l03 * l03 - l13 * l13) / two;
  const T g23 = (l02 * l02 + l03 * l03 - l23 * l23) / two;
  const T x = g13 / base(0, 0);
  const T y = value(base(1, 1)) > 0.0 ? (g23 - x * base(0, 1)) / base(1, 1) : T(0.0);
  const T z_squared = l03 * l03 - x * x - y * y;
  Mat<T, 3> W;
  W << base(0, 0), base(0, 1), x,  //
      T(0.0), base(1, 1), y,       //
      T(0.0), T(0.0), value(z_squared) > 0.0 ? sqrt(z_squared) : T(0.0);
  return W;
}

}  // namespace camber
