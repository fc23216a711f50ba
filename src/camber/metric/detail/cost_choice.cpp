#include <camber/base/processor.hpp>
#include <camber/metric/detail/cost_view.hpp>

namespace camber::detail {

void cost_scalar(const CostView&, const double*, const double*, double*, double*);
void cost_two_lanes(const CostView&, const double*, const double*, double*, double*);
void cost_four_lanes(const CostView&, const double*, const double*, double*, double*);
void cost_eight_lanes(const CostView&, const double*, const double*, double*, double*);

CostKernelChoice cost_kernel_of(int lanes) {
  if (!has_lanes(lanes)) return {nullptr, 0};
#if defined(CAMBER_KERNELS_AVX512)
  if (lanes == 8) return {cost_eight_lanes, 8};
#endif
#if defined(CAMBER_KERNELS_AVX2)
  if (lanes == 4) return {cost_four_lanes, 4};
#endif
  if (lanes == 2) return {cost_two_lanes, 2};
  return {cost_scalar, 1};
}

}  // namespace camber::detail
