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

KernelChoice scalar_kernel() { return {kernel_scalar, 1}; }

KernelChoice widest_kernel() {
#if defined(CAMBER_VALIDITY_AVX512)
  if (__builtin_cpu_supports("avx512f") != 0) return {kernel_eight_lanes, 8};
#endif
#if defined(CAMBER_VALIDITY_AVX2)
  if (__builtin_cpu_supports("avx2") != 0) return {kernel_four_lanes, 4};
#endif
  return {kernel_two_lanes, 2};
}

}  // namespace camber::detail
