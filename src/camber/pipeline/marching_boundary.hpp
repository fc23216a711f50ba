#pragma once
// The boundary as the paper's smoother needs it: what may slide, and on what.
#include <camber/pipeline/carry_wall.hpp>
#include <camber/smooth/marching/marching.hpp>

namespace camber {

/// Two surfaces: the wall, then all other patches on CAD or in a plane, with the wall's edges
/// fixed. Nodes of faces stay on their patch's group or plane; those of edges on their CAD curve,
/// else on the patch on both sides, or where two planes meet; all others are fixed. Feet are found
/// in parallel. Changes of the wall are carried by its field (carry_wall.hpp). Keeps references to
/// all arguments.
[[nodiscard]] MarchingBoundary marching_boundary(const LinearMesh& mesh, const Topology& topology,
                                                 const GeometryModel& geometry,
                                                 const FieldSource& field);

}  // namespace camber
