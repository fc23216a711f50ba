#pragma once
// Programs differ on which triangle of a prism comes first; the volume tells.
#include <camber/mesh/mesh_data.hpp>

#include <span>

namespace camber::io {

/// True if the straight prism's volume is negative.
/// @param nodes  canonical lattice order (node_order.hpp), indices into points
[[nodiscard]] bool is_mirrored_prism(const Points& points, int order, std::span<const Index> nodes);

/// Corners 1 and 2 of both triangles change places, and so do the lattice's i and j.
void mirror_prism(int order, std::span<Index> nodes);

}  // namespace camber::io
