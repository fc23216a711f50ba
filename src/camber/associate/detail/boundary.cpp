#include <camber/associate/association.hpp>
#include <camber/associate/detail/boundary.hpp>

#include <algorithm>
#include <limits>

namespace camber {

Boundary collect_boundary(const LinearMesh& mesh, const Topology& topology) {
  Boundary boundary;
  boundary.face_slot.assign(topology.face_count(), k_none);
  boundary.vertex_slot.assign(mesh.vertices.size(), k_none);
  boundary.edge_faces.assign(topology.edge_count(), {k_none, k_none});
  for (const auto& [entity, faces] : boundary_faces_by_entity(mesh, topology)) {
    for (Index f : faces) {
      Boundary::Face face{f, entity, topology.corners_of_face(f), {}, {}, 0.0, 0.0, 0.0};
      face.centre = Vec3::Zero();
      face.normal = outward_normal(mesh, topology, f);
      face.shortest = std::numeric_limits<double>::infinity();
      const Vec3& first = mesh.vertices[at(topology.face2vertex[at(f)][0])];
      Vec3 area = Vec3::Zero();
      for (int i = 0; i < face.corners; ++i) {
        const std::size_t next = static_cast<std::size_t>((i + 1) % face.corners);
        const Vec3& a = mesh.vertices[at(topology.face2vertex[at(f)][static_cast<std::size_t>(i)])];
        const Vec3& b = mesh.vertices[at(topology.face2vertex[at(f)][next])];
        face.centre += a / face.corners;
        area += 0.5 * (a - first).cross(b - first);
        face.shortest = std::min(face.shortest, (b - a).norm());
        face.longest = std::max(face.longest, (b - a).norm());
      }
      face.area = area.norm();
      boundary.face_slot[at(f)] = static_cast<Index>(boundary.faces.size());
      boundary.faces.push_back(face);
    }
  }
  for (std::size_t s = 0; s < boundary.faces.size(); ++s) {
    const Boundary::Face& face = boundary.faces[s];
    for (int i = 0; i < face.corners; ++i) {
      const std::size_t k = static_cast<std::size_t>(i);
      std::array<Index, 2>& sides = boundary.edge_faces[at(topology.face2edge[at(face.face)][k])];
      (sides[0] == k_none ? sides[0] : sides[1]) = static_cast<Index>(s);
      const Index v = topology.face2vertex[at(face.face)][k];
      if (boundary.vertex_slot[at(v)] == k_none) {
        boundary.vertex_slot[at(v)] = static_cast<Index>(boundary.vertices.size());
        boundary.vertices.push_back(v);
        boundary.longest_at.push_back(0.0);
      }
      double& longest = boundary.longest_at[at(boundary.vertex_slot[at(v)])];
      longest = std::max(longest, face.longest);
    }
  }
  return boundary;
}

}  // namespace camber
