#pragma once
#include <camber/mesh/mesh_data.hpp>

namespace camber {

/// The same mesh with every element at one order. Elements of a lower order are elevated exactly:
/// x(xi) stays the same polynomial. Where neighbours make the same of a common edge or face they
/// share its nodes (known by the corner nodes, and compared), so the result is as watertight as the
/// mesh was; where they do not, each keeps its own nodes. Order 1 takes the corners of every
/// element. Element order, numbers, entities, names and fields stay; nodes that no element uses are
/// left behind, new ones get numbers after the highest and the entity of the element of lowest
/// dimension they belong to.
/// @param order  1..k_max_order
/// @throws OptionError for another order, or if an element has a higher one and order is not 1
[[nodiscard]] MeshData at_order(const MeshData& data, int order);

}  // namespace camber
