#include <camber/base/parallel.hpp>
#include <camber/elevate/wall.hpp>

#include <algorithm>

namespace camber {
namespace {

/// A CAD normal that differs from the facets by more than this (cosine) is not believed: the foot
/// point lies on a fold, a pole or a wrong sheet.
constexpr double k_least_agreement = 0.2;

/// A plane is a wall if most cells on it are lower than this share of their face's shortest edge.
constexpr double k_flat_cell = 0.5;

/// Height of the face's first cell over the shortest edge of the face.
double relative_height(const LinearMesh& mesh, const Topology& topology, Index f) {
  const Vec3 normal = outward_normal(mesh, topology, f);
  const std::array<Index, 4>& v = topology.face2vertex[at(f)];
  const int n = topology.corners_of_face(f);
  double shortest = 1e300, height = 0.0;
  for (int i = 0; i < n; ++i) {
    const Vec3& a = mesh.vertices[at(v[static_cast<std::size_t>(i)])];
    const Vec3& b = mesh.vertices[at(v[static_cast<std::size_t>((i + 1) % n)])];
    shortest = std::min(shortest, (a - b).norm());
  }
  for (Index c : mesh.cell(topology.face2cell[at(f)][0])) {
    height = std::max(height, (mesh.vertices[at(v[0])] - mesh.vertices[at(c)]).dot(normal));
  }
  return height / shortest;
}

bool is_stacking_face(const LinearMesh& mesh, const Topology& topology, Index f) {
  const Shape cell = mesh.cell_shape[at(topology.face2cell[at(f)][0])];
  return (cell == Shape::prism && topology.face_shape[at(f)] == Shape::triangle) ||
         (cell == Shape::hexahedron && topology.face_shape[at(f)] == Shape::quadrilateral);
}

/// How a plane meets the curved walls around it: edges shared, and those where one cell has both
/// faces (layers that end on the plane).
struct PlaneEdges {
  std::size_t shared = 0, lateral = 0;
};

std::vector<PlaneEdges> count_plane_edges(const Topology& topology,
                                          const Association& association) {
  std::vector<std::array<Index, 2>> cell_on_edge(topology.edge_count(), {k_none, k_none});
  std::vector<PlaneEdges> count(association.patches.size());
  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    const Patch* patch = association.patch_of(f);
    if (!patch || patch->kind != PatchKind::cad) continue;
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      std::array<Index, 2>& cells =
          cell_on_edge[at(topology.face2edge[at(f)][static_cast<std::size_t>(i)])];
      (cells[0] == k_none ? cells[0] : cells[1]) = topology.face2cell[at(f)][0];
    }
  }
  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    const Patch* patch = association.patch_of(f);
    if (!patch || patch->kind != PatchKind::plane) continue;
    PlaneEdges& here = count[at(association.face2patch[at(f)])];
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      const std::array<Index, 2>& cells =
          cell_on_edge[at(topology.face2edge[at(f)][static_cast<std::size_t>(i)])];
      if (cells[0] == k_none) continue;
      const Index own = topology.face2cell[at(f)][0];
      ++here.shared;
      here.lateral += own == cells[0] || own == cells[1];
    }
  }
  return count;
}

std::vector<std::uint8_t> find_wall_patches(const LinearMesh& mesh, const Topology& topology,
                                            const Association& association) {
  const std::size_t n = association.patches.size();
  std::vector<std::uint8_t> is_wall(n, 0);
  std::vector<std::size_t> stacking(n, 0), flat(n, 0);
  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    const Patch* patch = association.patch_of(f);
    if (!patch || patch->kind != PatchKind::plane || patch->group.empty()) continue;
    const std::size_t p = at(association.face2patch[at(f)]);
    if (!is_stacking_face(mesh, topology, f)) continue;
    ++stacking[p];
    flat[p] += relative_height(mesh, topology, f) < k_flat_cell;
  }
  const std::vector<PlaneEdges> edges = count_plane_edges(topology, association);
  for (std::size_t p = 0; p < n; ++p) {
    const Patch& patch = association.patches[p];
    const bool carries_layers = 2 * stacking[p] > patch.faces;
    const bool adjoins_wall = edges[p].shared > 0 && 2 * edges[p].lateral <= edges[p].shared;
    const bool is_flat = edges[p].shared == 0 && 2 * flat[p] > patch.faces;
    is_wall[p] = patch.kind == PatchKind::cad || (carries_layers && (adjoins_wall || is_flat));
  }
  return is_wall;
}

void collect_corners(const Topology& topology, const Association& association, Wall& wall) {
  std::vector<std::pair<Index, Index>> keys;  // (vertex, patch)
  for (Index f : wall.faces) {
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      keys.emplace_back(topology.face2vertex[at(f)][static_cast<std::size_t>(i)],
                        association.face2patch[at(f)]);
    }
  }
  std::sort(keys.begin(), keys.end());
  keys.erase(std::unique(keys.begin(), keys.end()), keys.end());
  wall.corners.resize(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) {
    wall.corners[i].vertex = keys[i].first;
    wall.corners[i].patch = keys[i].second;
  }
  wall.face_corners.resize(wall.faces.size());
  for (std::size_t s = 0; s < wall.faces.size(); ++s) {
    const Index f = wall.faces[s];
    wall.face_corners[s] = {-1, -1, -1, -1};
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      const std::pair key{topology.face2vertex[at(f)][static_cast<std::size_t>(i)],
                          association.face2patch[at(f)]};
      wall.face_corners[s][static_cast<std::size_t>(i)] =
          static_cast<Index>(std::lower_bound(keys.begin(), keys.end(), key) - keys.begin());
    }
  }
}

}  // namespace

Wall build_wall(const LinearMesh& mesh, const Topology& topology, const Association& association,
                const GeometryModel& model) {
  Wall wall;
  wall.is_wall_patch = find_wall_patches(mesh, topology, association);
  wall.face_slot.assign(topology.face_count(), k_none);
  wall.edge_slot.assign(topology.edge_count(), k_none);
  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    const Index patch = association.face2patch[at(f)];
    if (patch == k_none || !wall.is_wall_patch[at(patch)]) continue;
    wall.face_slot[at(f)] = static_cast<Index>(wall.faces.size());
    wall.faces.push_back(f);
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      const Index e = topology.face2edge[at(f)][static_cast<std::size_t>(i)];
      if (wall.edge_slot[at(e)] == k_none) {
        wall.edge_slot[at(e)] = static_cast<Index>(wall.edges.size());
        wall.edges.push_back(e);
        wall.edge_faces.push_back({k_none, k_none});
      }
      std::array<Index, 2>& faces = wall.edge_faces[at(wall.edge_slot[at(e)])];
      (faces[0] == k_none ? faces[0] : faces[1]) = wall.face_slot[at(f)];
    }
  }
  wall.facet_normal.resize(wall.faces.size());
  for (std::size_t s = 0; s < wall.faces.size(); ++s) {
    wall.facet_normal[s] = outward_normal(mesh, topology, wall.faces[s]);
  }
  collect_corners(topology, association, wall);
  std::vector<Vec3> average(wall.corners.size(), Vec3::Zero());
  for (std::size_t s = 0; s < wall.faces.size(); ++s) {
    for (Index c : wall.face_corners[s]) {
      if (c != k_none) average[at(c)] += wall.facet_normal[s];
    }
  }
  parallel_for_with(
      wall.corners.size(), 128, [&] { return model.projector(); },
      [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
        for (std::size_t i = begin; i < end; ++i) {
          WallCorner& corner = wall.corners[i];
          const Vec3 facets = average[i].normalized();
          const Projection foot =
              project_to_group(*projector, association.patches[at(corner.patch)].group,
                               mesh.vertices[at(corner.vertex)]);
          corner.face = foot.entity;
          corner.uv = foot.uv;
          corner.normal = facets;
          if (foot.status == ProjectionStatus::failed) continue;
          Vec3 normal = projector->evaluate_face(foot.entity.tag, foot.uv).normal;
          if (normal.dot(facets) < 0.0) normal = -normal;
          if (normal.dot(facets) >= k_least_agreement) corner.normal = normal;
        }
      });
  return wall;
}

}  // namespace camber
