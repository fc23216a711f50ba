#include <camber/smooth/detail/energy_kernel.hpp>

namespace camber::detail {

void energy_four_lanes(EnergyKind kind, const EnergyView& view, const double* x,
                       const double* corners, const double* delta, double* slope, double* energy,
                       double* least) {
  energy_kernel<4>(kind, view, x, corners, delta, slope, energy, least);
}

}  // namespace camber::detail
