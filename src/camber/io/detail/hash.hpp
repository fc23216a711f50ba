#pragma once
#include <cstdint>
#include <string_view>

namespace camber::io {

inline constexpr std::uint64_t k_fnv_start = 14695981039346656037ULL;

/// FNV-1a, 64 bits, continued from `hash`: tells damage and equality, not malice.
[[nodiscard]] constexpr std::uint64_t fnv1a(std::string_view bytes,
                                            std::uint64_t hash = k_fnv_start) {
  for (const char c : bytes) {
    hash ^= static_cast<unsigned char>(c);
    hash *= 1099511628211ULL;
  }
  return hash;
}

}  // namespace camber::io
