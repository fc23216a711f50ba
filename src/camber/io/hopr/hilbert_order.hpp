#pragma once
// Points along a space-filling curve: parts of the order are compact in space.
#include <camber/base/vec.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace camber::io::hopr {

inline constexpr int k_hilbert_bits = 21;  // a coordinate; three fill 63 bits

/// Place on Hilbert's curve through a cube of 2^bits cells a side; neighbours on the curve share a
/// face. Source: C. H. Hamilton, A. Rau-Chaplin, Inf. Process. Lett. 105 (2008), section 2.
/// @param cell  0 <= i, j, k < 2^bits
/// @return      0 <= place < 8^bits
[[nodiscard]] std::uint64_t hilbert_place(const std::array<std::uint32_t, 3>& cell, int bits);

/// Numbers of the points in their order along the curve through their bounding cube. Points in one
/// cell, 2^-21 of the cube's side, keep their order.
[[nodiscard]] std::vector<std::size_t> hilbert_order(const Points& points);

}  // namespace camber::io::hopr
