#include <camber/metric/detail/cost_kernel.hpp>

namespace camber::detail {

void cost_scalar(const CostView& view, const double* x, const double* corners, double* minimum,
                 double* sum) {
  cost_kernel<1>(view, x, corners, minimum, sum);
}

void cost_two_lanes(const CostView& view, const double* x, const double* corners, double* minimum,
                    double* sum) {
  cost_kernel<2>(view, x, corners, minimum, sum);
}

}  // namespace camber::detail
