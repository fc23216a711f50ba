#pragma once
// Exact keys for entities known by their corner vertices.
#include <camber/base/ids.hpp>

#include <array>
#include <compare>
#include <cstdint>
#include <functional>

namespace camber {

/// Sorted corner vertices of an edge (2), triangle (3) or quadrilateral (4); unused places are -1.
/// Two entities have equal keys iff they have the same corners, in any order.
struct CornerKey {
  std::array<Index, 4> v{-1, -1, -1, -1};
  friend bool operator==(const CornerKey&, const CornerKey&) = default;
  friend auto operator<=>(const CornerKey&, const CornerKey&) = default;
};

template <class Range>
[[nodiscard]] CornerKey corner_key(const Range& corners) {
  CornerKey key;
  std::size_t n = 0;
  for (Index c : corners) {  // insertion: four entries at most
    std::size_t place = n++;
    for (; place > 0 && key.v[place - 1] > c; --place) key.v[place] = key.v[place - 1];
    key.v[place] = c;
  }
  return key;
}

struct CornerKeyHash {
  std::size_t operator()(const CornerKey& k) const noexcept {
    std::uint64_t h = 0x9e3779b97f4a7c15ULL;
    for (Index i : k.v) {
      h ^= static_cast<std::uint64_t>(static_cast<std::uint32_t>(i));
      h *= 0xff51afd7ed558ccdULL;
      h ^= h >> 32;
    }
    return static_cast<std::size_t>(h);
  }
};

}  // namespace camber
