#include <camber/metric/detail/cost_kernel.hpp>

namespace camber::detail {

void cost_four_lanes(const CostView& view, const double* x, const double* corners, double* minimum,
                     double* sum) {
  cost_kernel<4>(view, x, corners, minimum, sum);
}

}  // namespace camber::detail
