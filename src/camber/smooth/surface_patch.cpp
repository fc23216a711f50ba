#include <camber/smooth/detail/sliding_nodes.hpp>
#include <camber/smooth/detail/surface_energy.hpp>
#include <camber/smooth/lbfgs.hpp>
#include <camber/smooth/surface_patch.hpp>

#include <algorithm>
#include <cmath>

namespace camber {
namespace {

constexpr int k_rounds = 16;
constexpr int k_surface_iterations = 40;
/// tau that every sample must reach for the patch to count as repaired.
constexpr double k_clear = 0.02;
constexpr double k_surface_least_delta = 0.05;
constexpr double k_surface_delta_shrink = 0.7;
constexpr double k_longest_slide = 0.5;

}  // namespace

bool smooth_surface(SurfacePatch& patch, const OnSurface& on_surface) {
  const detail::SurfaceEnergy energy(patch);
  detail::SlidingNodes sliding(patch, on_surface);
  if (sliding.size() == 0) return false;
  std::vector<double> stiffness(patch.nodes.size(), 0.0);
  energy.add_stiffness(stiffness);
  const VecX inverse_diagonal = sliding.inverse_diagonal(stiffness);
  LbfgsOptions options;
  options.max_iterations = k_surface_iterations;
  options.longest_step = k_longest_slide;
  VecX t = VecX::Zero(sliding.size());
  double least = energy.least_tau(sliding.place(t));
  for (int round = 0; round < k_rounds; ++round) {
    const double delta = least > 0.0 ? 0.0
                                     : std::max(k_surface_least_delta, 0.3 * std::abs(least)) *
                                           std::pow(k_surface_delta_shrink, round);
    const auto value = [&](const VecX& y, VecX& gradient) {
      Points slope(patch.nodes.size(), Vec3::Zero());
      const double e = energy.evaluate(sliding.place(y), delta, slope);
      sliding.pull_back(slope, gradient);
      return e;
    };
    minimise_lbfgs(value, t, DiagonalHessian(inverse_diagonal), options);
    least = energy.least_tau(sliding.place(t));
    if (least > k_clear) {
      sliding.store(t, patch);
      return true;
    }
  }
  return false;
}

}  // namespace camber
