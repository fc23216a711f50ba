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
  if (lanes == 1) return {kernel_scalar, 1};
  if (lanes == 2) return {kernel_two_lanes, 2};
#if defined(CAMBER_VALIDITY_AVX2)
  if (lanes == 4 && __builtin_cpu_supports("avx2") != 0) return {kernel_four_lanes, 4};
#endif
#if defined(CAMBER_VALIDITY_AVX512)
  if (lanes == 8 && __builtin_cpu_supports("avx512f") != 0) return {kernel_eight_lanes, 8};
#endif
  return {nullptr, 0};
}

KernelChoice scalar_kernel() { return kernel_of(1); }

KernelChoice widest_kernel() {
  for (int lanes = 8; lanes > 2; lanes /= 2) {
    const KernelChoice kernel = kernel_of(lanes);
    if (kernel.run != nullptr) return kernel;
  }
  return kernel_of(2);
}

}  // namespace camber::detail
