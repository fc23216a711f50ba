#pragma once
// Which wall faces have to give up their curved shape together.
#include <camber/elevate/placement.hpp>

#include <utility>
#include <vector>

namespace camber {

/// Adds to `caps` (face slot, cap) the wall faces that a lowered neighbour would fold: those whose
/// height over a shared edge is less than k_fold times the distance that the cap moves the edge by.
/// So a stack of thin faces (where the layers of one wall end on another) falls as one. Edges on
/// CAD curves move only when the cap is 1 (Placement::lower).
[[nodiscard]] std::vector<std::pair<Index, int>> lowered_together(
    const LinearMesh& mesh, const Topology& topology, const Association& association,
    const Wall& wall, const Placement& placement, const std::vector<std::pair<Index, int>>& caps);

/// Wall faces that share a vertex with one of `slots`, and these; sorted.
[[nodiscard]] std::vector<Index> with_wall_ring(const LinearMesh& mesh, const Topology& topology,
                                                const Wall& wall, const std::vector<Index>& slots);

}  // namespace camber
