#pragma once
#include <camber/dual/scalar.hpp>

namespace camber {

/// Normalised Jacobian tau = Jp/Jc = det(A W^-1): physical over computational volume.
/// Source: [karman2022] eq. (2), (3), "Volume Normalized Jacobian"; on a sub-simplex A and W are
/// edge matrices, at a point of the element the Jacobians of the two maps.
/// @param A      shape (d,d) [length]
/// @param W_inv  shape (d,d), inverse of the same matrix of the straight copy [1/length]
/// @return       tau [-]; <= 0 where the element is inverted
template <Scalar T, int d>
[[nodiscard]] T normalized_jacobian(const Mat<T, d>& A, const Mat<double, d>& W_inv) {
  const Mat<T, d> S = A * W_inv.template cast<T>();
  return S.determinant();
}

/// The same for a surface: |n| / |N| with the sign of n . N, n = a1 x a2 and N = w1 x w2 the
/// normals of the physical and the computational face at the same xi. Source: [karman2022] "Surface
/// Normalized Jacobian".
/// @param n, N  normals, lengths = area per reference area [length^2]; N must not vanish
/// @return      [-]
template <Scalar T>
[[nodiscard]] T surface_normalized_jacobian(const Vec<T, 3>& n, const Vec3& N) {
  const T ratio = frobenius_norm(n) / T(N.norm());
  T along(0.0);  // n . N
  for (int i = 0; i < 3; ++i) along += n(i) * T(N(i));
  return value(along) < 0.0 ? -ratio : ratio;
}

}  // namespace camber
