#include <camber/io/gmsh/node_numbers.hpp>

#include <algorithm>
#include <limits>

namespace camber::io::gmsh {
namespace {

/// A table may have this many places per number before a sorted list takes less memory.
constexpr std::uint64_t k_sparsity = 4;

}  // namespace

NodeNumbers::NodeNumbers(const std::vector<GlobalId>& numbers) {
  if (numbers.empty()) return;
  const auto [low, high] = std::minmax_element(numbers.begin(), numbers.end());
  lowest_ = *low;
  const std::uint64_t span = static_cast<std::uint64_t>(*high) - static_cast<std::uint64_t>(*low);
  const auto count = static_cast<Index>(numbers.size());
  if (span / k_sparsity <= numbers.size()) {
    dense_.assign(span + 1, k_none);
    for (Index i = 0; i < count; ++i) {
      Index& place =
          dense_[static_cast<std::uint64_t>(numbers[at(i)]) - static_cast<std::uint64_t>(lowest_)];
      if (place == k_none) {
        place = i;
      } else if (!duplicate_) {
        duplicate_ = i;
      }
    }
    return;
  }
  sorted_.reserve(numbers.size());
  for (Index i = 0; i < count; ++i) sorted_.emplace_back(numbers[at(i)], i);
  std::sort(sorted_.begin(), sorted_.end());
  for (std::size_t i = 1; i < sorted_.size(); ++i) {
    if (sorted_[i].first != sorted_[i - 1].first) continue;
    duplicate_ =
        std::min(duplicate_.value_or(std::numeric_limits<Index>::max()), sorted_[i].second);
  }
}

Index NodeNumbers::find_sparse(GlobalId number) const {
  const auto place = std::lower_bound(
      sorted_.begin(), sorted_.end(), number,
      [](const std::pair<GlobalId, Index>& entry, GlobalId n) { return entry.first < n; });
  return place != sorted_.end() && place->first == number ? place->second : k_none;
}

}  // namespace camber::io::gmsh
