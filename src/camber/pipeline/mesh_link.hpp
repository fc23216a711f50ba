#pragma once
// MeshLink files against a mesh and a CAD: what they say, and what to write.
#include <camber/associate/given_link.hpp>
#include <camber/io/meshlink/meshlink.hpp>

#include <string>

namespace camber {

/// The link's answers for the faces and edges of a mesh, asked by the node numbers of its file. CAD
/// entities by number (face_3, edge_5) or by a name of the CAD, which may stand for several. The
/// file's only model is meant, or the one of its models that knows most faces.
/// @throws GeometryError if the CAD has no such entity, or the link knows no face of the mesh
[[nodiscard]] GivenLink given_link(const io::MeshLink& link, const LinearMesh& mesh,
                                   const Topology& topology, const GeometryModel& model);

/// The association as a MeshLink file: one sheet a patch, one string a CAD curve, one point a CAD
/// vertex. Patches without CAD are sheets without geometry.
[[nodiscard]] io::MeshLink mesh_link_of(const LinearMesh& mesh, const Topology& topology,
                                        const Association& association, const GeometryModel& model,
                                        const std::string& mesh_path, const std::string& cad_path);

}  // namespace camber
