#pragma once
#include <camber/elevate/placement.hpp>

#include <vector>

namespace camber {

/// Surface smoothing (paper 2.2.5) of wall faces that came out folded: the nodes inside each face,
/// and on the edges inside its patch, slide along the CAD together with those of the faces around
/// it. Vertices, CAD curves, lowered faces and everything farther away stay. Done at the highest
/// order; lower orders are sampled from the result and put back on the CAD.
/// @return slots of all faces whose nodes changed, sorted; faces that could not be unfolded are not
/// among them
std::vector<Index> smooth_wall_faces(const LinearMesh& mesh, const Topology& topology,
                                     const Association& association, const GeometryModel& model,
                                     const Wall& wall, Placement& placement,
                                     const std::vector<Index>& slots);

/// --fit: all wall nodes inside patches slide along the CAD until each face follows it as closely
/// as its order can (smooth/surface_fit.hpp), order by order, patch by patch. Deviations are
/// measured again, so that fewer faces may ask for more order.
/// @param wanted_distance  by wall face: the deviation asked; faces that reach it at the order
/// before are left alone
void fit_wall(const LinearMesh& mesh, const Topology& topology, const Association& association,
              const GeometryModel& model, const Wall& wall,
              const std::vector<double>& wanted_distance, Placement& placement);

}  // namespace camber
