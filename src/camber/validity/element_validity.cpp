#include <camber/validity/detail/element_bounds.hpp>
#include <camber/validity/element_validity.hpp>

#include <stdexcept>
#include <string>

namespace camber {

namespace {

using detail::DeterminantPlan;

detail::KernelRun run_scalar(Shape shape, int p, std::span<const Vec3> nodes, bool with_straight,
                             int dim, detail::ElementWork& work) {
  if (dimension(shape) != dim) {
    throw std::invalid_argument("no certificate of this kind for a " + std::string(name(shape)));
  }
  const DeterminantPlan& plan = DeterminantPlan::of(shape, p);
  const auto count = static_cast<std::size_t>(plan.kernel().nodes);
  if (nodes.size() != count) {
    throw std::invalid_argument(std::string(name(shape)) + " of order " + std::to_string(p) +
                                " has " + std::to_string(count) + " nodes, not " +
                                std::to_string(nodes.size()));
  }
  double* x = detail::KernelRun::node_buffer(plan, 1, work);
  for (std::size_t n = 0; n < count; ++n) {
    for (std::size_t d = 0; d < 3; ++d) x[d * count + n] = nodes[n](static_cast<Eigen::Index>(d));
  }
  return {plan, detail::scalar_kernel(), with_straight, work};
}

}  // namespace

JacobianBounds certify(Shape shape, int p, std::span<const Vec3> nodes,
                       const CertifyOptions& options) {
  detail::ElementWork& work = detail::element_work();
  return detail::volume_bounds(run_scalar(shape, p, nodes, p > 1, 3, work), 0, p, options, work);
}

JacobianBounds certify_face(Shape shape, int p, std::span<const Vec3> nodes,
                            const CertifyOptions& options) {
  detail::ElementWork& work = detail::element_work();
  return detail::face_bounds(run_scalar(shape, p, nodes, true, 2, work), 0, options, work);
}

Verdict quick_verdict(Shape shape, int p, std::span<const Vec3> nodes,
                      const CertifyOptions& options) {
  detail::ElementWork& work = detail::element_work();
  return detail::volume_verdict(run_scalar(shape, p, nodes, false, 3, work), 0, options, work);
}

}  // namespace camber
