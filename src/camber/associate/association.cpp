#include <camber/associate/association.hpp>

namespace camber {

bool fit_plane(const LinearMesh& mesh, const Topology& topology, const std::vector<Index>& faces,
               double tolerance, Vec3& origin, Vec3& normal) {
  // Newell normal summed over all faces is exact for a plane whatever the triangulation.
  Vec3 area = Vec3::Zero(), centre = Vec3::Zero();
  double weight = 0.0;
  for (Index f : faces) {
    const int n = topology.corners_of_face(f);
    const Vec3& first = mesh.vertices[at(topology.face2vertex[at(f)][0])];
    Vec3 face_area = Vec3::Zero(), face_centre = Vec3::Zero();
    for (int i = 0; i < n; ++i) {
      const std::size_t s = static_cast<std::size_t>(i);
      const Vec3& a = mesh.vertices[at(topology.face2vertex[at(f)][s])];
      const Vec3& b =
          mesh.vertices[at(topology.face2vertex[at(f)][(s + 1) % static_cast<std::size_t>(n)])];
      face_area += 0.5 * (a - first).cross(b - first);
      face_centre += a / n;
    }
    // Frames may run either way round; the first face sets the sense.
    if (area.dot(face_area) < 0.0) face_area = -face_area;
    area += face_area;
    centre += face_area.norm() * face_centre;
    weight += face_area.norm();
  }
  if (weight <= 0.0 || area.norm() < 0.5 * weight) return false;
  origin = centre / weight;
  normal = area.normalized();
  for (Index f : faces) {
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      const Vec3& x = mesh.vertices[at(topology.face2vertex[at(f)][static_cast<std::size_t>(i)])];
      if (std::abs((x - origin).dot(normal)) > tolerance) return false;
    }
  }
  return true;
}

Vec3 outward_normal(const LinearMesh& mesh, const Topology& topology, Index face) {
  const std::array<Index, 4>& v = topology.face2vertex[at(face)];
  const int n = topology.corners_of_face(face);
  Vec3 normal = Vec3::Zero(), centre = Vec3::Zero();
  const Vec3& first = mesh.vertices[at(v[0])];
  for (int i = 0; i < n; ++i) {
    const Vec3& a = mesh.vertices[at(v[static_cast<std::size_t>(i)])];
    const Vec3& b = mesh.vertices[at(v[static_cast<std::size_t>((i + 1) % n)])];
    normal += (a - first).cross(b - first);
    centre += a / n;
  }
  // The cell lies behind the face: thin cells still have their other vertices on that side.
  const Index cell = topology.face2cell[at(face)][0];
  Vec3 cell_centre = Vec3::Zero();
  for (Index c : mesh.cell(cell)) cell_centre += mesh.vertices[at(c)];
  cell_centre /= static_cast<double>(mesh.cell(cell).size());
  if (normal.dot(centre - cell_centre) < 0.0) normal = -normal;
  const double length = normal.norm();
  return length > 0.0 ? Vec3(normal / length) : Vec3::Zero();
}

std::map<int, std::vector<Index>> boundary_faces_by_entity(const LinearMesh& mesh,
                                                           const Topology& topology) {
  std::map<int, std::vector<Index>> by_entity;
  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    const Index b = topology.face2patch_face[at(f)];
    if (b != k_none) {
      by_entity[mesh.patch_face_entity[at(b)]].push_back(f);
    } else if (topology.is_boundary(f)) {
      by_entity[0].push_back(f);
    }
  }
  return by_entity;
}

}  // namespace camber
