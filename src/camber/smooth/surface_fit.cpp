#include <camber/smooth/detail/sliding_nodes.hpp>
#include <camber/smooth/detail/surface_distance.hpp>
#include <camber/smooth/detail/surface_energy.hpp>
#include <camber/smooth/lbfgs.hpp>
#include <camber/smooth/surface_fit.hpp>

#include <algorithm>
#include <cmath>

namespace camber {
namespace {

constexpr int k_fit_iterations = 30;
constexpr double k_gradient_tolerance = 1e-3;
constexpr double k_longest_fit_step = 0.5;
/// k: a strain of 1 is worth this share of a face's squared distance.
constexpr double k_slide_weight = 0.1;
/// b: only there to be infinite where a face folds.
constexpr double k_shape_weight = 1e-4;
/// tau may fall to this share of what it was, or to this.
constexpr double k_least_share = 0.2;

}  // namespace

SurfaceFit fit_surface(SurfacePatch& patch, const OnSurface& on_surface,
                       const NearestPoints& nearest) {
  const detail::SurfaceEnergy shape(patch);
  detail::SurfaceDistance distance(patch, nearest);
  detail::SlidingNodes sliding(patch, on_surface);
  SurfaceFit result;
  result.before = result.after = distance.root_mean_square(patch.nodes);
  if (sliding.size() == 0 || !(result.before > 0.0)) return result;
  const double least = shape.least_tau(patch.nodes);
  if (!(least > 0.0)) return result;
  distance.weigh_by_start();

  std::vector<double> stiffness(patch.nodes.size(), 0.0);
  shape.add_stiffness(stiffness);
  const VecX inverse_diagonal = sliding.inverse_diagonal(stiffness);
  LbfgsOptions options;
  options.max_iterations = k_fit_iterations;
  options.gradient_tolerance = k_gradient_tolerance;
  options.longest_step = k_longest_fit_step;
  VecX t = VecX::Zero(sliding.size());
  const auto value = [&](const VecX& y, VecX& gradient) {
    const Points& x = sliding.place(y);
    Points slope(x.size(), Vec3::Zero());
    double e = k_shape_weight * shape.evaluate(x, 0.0, slope);
    if (!std::isfinite(e)) return e;
    for (Vec3& s : slope) s *= k_shape_weight;
    e += distance.evaluate(x, slope);
    sliding.pull_back(slope, gradient);
    const VecX slid = y.cwiseQuotient(inverse_diagonal);
    gradient += 2.0 * k_slide_weight * slid;
    return e + k_slide_weight * y.dot(slid);
  };
  result.iterations = minimise_lbfgs(value, t, DiagonalHessian(inverse_diagonal), options);
  const Points& x = sliding.place(t);
  const double after = distance.root_mean_square(x);
  if (after < result.before && shape.least_tau(x) >= k_least_share * std::min(least, 1.0)) {
    result.after = after;
    sliding.store(t, patch);
  }
  return result;
}

}  // namespace camber
