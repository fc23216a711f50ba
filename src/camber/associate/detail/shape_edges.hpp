#pragma once
// Mesh edges on CAD curves and mesh vertices on CAD vertices, from the faces around them.
#include <camber/associate/association.hpp>
#include <camber/associate/detail/face_match.hpp>

#include <vector>

namespace camber {

/// Fills association.edge2curve, vertex2entity and largest_distance. Patches are made already.
void link_edges_and_vertices(const LinearMesh& mesh, const Topology& topology,
                             const Boundary& boundary, const GeometryModel& model,
                             const FaceMatch& match, const std::vector<double>& reach,
                             Association& association);

}  // namespace camber
