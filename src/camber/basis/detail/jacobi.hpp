#pragma once
// Jacobi polynomials with beta = 0.
#include <camber/basis/lattice.hpp>

#include <array>
#include <cstddef>

namespace camber::detail {

/// P_k^(alpha,0)(t) and its derivative, k = 0..n, in the first n + 1 places.
template <class T>
struct JacobiValues {
  std::array<T, k_max_lattice_order + 1> value;
  std::array<T, k_max_lattice_order + 1> slope;
};

/// By the three-term recurrence (DLMF 18.9.2 with beta = 0), n <= k_max_lattice_order.
template <class T>
[[nodiscard]] JacobiValues<T> jacobi_values(int n, int alpha, T t) {
  JacobiValues<T> P;
  P.value[0] = 1;
  P.slope[0] = 0;
  if (n > 0) {
    P.value[1] = (T(alpha + 2) * t + T(alpha)) / 2;
    P.slope[1] = T(alpha + 2) / 2;
  }
  for (int k = 1; k < n; ++k) {
    const auto at = static_cast<std::size_t>(k);
    const T c = T(2 * k + alpha);  // 2k + alpha + beta
    const T left = T(2 * (k + 1)) * T(k + alpha + 1) * c;
    const T slope = (c + 1) * (c + 2) * c;
    const T shift = (c + 1) * T(alpha) * T(alpha);
    const T back = T(2 * (k + alpha)) * T(k) * (c + 2);
    P.value[at + 1] = ((slope * t + shift) * P.value[at] - back * P.value[at - 1]) / left;
    P.slope[at + 1] =
        ((slope * t + shift) * P.slope[at] + slope * P.value[at] - back * P.slope[at - 1]) / left;
  }
  return P;
}

}  // namespace camber::detail
