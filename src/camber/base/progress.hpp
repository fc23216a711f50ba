#pragma once
#include <cstddef>
#include <functional>
#include <string_view>

namespace camber {

/// Where an iterative stage stands.
struct IterationState {
  int iteration = 0;
  std::size_t active_nodes = 0, negative_elements = 0;
  double worst_cost = 1.0;
};

/// Passed into long calls. `report(stage, fraction)` and `iterate(stage, state)` may be empty;
/// `cancelled()` is polled between chunks of work: a true answer makes the call throw Cancelled and
/// leave nothing half done.
struct Progress {
  std::function<void(std::string_view stage, double fraction)> report;
  std::function<bool()> cancelled;
  std::function<void(std::string_view stage, const IterationState& state)> iterate;

  void operator()(std::string_view stage, double fraction) const;
  void operator()(std::string_view stage, const IterationState& state) const;
};

struct Cancelled {};

inline void Progress::operator()(std::string_view stage, double fraction) const {
  if (report) report(stage, fraction);
  if (cancelled && cancelled()) throw Cancelled{};
}

inline void Progress::operator()(std::string_view stage, const IterationState& state) const {
  if (iterate) iterate(stage, state);
  if (cancelled && cancelled()) throw Cancelled{};
}

}  // namespace camber
