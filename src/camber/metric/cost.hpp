#pragma once
#include <camber/metric/normalized_jacobian.hpp>
#include <camber/metric/weighted_condition_number.hpp>

namespace camber {

/// Cost of a sub-simplex or point:  C = min(1, tau) / WCN;  C = tau where tau <= 0.
/// Source: [karman2022] eq. (2) and the rule after eq. (5): where it is inverted the condition
/// number is not computed, so that inversion is repaired before shape.
/// @param tau  normalised Jacobian [-]
/// @param WCN  weighted condition number >= 1 [-]
/// @return     in (-inf, 1] [-]; 1 iff tau >= 1 and the shape is ideal. A reward: larger is better.
template <Scalar T>
[[nodiscard]] T cost(const T& tau, const T& WCN) {
  using std::min;
  return value(tau) <= 0.0 ? tau : min(T(1.0), tau) / WCN;
}

/// The same from the matrices: tau = det(A W^-1), WCN of the same.
/// @param A      shape (d,d) [length]
/// @param W_inv  shape (d,d) [1/length]
template <Scalar T, int d>
[[nodiscard]] T cost(const Mat<T, d>& A, const Mat<double, d>& W_inv) {
  const T tau = normalized_jacobian<T, d>(A, W_inv);
  return value(tau) <= 0.0 ? tau : cost(tau, weighted_condition_number<T, d>(A, W_inv));
}

}  // namespace camber
