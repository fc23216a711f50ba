#include <camber/validity/detail/refine.hpp>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace camber::detail {

namespace {

constexpr double k_unit_roundoff = 0x1p-53;
// Halvings spent on finding a negative value once a value of zero (to round-off) is known: the sign
// can no longer become positive, only the kind of failure is open.
constexpr int k_splits_after_zero = 64;

class Search {
 public:
  Search(const SubdivisionTable& table, const Ratio& ratio, const RefineGoal& goal,
         RefineWork& work)
      : table_(table),
        ratio_(ratio),
        goal_(goal),
        work_(work),
        size_(static_cast<std::size_t>(table.size())) {
    work_.parts.clear();
    work_.queue.clear();
    work_.free_slots.clear();
    for (std::size_t s = 0; s < work_.slots.size(); ++s) {
      work_.free_slots.push_back(static_cast<int>(s));
    }
    // Each level of a split halves sums of coefficients: one rounding of the largest a level.
    growth_ = table.degree() * k_unit_roundoff * largest(ratio.numerator);
    if (ratio.denominator != nullptr) {
      denominator_growth_ = table.degree() * k_unit_roundoff * largest(ratio.denominator);
    }
  }

  MinimumBounds run() {
    const int root = take_slot();
    double* c = coefficients(root);
    std::copy_n(ratio_.numerator, size_, c);
    if (ratio_.denominator != nullptr) std::copy_n(ratio_.denominator, size_, c + size_);
    add_part({0.0, 0, 0, root, -1, -1, false});
    for (int splits = 0; !work_.queue.empty(); ++splits) {
      if (is_done(splits)) break;
      split_lowest();
    }
    return {lower(), upper_, upper_place()};
  }

 private:
  double largest(const double* c) const {
    double most = 0.0;
    for (std::size_t n = 0; n < size_; ++n) most = std::max(most, std::abs(c[n]));
    return most;
  }

  int take_slot() {
    if (work_.free_slots.empty()) {
      work_.slots.emplace_back();
      work_.free_slots.push_back(static_cast<int>(work_.slots.size()) - 1);
    }
    const int slot = work_.free_slots.back();
    work_.free_slots.pop_back();
    const std::size_t room = ratio_.denominator != nullptr ? 2 * size_ : size_;
    std::vector<double>& values = work_.slots[static_cast<std::size_t>(slot)];
    if (values.size() < room) values.resize(room);
    return slot;
  }

  double* coefficients(int slot) { return work_.slots[static_cast<std::size_t>(slot)].data(); }

  // The smallest value of top / d for d within `margin` of `bottom`; -inf if d may be <= 0.
  static double smallest_quotient(double top, double bottom, double margin) {
    if (!(bottom > margin)) return -k_infinity;
    return top / (top >= 0.0 ? bottom + margin : bottom - margin);
  }

  double lowest(const double* c, int depth) const {
    const double margin = ratio_.margin + depth * growth_;
    double low = k_infinity;
    if (ratio_.denominator == nullptr) {
      for (std::size_t n = 0; n < size_; ++n) low = std::min(low, c[n]);
      return low - margin;
    }
    const double bottom_margin = ratio_.denominator_margin + depth * denominator_growth_;
    for (std::size_t n = 0; n < size_; ++n) {
      low = std::min(low, smallest_quotient(c[n] - margin, c[size_ + n], bottom_margin));
    }
    return low;
  }

  void look_at_corners(const double* c, int number, int depth) {
    const double margin = ratio_.margin + depth * growth_;
    const double bottom_margin = ratio_.denominator_margin + depth * denominator_growth_;
    const std::span<const CornerCoefficient> corners = table_.corners();
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto n = static_cast<std::size_t>(corners[k].coefficient);
      double value = c[n] + margin;
      zero_seen_ = zero_seen_ || std::abs(c[n]) <= margin;
      if (ratio_.denominator != nullptr) {
        if (!(c[size_ + n] > bottom_margin)) {
          denominator_fails_ = true;
          continue;
        }
        value = -smallest_quotient(-value, c[size_ + n], bottom_margin);
      }
      if (value < upper_) {
        upper_ = value;
        upper_part_ = number;
        upper_corner_ = k;
      }
    }
  }

  void add_part(RefineWork::Part part) {
    part.number = static_cast<int>(work_.parts.size());
    const double* c = coefficients(part.slot);
    part.lower = lowest(c, part.depth);
    look_at_corners(c, part.number, part.depth);
    work_.parts.push_back(part);
    if (is_settled(part.lower)) {
      retire(part);
      return;
    }
    work_.queue.emplace_back(part.lower, part.number);
    std::push_heap(work_.queue.begin(), work_.queue.end(), std::greater<>());
  }

  // No further halving of a part with this bound can change what is asked for.
  [[nodiscard]] bool is_settled(double low) const {
    const bool sign_known = !goal_.sign || low > 0.0;
    return sign_known && is_sharp(low);
  }

  [[nodiscard]] bool is_sharp(double low) const {
    return std::isinf(goal_.sharpness) || low >= upper_ - goal_.sharpness * std::abs(upper_);
  }

  void retire(const RefineWork::Part& part) {
    retired_lower_ = std::min(retired_lower_, part.lower);
    work_.free_slots.push_back(part.slot);
  }

  [[nodiscard]] double lower() const {
    const double queued = work_.queue.empty() ? k_infinity : work_.queue.front().first;
    return std::min(queued, retired_lower_);
  }

  [[nodiscard]] bool is_done(int splits) const {
    const double low = lower();
    const bool sign_known = !goal_.sign || low > 0.0 || upper_ < 0.0;
    if (denominator_fails_ || (sign_known && is_sharp(low))) return true;
    if (splits >= goal_.max_splits) return true;
    return goal_.sign && !sign_known && zero_seen_ && splits >= k_splits_after_zero;
  }

  void split_lowest() {
    std::pop_heap(work_.queue.begin(), work_.queue.end(), std::greater<>());
    const RefineWork::Part parent =
        work_.parts[static_cast<std::size_t>(work_.queue.back().second)];
    work_.queue.pop_back();
    int direction = table_.most_bent(coefficients(parent.slot));
    if (direction < 0 && ratio_.denominator != nullptr) {
      direction = table_.most_bent(coefficients(parent.slot) + size_);
    }
    if (direction < 0 || parent.depth >= goal_.max_depth) {
      retire(parent);
      return;
    }
    const int other = take_slot();  // may move the slots: take pointers afterwards
    double* c = coefficients(parent.slot);
    double* half = coefficients(other);
    table_.split(direction, c, half);
    if (ratio_.denominator != nullptr) table_.split(direction, c + size_, half + size_);
    add_part({0.0, 0, parent.depth + 1, other, parent.number, direction, true});
    add_part({0.0, 0, parent.depth + 1, parent.slot, parent.number, direction, false});
  }

  [[nodiscard]] Vec3 upper_place() const {
    std::vector<int> path;
    for (int n = upper_part_; n >= 0; n = work_.parts[static_cast<std::size_t>(n)].parent) {
      path.push_back(n);
    }
    Region region = table_.whole();
    for (auto n = path.rbegin(); n != path.rend(); ++n) {
      const RefineWork::Part& part = work_.parts[static_cast<std::size_t>(*n)];
      if (part.direction >= 0) table_.halve(region, part.direction, part.keeps_first);
    }
    return table_.place(region, table_.corners()[upper_corner_]);
  }

  const SubdivisionTable& table_;
  const Ratio& ratio_;
  const RefineGoal& goal_;
  RefineWork& work_;
  std::size_t size_;
  double growth_ = 0.0, denominator_growth_ = 0.0;
  double retired_lower_ = k_infinity;
  double upper_ = k_infinity;
  bool zero_seen_ = false;          // a value that round-off cannot tell from zero
  bool denominator_fails_ = false;  // somewhere it is not positive: there is no lower bound
  int upper_part_ = 0;
  std::size_t upper_corner_ = 0;
};

}  // namespace

MinimumBounds refine_minimum(const SubdivisionTable& table, const Ratio& ratio,
                             const RefineGoal& goal, RefineWork& work) {
  return Search(table, ratio, goal, work).run();
}

}  // namespace camber::detail
