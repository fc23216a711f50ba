#pragma once
#include <camber/dual/scalar.hpp>

#include <algorithm>
#include <span>

namespace camber {

/// Biased average:  F = F_min (1 - C_min) + F_avg C_min;  F = F_min where C_min < 0.
/// Source: [karman2022] eq. (5). The worse the minimum, the more it counts.
/// @param C_min  smallest cost around the node [-], <= 1
/// @param F_min  the averaged quantity at that minimum; a number or a vector
/// @param F_avg  its plain average
/// @return       in the unit of F
template <Scalar T, class F>
[[nodiscard]] F biased_average(const T& C_min, const F& F_min, const F& F_avg) {
  if (value(C_min) < 0.0) return F_min;
  return F_min * (T(1.0) - C_min) + F_avg * C_min;
}

/// Biased average of costs by themselves (C = F).
/// @param costs  not empty [-]
[[nodiscard]] inline double biased_average(std::span<const double> costs) {
  double sum = 0.0, lowest = costs.front();
  for (double c : costs) {
    sum += c;
    lowest = std::min(lowest, c);
  }
  return biased_average(lowest, lowest, sum / static_cast<double>(costs.size()));
}

}  // namespace camber
