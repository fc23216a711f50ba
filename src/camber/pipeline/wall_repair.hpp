#pragma once
#include <camber/elevate/placement.hpp>

#include <vector>

namespace camber {

/// Surface smoothing (paper 2.2.5) of wall faces that came out folded: the nodes inside each face,
/// and on the edges inside its patch, slide along the CAD together with those of the faces around
/// it. Vertices, CAD curves and everything farther away stay. Done at the highest order; lower
/// orders are sampled from the result and put back on the CAD.
/// @return slots of all faces whose nodes changed, sorted; faces that could not be unfolded are not
/// among them
std::vector<Index> smooth_wall_faces(const LinearMesh& mesh, const Topology& topology,
                                     const Association& association, const GeometryModel& model,
                                     const Wall& wall, Placement& placement,
                                     const std::vector<Index>& slots);

}  // namespace camber
