#pragma once
// Changing the orders of a curved mesh without changing its shapes.
#include <camber/mesh/curved_mesh.hpp>

namespace camber {

/// Raises cells until face neighbours differ by at most one.
void limit_order_jumps(const Topology& topology, std::vector<std::uint8_t>& cell_orders);

/// The same mesh with cells of the given orders, none below what it is. Entities follow by the
/// minimum rule. Exact: every edge, face and cell is the same polynomial as before (an entity of
/// higher order can hold it). Parallel inside.
[[nodiscard]] CurvedMesh raise_orders(const CurvedMesh& curved,
                                      std::vector<std::uint8_t> cell_orders);

/// Largest distance between what the two cells of any face make of it, at the lattice of the
/// higher order [length]. Round-off, as the cells share their entities. Parallel inside.
[[nodiscard]] double largest_gap(const CurvedMesh& curved);

}  // namespace camber
