#pragma once
#include <camber/dual/scalar.hpp>

namespace camber {

/// Condition number of the map S = A W^-1 from the ideal to the physical simplex, WCN as below.
/// @return  >= 1 [-]; +inf if S is singular
template <Scalar T, int d>
[[nodiscard]] T condition_number(const Mat<T, d>& S) {
  if (value(S.determinant()) == 0.0) return infinity<T>();
  const Mat<T, d> S_inv = S.inverse();  // W A^-1 = S^-1
  return frobenius_norm(S) * frobenius_norm(S_inv) / T(d);
}

/// Weighted condition number of a sub-simplex:  WCN = |A W^-1|_F |W A^-1|_F / d.
/// Source: [karman2022] eq. (4), d = 2, and eq. (6), d = 3; |.|_F is the Frobenius norm.
/// @param A      shape (d,d), columns = edge vectors of the physical sub-simplex (d = 2: in its own
///               plane), or the Jacobian dx/dxi at a point [length]
/// @param W_inv  shape (d,d), inverse of the same matrix on the ideal mesh [1/length]
/// @return       >= 1 [-]; 1 iff A W^-1 is a scaled rotation or reflection; +inf if A is singular.
///               Blind to the sign of det A: inversion is the business of the size term, eq. (2).
/// Cost: two d x d products, one inverse, no allocation. Reentrant. Never throws.
template <Scalar T, int d>
[[nodiscard]] T weighted_condition_number(const Mat<T, d>& A, const Mat<double, d>& W_inv) {
  const Mat<T, d> S = A * W_inv.template cast<T>();
  return condition_number<T, d>(S);
}

}  // namespace camber
