#pragma once
// Mesh edges on CAD curves and mesh vertices on CAD vertices, from the faces around them.
#include <camber/associate/association.hpp>
#include <camber/associate/detail/face_match.hpp>

#include <vector>

namespace camber {

/// Fills association.edge2curve, vertex2entity and largest_distance. Patches are made already.
/// @param given  by topology edge: curves to choose from, where somebody said so; may be empty.
///               Where nobody did, only edges between two CAD faces are linked if it is not empty.
void link_edges_and_vertices(const LinearMesh& mesh, const Topology& topology,
                             const Boundary& boundary, const GeometryModel& model,
                             const FaceMatch& match, const std::vector<double>& reach,
                             const std::vector<GeometryGroup>& given, Association& association);

}  // namespace camber
