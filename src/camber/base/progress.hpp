#pragma once
#include <functional>
#include <string_view>

namespace camber {

/// Passed into long calls. `report(stage, fraction)` may be empty; `cancelled()` is polled between
/// chunks of work: a true answer makes the call throw Cancelled and leave nothing half done.
struct Progress {
  std::function<void(std::string_view stage, double fraction)> report;
  std::function<bool()> cancelled;

  void operator()(std::string_view stage, double fraction) const;
};

struct Cancelled {};

inline void Progress::operator()(std::string_view stage, double fraction) const {
  if (report) report(stage, fraction);
  if (cancelled && cancelled()) throw Cancelled{};
}

}  // namespace camber
