#include <camber/metric/detail/cost_kernel.hpp>

namespace camber::detail {

void cost_eight_lanes(const CostView& view, const double* x, const double* corners, double* minimum,
                      double* sum) {
  cost_kernel<8>(view, x, corners, minimum, sum);
}

}  // namespace camber::detail
