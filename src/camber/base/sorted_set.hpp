#pragma once
#include <algorithm>
#include <vector>

namespace camber {

/// Sorts and drops repetitions.
template <class T>
void make_sorted_set(std::vector<T>& items) {
  std::sort(items.begin(), items.end());
  items.erase(std::unique(items.begin(), items.end()), items.end());
}

}  // namespace camber
