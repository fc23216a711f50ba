#pragma once
// Branch and bound for the minimum of a polynomial, or of a ratio of two, in Bernstein form.
#include <camber/validity/detail/subdivision.hpp>

#include <limits>
#include <vector>

namespace camber::detail {

inline constexpr double k_infinity = std::numeric_limits<double>::infinity();

/// numerator / denominator over the reference domain; a null denominator means 1.
struct Ratio {
  const double* numerator = nullptr;    // size coefficients
  const double* denominator = nullptr;  // size coefficients or null
  double margin = 0.0;                  // round-off bound of each numerator coefficient
  double denominator_margin = 0.0;
};

struct RefineGoal {
  bool sign = true;        // go on until the sign of the minimum is known
  double sharpness = 0.1;  // and until upper - lower <= sharpness * |upper|
  int max_depth = 36;      // halvings of one part
  int max_splits = 768;    // halvings in all
};

/// lower <= minimum <= upper, round-off included; `at` is a corner of a part where the value is at
/// most upper. lower is -infinity if the denominator could not be shown positive.
struct MinimumBounds {
  double lower = 0.0, upper = 0.0;
  Vec3 at = Vec3::Zero();
};

/// Work arrays of refine_minimum; one a thread.
class RefineWork {
 public:
  struct Part {
    double lower;
    int number, depth, slot, parent, direction;
    bool keeps_first;
  };
  std::vector<Part> parts;                    // all parts ever made
  std::vector<std::pair<double, int>> queue;  // heap of (lower, part number), lowest first
  std::vector<std::vector<double>> slots;     // coefficients of the parts in the queue
  std::vector<int> free_slots;
};

/// Best-first subdivision: the part with the lowest bound is halved in the direction in which it
/// bends most. Deterministic; no allocation once the work arrays have grown.
[[nodiscard]] MinimumBounds refine_minimum(const SubdivisionTable& table, const Ratio& ratio,
                                           const RefineGoal& goal, RefineWork& work);

}  // namespace camber::detail
