#include <camber/validity/detail/element_bounds.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace camber::detail {

namespace {

// Halvings in all, per unit of CertifyOptions::max_depth.
constexpr int k_splits_per_depth = 64;

RefineGoal goal_of(const DeterminantPlan& plan, const CertifyOptions& options, bool sign) {
  RefineGoal goal;
  goal.sign = sign;
  goal.sharpness = options.sharpness;
  goal.max_depth = options.max_depth * plan.kernel().columns;  // one halving a direction is a level
  goal.max_splits = options.max_depth * k_splits_per_depth;
  return goal;
}

bool is_sharp(double lower, double upper, double sharpness) {
  return std::isinf(sharpness) || lower >= upper - sharpness * std::abs(upper);
}

Verdict verdict_of(double lower, double upper) {
  if (lower > 0.0) return Verdict::valid;
  return upper < 0.0 ? Verdict::invalid : Verdict::undecided;
}

// Where the lowest corner value lies.
Vec3 lowest_corner(const SubdivisionTable& table, const double* c) {
  const auto lowest = std::min_element(table.corners().begin(), table.corners().end(),
                                       [&](const CornerCoefficient& a, const CornerCoefficient& b) {
                                         return c[a.coefficient] < c[b.coefficient];
                                       });
  return table.place(table.whole(), *lowest);
}

MinimumBounds volume_minimum(const KernelRun& run, int lane, const CertifyOptions& options,
                             ElementWork& work) {
  const DeterminantPlan& plan = run.plan();
  const double margin = run.margin(lane);
  MinimumBounds bounds{run.lowest(lane) - margin, run.corner_lowest(lane) + margin, Vec3::Zero()};
  const double* c = run.curved(lane, work);
  if (verdict_of(bounds.lower, bounds.upper) != Verdict::undecided &&
      is_sharp(bounds.lower, bounds.upper, options.sharpness)) {
    bounds.at = lowest_corner(plan.subdivision(), c);
    return bounds;
  }
  return refine_minimum(plan.subdivision(), {c, nullptr, margin, 0.0}, goal_of(plan, options, true),
                        work.refine);
}

// Bounds of the maximum, as those of the minimum of the opposite.
MinimumBounds opposite_minimum(const KernelRun& run, int lane, const CertifyOptions& options,
                               const double* denominator, ElementWork& work) {
  const DeterminantPlan& plan = run.plan();
  const double* c = run.curved(lane, work);
  work.negated.assign(c, c + plan.kernel().size);
  for (double& x : work.negated) x = -x;
  const Ratio ratio{work.negated.data(), denominator, run.margin(lane),
                    denominator != nullptr ? run.straight_margin(lane) : 0.0};
  return refine_minimum(plan.subdivision(), ratio, goal_of(plan, options, false), work.refine);
}

MinimumBounds volume_opposite(const KernelRun& run, int lane, const CertifyOptions& options,
                              ElementWork& work) {
  const double margin = run.margin(lane);
  const MinimumBounds bounds{-run.highest(lane) - margin, -run.corner_highest(lane) + margin,
                             Vec3::Zero()};
  if (is_sharp(bounds.lower, bounds.upper, options.sharpness)) return bounds;
  return opposite_minimum(run, lane, options, nullptr, work);
}

// Lower bound of min / max|.| from bounds of the minimum and of minus the maximum.
double scaled_bound(const MinimumBounds& minimum, const MinimumBounds& opposite) {
  if (minimum.lower >= 0.0) {
    const double highest = -opposite.lower;
    return highest > 0.0 ? std::min(1.0, minimum.lower / highest) : 0.0;
  }
  const double largest = std::max(-opposite.upper, -minimum.upper);
  return largest > 0.0 ? std::max(-1.0, minimum.lower / largest) : -1.0;
}

double volume_ratio(const KernelRun& run, int lane, const JacobianBounds& bounds,
                    const CertifyOptions& options, ElementWork& work) {
  double low = run.ratio_lowest(lane);
  const double* straight = run.straight(lane, work);
  const int size = run.plan().kernel().size;
  if (!is_sharp(low, run.ratio_corner(lane), options.sharpness)) {
    const Ratio ratio{run.curved(lane, work), straight, run.margin(lane),
                      run.straight_margin(lane)};
    low = refine_minimum(run.plan().subdivision(), ratio, goal_of(run.plan(), options, false),
                         work.refine)
              .lower;
  }
  if (std::isinf(low)) return std::min(0.0, bounds.scaled_jacobian);
  if (bounds.min_lower > 0.0) {
    const double highest = *std::max_element(straight, straight + size);
    low = std::max(low, bounds.min_lower / (highest + run.straight_margin(lane)));
  }
  return low;
}

JacobianBounds not_finite() {
  JacobianBounds bounds;
  bounds.scaled_jacobian = -1.0;
  bounds.jacobian_ratio = -1.0;
  return bounds;
}

}  // namespace

JacobianBounds volume_bounds(const KernelRun& run, int lane, int p, const CertifyOptions& options,
                             ElementWork& work) {
  if (!run.is_finite(lane)) return not_finite();
  const MinimumBounds minimum = volume_minimum(run, lane, options, work);
  const MinimumBounds opposite = volume_opposite(run, lane, options, work);
  JacobianBounds bounds;
  bounds.verdict = verdict_of(minimum.lower, minimum.upper);
  bounds.min_lower = minimum.lower;
  bounds.min_upper = minimum.upper;
  bounds.max_upper = -opposite.lower;
  bounds.scaled_jacobian = scaled_bound(minimum, opposite);
  bounds.worst_xi = minimum.at;
  if (p > 1) {
    bounds.jacobian_ratio = volume_ratio(run, lane, bounds, options, work);
  } else {  // the element is its own straight copy
    bounds.jacobian_ratio = minimum.lower > 0.0 ? 1.0 : std::min(0.0, bounds.scaled_jacobian);
  }
  return bounds;
}

Verdict volume_verdict(const KernelRun& run, int lane, const CertifyOptions& options,
                       ElementWork& work) {
  if (!run.is_finite(lane)) return Verdict::undecided;
  const double margin = run.margin(lane);
  const Verdict early = verdict_of(run.lowest(lane) - margin, run.corner_lowest(lane) + margin);
  if (early != Verdict::undecided) return early;
  const CertifyOptions sign_only{options.max_depth, k_infinity};
  const MinimumBounds bounds =
      refine_minimum(run.plan().subdivision(), {run.curved(lane, work), nullptr, margin, 0.0},
                     goal_of(run.plan(), sign_only, true), work.refine);
  return verdict_of(bounds.lower, bounds.upper);
}

JacobianBounds face_bounds(const KernelRun& run, int lane, const CertifyOptions& options,
                           ElementWork& work) {
  if (!run.is_finite(lane)) return not_finite();
  const double* straight = run.straight(lane, work);
  const Ratio ratio{run.curved(lane, work), straight, run.margin(lane), run.straight_margin(lane)};
  const MinimumBounds minimum = refine_minimum(run.plan().subdivision(), ratio,
                                               goal_of(run.plan(), options, true), work.refine);
  const MinimumBounds opposite = opposite_minimum(run, lane, options, straight, work);
  // Without a normal of the straight face there is nothing to compare with.
  if (std::isinf(minimum.lower) || std::isinf(opposite.lower)) return not_finite();
  JacobianBounds bounds;
  bounds.verdict = verdict_of(minimum.lower, minimum.upper);
  bounds.min_lower = minimum.lower;
  bounds.min_upper = minimum.upper;
  bounds.max_upper = -opposite.lower;
  bounds.scaled_jacobian = scaled_bound(minimum, opposite);
  bounds.jacobian_ratio = minimum.lower;
  bounds.worst_xi = minimum.at;
  return bounds;
}

}  // namespace camber::detail
