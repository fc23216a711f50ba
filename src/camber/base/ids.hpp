#pragma once
#include <cstddef>
#include <cstdint>

namespace camber {

/// Index into an array of this process (vertices, edges, faces, cells). Plain integers: the name of
/// the variable or map (`cell2vertex`) says which array; negative means "none".
using Index = std::int32_t;
/// Number of an entity in the user's file.
using GlobalId = std::int64_t;

inline constexpr Index k_none = -1;

[[nodiscard]] constexpr std::size_t at(Index i) { return static_cast<std::size_t>(i); }

}  // namespace camber
