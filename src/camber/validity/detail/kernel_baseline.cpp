#include <camber/validity/detail/kernel.hpp>

namespace camber::detail {

void kernel_scalar(const KernelPlan& plan, const StraightView* straight, const double* nodes,
                   double* work, const KernelOutput& out) {
  kernel<1>(plan, straight, nodes, work, out);
}

void kernel_two_lanes(const KernelPlan& plan, const StraightView* straight, const double* nodes,
                      double* work, const KernelOutput& out) {
  kernel<2>(plan, straight, nodes, work, out);
}

}  // namespace camber::detail
