#include <camber/smooth/detail/energy_kernel.hpp>

namespace camber::detail {

void energy_eight_lanes(EnergyKind kind, const EnergyView& view, const double* x,
                        const double* corners, const double* delta, double* slope, double* energy,
                        double* least) {
  energy_kernel<8>(kind, view, x, corners, delta, slope, energy, least);
}

void stiffness_eight_lanes(const EnergyView& view, const double* corners, const int* linear,
                           const int* pairs, int pair_count, double* room, double* sums) {
  stiffness_kernel<8>(view, corners, linear, pairs, pair_count, room, sums);
}

}  // namespace camber::detail
