#pragma once
// Which CAD entities each boundary entity of the mesh may lie on, and how its patches behave.
#include <camber/geom/geometry_model.hpp>
#include <camber/mesh/topology.hpp>

#include <array>
#include <map>
#include <string>
#include <vector>

namespace camber {

enum class PatchKind {
  cad,      // lies on CAD faces that are not all planar: nodes are placed on them
  plane,    // planar, with or without CAD: nodes may move inside the plane
  straight  // no CAD and not planar: stays as it is
};

/// A set of boundary faces with one surface entity tag.
struct Patch {
  int entity = 0;    // surface tag in the mesh file
  std::string name;  // physical name, else CAD name, else "surface 7"
  PatchKind kind = PatchKind::straight;
  GeometryGroup group;                                // CAD faces; empty without CAD
  Vec3 origin = Vec3::Zero(), normal = Vec3::Zero();  // of a plane
  std::size_t faces = 0;
};

/// The link between mesh and CAD. Groups (paper 2.1) are stored once and referred to by number.
struct Association {
  std::vector<Patch> patches;
  std::vector<Index> face2patch;          // topology face -> patch or -1 (interior)
  std::vector<GeomEntity> edge2curve;     // topology edge -> CAD curve, dim -1 if none
  std::vector<GeomEntity> vertex2entity;  // vertex -> CAD vertex, curve or face; dim -1 if none
  double scale = 1.0;                     // mesh length = scale * CAD length
  double largest_distance = 0.0;          // of an associated mesh vertex to its entity

  [[nodiscard]] const Patch* patch_of(Index face) const {
    const Index p = face2patch[at(face)];
    return p == k_none ? nullptr : &patches[at(p)];
  }
};

/// Plane through the vertices of the given faces: true if all lie within `tolerance` of it.
[[nodiscard]] bool fit_plane(const LinearMesh& mesh, const Topology& topology,
                             const std::vector<Index>& faces, double tolerance, Vec3& origin,
                             Vec3& normal);

/// Unit normal of a straight face (Newell), pointing out of its first cell.
[[nodiscard]] Vec3 outward_normal(const LinearMesh& mesh, const Topology& topology, Index face);

/// Boundary faces by patch, in patch order of `patches` (patch faces of the file; cell faces on the
/// boundary without a surface element get a patch of their own with entity 0).
[[nodiscard]] std::map<int, std::vector<Index>> boundary_faces_by_entity(const LinearMesh& mesh,
                                                                         const Topology& topology);

}  // namespace camber
