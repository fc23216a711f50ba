#pragma once
// The boundary as the paper's smoother needs it: what may slide, and on what.
#include <camber/associate/association.hpp>
#include <camber/smooth/marching/marching.hpp>

namespace camber {

/// Faces of patches on CAD or in a plane. Nodes of faces stay on their patch's group or plane;
/// those of edges on their CAD curve, else on the patch on both sides, or where two planes meet;
/// all others are fixed. Feet are found in parallel. Keeps references to all arguments.
[[nodiscard]] MarchingBoundary marching_boundary(const LinearMesh& mesh, const Topology& topology,
                                                 const Association& association,
                                                 const GeometryModel& geometry);

}  // namespace camber
