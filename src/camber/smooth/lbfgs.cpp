#include <camber/smooth/lbfgs.hpp>

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <utility>

namespace camber {
namespace {

constexpr double k_armijo = 1e-4;
/// The slope must fall to this share of its start, so that a step is not far too short and the
/// change of gradient tells of positive curvature.
constexpr double k_wolfe = 0.9;
constexpr int k_trials = 30;

struct Pair {
  VecX step, change;  // s, y
  double inverse_product;
};

VecX descent_direction(const VecX& gradient, const std::deque<Pair>& pairs,
                       const InitialHessian& hessian) {
  VecX q = gradient, solved;
  std::vector<double> alpha(pairs.size());
  for (std::size_t i = pairs.size(); i-- > 0;) {
    alpha[i] = pairs[i].inverse_product * pairs[i].step.dot(q);
    q -= alpha[i] * pairs[i].change;
  }
  hessian.solve(q, solved);
  q = solved;
  if (!pairs.empty()) {
    // Scaled so that the latest pair is reproduced along its own direction.
    const Pair& last = pairs.back();
    hessian.solve(last.change, solved);
    const double curvature = last.change.dot(solved);
    q *= 1.0 / (last.inverse_product * curvature);
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double beta = pairs[i].inverse_product * pairs[i].change.dot(q);
    q += (alpha[i] - beta) * pairs[i].step;
  }
  return -q;
}

struct Point {
  VecX x, gradient;
  double value = 0.0;
};

using Objective = std::function<double(const VecX&, VecX&)>;

/// Weak Wolfe conditions by bisection: shorter where the value is too high (or undefined), longer
/// (up to `longest`) where the slope is still steep. @return whether `here` moved to a lower point
/// Source: Lewis, Overton 2013, doi 10.1007/s10107-012-0514-2.
bool search_line(const Objective& f, const VecX& direction, double slope, double longest,
                 Point& here) {
  double low = 0.0, high = std::numeric_limits<double>::infinity();
  double length = std::min(1.0, longest);
  Point trial{VecX(here.x.size()), VecX(here.x.size()), 0.0}, best;
  for (int t = 0; t < k_trials; ++t) {
    trial.x = here.x + length * direction;
    trial.value = f(trial.x, trial.gradient);
    if (std::isfinite(trial.value) && trial.value <= here.value + k_armijo * length * slope) {
      low = length;
      best = trial;
      if (trial.gradient.dot(direction) >= k_wolfe * slope || length >= longest) break;
    } else {
      high = length;
    }
    length = std::isfinite(high) ? 0.5 * (low + high) : std::min(2.0 * length, longest);
  }
  if (low == 0.0) return false;
  here = std::move(best);
  return true;
}

}  // namespace

int minimise_lbfgs(const std::function<double(const VecX&, VecX&)>& f, VecX& x,
                   const InitialHessian& hessian, const LbfgsOptions& options,
                   const std::function<bool(const VecX&)>& is_done) {
  Point here{x, VecX(x.size()), 0.0};
  here.value = f(here.x, here.gradient);
  if (!std::isfinite(here.value)) return 0;
  VecX solved;
  const auto norm = [&](const VecX& g) {
    hessian.solve(g, solved);
    return std::sqrt(g.dot(solved));
  };
  const double first_norm = norm(here.gradient);
  std::deque<Pair> pairs;
  int iteration = 0;
  for (; iteration < options.max_iterations; ++iteration) {
    if (is_done && is_done(here.x)) break;
    if (!(norm(here.gradient) > options.gradient_tolerance * first_norm)) break;
    VecX direction = descent_direction(here.gradient, pairs, hessian);
    double slope = direction.dot(here.gradient);
    if (!(slope < 0.0)) {
      pairs.clear();
      hessian.solve(here.gradient, solved);
      direction = -solved;
      slope = direction.dot(here.gradient);
    }
    // The first steps of an ill-scaled energy must not leave the range where it says anything.
    const double reach = std::sqrt(hessian.squared_norm(direction));
    const Point before = here;
    if (!search_line(f, direction, slope, options.longest_step / reach, here)) break;
    Pair pair{here.x - before.x, here.gradient - before.gradient, 0.0};
    const double product = pair.step.dot(pair.change);
    if (product > 1e-12 * pair.step.norm() * pair.change.norm()) {
      pair.inverse_product = 1.0 / product;
      pairs.push_back(std::move(pair));
      if (static_cast<int>(pairs.size()) > options.memory) pairs.pop_front();
    }
  }
  x = here.x;
  return iteration;
}

}  // namespace camber
