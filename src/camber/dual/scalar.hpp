#pragma once
// What a formula needs from its number type, so that it is written once for double and for Dual.
#include <camber/base/vec.hpp>
#include <camber/dual/dual.hpp>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <limits>

namespace camber {

template <class T>
inline constexpr bool is_dual = false;
template <int N>
inline constexpr bool is_dual<Dual<N>> = true;

/// double or Dual<N>.
template <class T>
concept Scalar = std::same_as<T, double> || is_dual<T>;

template <Scalar T, int d>
using Mat = Eigen::Matrix<T, d, d>;
template <Scalar T, int d>
using Vec = Eigen::Matrix<T, d, 1>;

/// The plain value, without derivatives.
[[nodiscard]] inline double value(double x) { return x; }
template <int N>
[[nodiscard]] double value(const Dual<N>& x) {
  return x.v;
}

template <Scalar T>
[[nodiscard]] T infinity() {
  return T(std::numeric_limits<double>::infinity());
}

/// |M|_F, the root of the sum of squares of all entries of a matrix or vector.
template <class Derived>
[[nodiscard]] typename Derived::Scalar frobenius_norm(const Eigen::MatrixBase<Derived>& M) {
  using std::sqrt;
  typename Derived::Scalar sum(0.0);
  for (Eigen::Index j = 0; j < M.cols(); ++j) {
    for (Eigen::Index i = 0; i < M.rows(); ++i) sum += M(i, j) * M(i, j);
  }
  return sqrt(sum);
}

}  // namespace camber
