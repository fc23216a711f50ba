#include <camber/smooth/detail/energy_kernel.hpp>

namespace camber::detail {

void energy_scalar(EnergyKind kind, const EnergyView& view, const double* x, const double* corners,
                   const double* delta, double* slope, double* energy, double* least) {
  energy_kernel<1>(kind, view, x, corners, delta, slope, energy, least);
}

void energy_two_lanes(EnergyKind kind, const EnergyView& view, const double* x,
                      const double* corners, const double* delta, double* slope, double* energy,
                      double* least) {
  energy_kernel<2>(kind, view, x, corners, delta, slope, energy, least);
}

void stiffness_scalar(const EnergyView& view, const double* corners, const int* linear,
                      const int* pairs, int pair_count, double* room, double* sums) {
  stiffness_kernel<1>(view, corners, linear, pairs, pair_count, room, sums);
}

void stiffness_two_lanes(const EnergyView& view, const double* corners, const int* linear,
                         const int* pairs, int pair_count, double* room, double* sums) {
  stiffness_kernel<2>(view, corners, linear, pairs, pair_count, room, sums);
}

}  // namespace camber::detail
