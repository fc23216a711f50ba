#pragma once
#include <camber/mesh/curved_mesh.hpp>

#include <vector>

namespace camber {

/// Which cell or face each exported element came from (over all blocks, in order; -1 where
/// neither).
struct ExportMap {
  std::vector<Index> cell, face;
};

/// The file-level view of a mixed-order mesh: volume blocks, one per region, shape and order;
/// surface blocks per patch and order (that of the cell behind, so that cell and surface share
/// their nodes); curve blocks. Nodes are shared between elements that have the same order on a
/// common entity; where the order differs each side has its own nodes, which lie on one polynomial.
/// Volume entity tags: the region's, or region * 10 + order where a region holds several orders.
/// @param uniform_order  0: every cell at its own order; p: all elevated exactly (same polynomials)
/// to p
/// @throws OptionError if uniform_order is below the order of some cell.
[[nodiscard]] MeshData export_mesh(const CurvedMesh& curved, int uniform_order = 0,
                                   ExportMap* map = nullptr);
/// The same for less memory: the nodes of `curved` are given up on the way, its orders stay.
[[nodiscard]] MeshData export_mesh(CurvedMesh&& curved, int uniform_order = 0,
                                   ExportMap* map = nullptr);

}  // namespace camber
