#pragma once
// From the node numbers of a file to places in an array.
#include <camber/base/ids.hpp>

#include <optional>
#include <utility>
#include <vector>

namespace camber::io::gmsh {

/// number -> place. Numbers may be sparse and large: memory is proportional to their count.
class NodeNumbers {
 public:
  NodeNumbers() = default;
  /// Place i for numbers[i]. Equal numbers: the first place wins, see duplicate().
  explicit NodeNumbers(const std::vector<GlobalId>& numbers);

  /// Place of a number, k_none if the file has no such node. Cost: O(1) for nearly dense numbers,
  /// else O(log n).
  [[nodiscard]] Index find(GlobalId number) const {
    if (!dense_.empty()) {
      // Unsigned difference: a number below the lowest wraps to a large one.
      const std::uint64_t i =
          static_cast<std::uint64_t>(number) - static_cast<std::uint64_t>(lowest_);
      return i < dense_.size() ? dense_[i] : k_none;
    }
    return find_sparse(number);
  }
  /// The lowest place whose number occurred before; none if all differ.
  [[nodiscard]] std::optional<Index> duplicate() const { return duplicate_; }

 private:
  [[nodiscard]] Index find_sparse(GlobalId number) const;

  GlobalId lowest_ = 0;
  std::vector<Index> dense_;
  std::vector<std::pair<GlobalId, Index>> sorted_;
  std::optional<Index> duplicate_;
};

}  // namespace camber::io::gmsh
