#include <camber/validity/detail/kernel.hpp>

namespace camber::detail {

void kernel_eight_lanes(const KernelPlan& plan, const StraightView* straight, const double* nodes,
                        double* work, const KernelOutput& out) {
  kernel<8>(plan, straight, nodes, work, out);
}

}  // namespace camber::detail
