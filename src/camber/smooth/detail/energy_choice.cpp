#include <camber/base/processor.hpp>
#include <camber/smooth/detail/energy_view.hpp>

namespace camber::detail {

void energy_scalar(EnergyKind, const EnergyView&, const double*, const double*, const double*,
                   double*, double*, double*);
void energy_two_lanes(EnergyKind, const EnergyView&, const double*, const double*, const double*,
                      double*, double*, double*);
void energy_four_lanes(EnergyKind, const EnergyView&, const double*, const double*, const double*,
                       double*, double*, double*);
void energy_eight_lanes(EnergyKind, const EnergyView&, const double*, const double*, const double*,
                        double*, double*, double*);

void stiffness_scalar(const EnergyView&, const double*, const int*, const int*, int, double*,
                      double*);
void stiffness_two_lanes(const EnergyView&, const double*, const int*, const int*, int, double*,
                         double*);
void stiffness_four_lanes(const EnergyView&, const double*, const int*, const int*, int, double*,
                          double*);
void stiffness_eight_lanes(const EnergyView&, const double*, const int*, const int*, int, double*,
                           double*);

EnergyKernelChoice energy_kernel_of(int lanes) {
  if (!has_lanes(lanes)) return {nullptr, nullptr, 0};
#if defined(CAMBER_KERNELS_AVX512)
  if (lanes == 8) return {energy_eight_lanes, stiffness_eight_lanes, 8};
#endif
#if defined(CAMBER_KERNELS_AVX2)
  if (lanes == 4) return {energy_four_lanes, stiffness_four_lanes, 4};
#endif
  if (lanes == 2) return {energy_two_lanes, stiffness_two_lanes, 2};
  return {energy_scalar, stiffness_scalar, 1};
}

}  // namespace camber::detail
