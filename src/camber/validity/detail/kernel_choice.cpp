#include <camber/base/processor.hpp>
#include <camber/validity/detail/kernel_plan.hpp>

namespace camber::detail {

void kernel_scalar(const KernelPlan&, const StraightView*, const double*, double*,
                   const KernelOutput&);
void kernel_two_lanes(const KernelPlan&, const StraightView*, const double*, double*,
                      const KernelOutput&);
void kernel_four_lanes(const KernelPlan&, const StraightView*, const double*, double*,
                       const KernelOutput&);
void kernel_eight_lanes(const KernelPlan&, const StraightView*, const double*, double*,
                        const KernelOutput&);

KernelChoice kernel_of(int lanes) {
  if (!has_lanes(lanes)) return {nullptr, 0};
#if defined(CAMBER_KERNELS_AVX512)
  if (lanes == 8) return {kernel_eight_lanes, 8};
#endif
#if defined(CAMBER_KERNELS_AVX2)
  if (lanes == 4) return {kernel_four_lanes, 4};
#endif
  if (lanes == 2) return {kernel_two_lanes, 2};
  return {kernel_scalar, 1};
}

KernelChoice scalar_kernel() { return kernel_of(1); }
KernelChoice widest_kernel() { return kernel_of(widest_lanes()); }

}  // namespace camber::detail
