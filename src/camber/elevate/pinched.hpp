#pragma once
#include <camber/elevate/wall.hpp>

#include <vector>

namespace camber {

/// Cells with a corner whose three edges all lie on one CAD patch (a tet with two faces on it, or
/// three edges): on the true, smooth surface the three tangents are coplanar, so det J = 0 there at
/// any order above 1 and no smoothing helps. Patches of kind `cad` only.
[[nodiscard]] std::vector<Index> find_pinched_cells(const LinearMesh& mesh,
                                                    const Topology& topology,
                                                    const Association& association,
                                                    const Wall& wall);

/// Edges inside the volume whose removal (mesh/split_cells.hpp) parts the two wall faces of pinched
/// tets: of a tet with two faces on the wall, the edge opposite to the one they share. Sorted.
[[nodiscard]] std::vector<Index> edges_behind_pinched_tets(const LinearMesh& mesh,
                                                           const Topology& topology,
                                                           const Wall& wall,
                                                           const std::vector<Index>& pinched);

}  // namespace camber
