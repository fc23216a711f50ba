#include <camber/smooth/lbfgs.hpp>

#include <algorithm>
#include <cmath>
#include <deque>

namespace camber {
namespace {

constexpr double k_armijo = 1e-4;
constexpr int k_halvings = 30;

struct Pair {
  VecX step, change;  // s, y
  double inverse_product;
};

VecX descent_direction(const VecX& gradient, const std::deque<Pair>& pairs, const VecX& inverse_diagonal) {
  VecX q = gradient;
  std::vector<double> alpha(pairs.size());
  for (std::size_t i = pairs.size(); i-- > 0;) {
    alpha[i] = pairs[i].inverse_product * pairs[i].step.dot(q);
    q -= alpha[i] * pairs[i].change;
  }
  q = inverse_diagonal.cwiseProduct(q);
  if (!pairs.empty()) {
    // Scaled so that the latest pair is reproduced along its own direction.
    const Pair& last = pairs.back();
    const double curvature = last.change.dot(inverse_diagonal.cwiseProduct(last.change));
    q *= 1.0 / (last.inverse_product * curvature);
  }
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    const double beta = pairs[i].inverse_product * pairs[i].change.dot(q);
    q += (alpha[i] - beta) * pairs[i].step;
  }
  return -q;
}

}  // namespace

int minimise_lbfgs(const std::function<double(const VecX&, VecX&)>& f, VecX& x, const VecX& inverse_diagonal,
                   const LbfgsOptions& options, const std::function<bool(const VecX&)>& is_done) {
  VecX gradient(x.size());
  double value = f(x, gradient);
  if (!std::isfinite(value)) return 0;
  const double first_norm = std::sqrt(gradient.dot(inverse_diagonal.cwiseProduct(gradient)));
  std::deque<Pair> pairs;
  int iteration = 0;
  for (; iteration < options.max_iterations; ++iteration) {
    if (is_done && is_done(x)) break;
    const double norm = std::sqrt(gradient.dot(inverse_diagonal.cwiseProduct(gradient)));
    if (!(norm > options.gradient_tolerance * first_norm)) break;
    VecX direction = descent_direction(gradient, pairs, inverse_diagonal);
    double slope = direction.dot(gradient);
    if (!(slope < 0.0)) {
      pairs.clear();
      direction = -inverse_diagonal.cwiseProduct(gradient);
      slope = direction.dot(gradient);
    }
    // The first steps of an ill-scaled energy must not leave the range where it says anything.
    const double reach = std::sqrt((direction.array().square() / inverse_diagonal.array()).sum());
    double length = std::min(1.0, options.longest_step / reach);
    VecX candidate(x.size()), candidate_gradient(x.size());
    double candidate_value = value;
    bool is_lower = false;
    for (int h = 0; h < k_halvings && !is_lower; ++h) {
      candidate = x + length * direction;
      candidate_value = f(candidate, candidate_gradient);
      is_lower = std::isfinite(candidate_value) && candidate_value <= value + k_armijo * length * slope;
      if (!is_lower) length *= 0.5;
    }
    if (!is_lower) break;
    Pair pair{candidate - x, candidate_gradient - gradient, 0.0};
    const double product = pair.step.dot(pair.change);
    if (product > 1e-12 * pair.step.norm() * pair.change.norm()) {
      pair.inverse_product = 1.0 / product;
      pairs.push_back(std::move(pair));
      if (static_cast<int>(pairs.size()) > options.memory) pairs.pop_front();
    }
    x = candidate;
    gradient = candidate_gradient;
    value = candidate_value;
  }
  return iteration;
}

}  // namespace camber
