#include <camber/elevate/wall_sides.hpp>

#include <algorithm>
#include <numeric>

namespace camber {
namespace {

/// Two walls whose CAD normals differ by more than this (cosine of 30 degrees) across a concave
/// edge are different walls to the field.
constexpr double k_sharp_cosine = 0.866;

Index root_of(std::vector<Index>& parent, Index i) {
  while (parent[at(i)] != i) i = parent[at(i)] = parent[at(parent[at(i)])];
  return i;
}

Vec3 face_centre(const LinearMesh& mesh, const Topology& topology, Index f) {
  Vec3 centre = Vec3::Zero();
  const int n = topology.corners_of_face(f);
  for (int i = 0; i < n; ++i) {
    centre += mesh.vertices[at(topology.face2vertex[at(f)][static_cast<std::size_t>(i)])] / n;
  }
  return centre;
}

Vec3 corner_normal(const Wall& wall, Index slot, Index vertex) {
  for (Index c : wall.face_corners[at(slot)]) {
    if (c != k_none && wall.corners[at(c)].vertex == vertex) return wall.corners[at(c)].normal;
  }
  return wall.facet_normal[at(slot)];
}

bool is_sharp_and_concave(const LinearMesh& mesh, const Topology& topology, const Wall& wall,
                          std::size_t edge_slot) {
  const auto [a, b] = wall.edge_faces[edge_slot];
  const std::array<Index, 2>& ends = topology.edge2vertex[at(wall.edges[edge_slot])];
  double cosine = 1.0;
  for (Index v : ends) {
    cosine = std::min(cosine, corner_normal(wall, a, v).dot(corner_normal(wall, b, v)));
  }
  const Vec3 across = face_centre(mesh, topology, wall.faces[at(b)]) - mesh.vertices[at(ends[0])];
  return across.dot(wall.facet_normal[at(a)]) < 0.0 && cosine < k_sharp_cosine;
}

}  // namespace

std::vector<int> wall_sides(const LinearMesh& mesh, const Topology& topology, const Wall& wall) {
  std::vector<Index> parent(wall.face_count());
  std::iota(parent.begin(), parent.end(), 0);
  for (std::size_t s = 0; s < wall.edge_count(); ++s) {
    const auto [a, b] = wall.edge_faces[s];
    if (b == k_none || is_sharp_and_concave(mesh, topology, wall, s)) continue;
    parent[at(root_of(parent, a))] = root_of(parent, b);
  }
  std::vector<int> label_of_root(wall.face_count(), -1), labels(wall.face_count());
  int count = 0;
  for (std::size_t s = 0; s < wall.face_count(); ++s) {
    int& label = label_of_root[at(root_of(parent, static_cast<Index>(s)))];
    if (label < 0) label = count++;
    labels[s] = label;
  }
  return labels;
}

}  // namespace camber
