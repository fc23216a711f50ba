#include <camber/base/sorted_set.hpp>
#include <camber/elevate/pinched.hpp>

#include <algorithm>
#include <array>

namespace camber {
namespace {

/// Patches (at most two) whose wall faces meet in the edge.
std::array<Index, 2> patches_of_edge(const Association& association, const Wall& wall, Index slot) {
  std::array<Index, 2> patches{k_none, k_none};
  for (std::size_t i = 0; i < 2; ++i) {
    const Index face_slot = wall.edge_faces[at(slot)][i];
    if (face_slot != k_none) patches[i] = association.face2patch[at(wall.faces[at(face_slot)])];
  }
  return patches;
}

}  // namespace

std::vector<Index> find_pinched_cells(const LinearMesh& mesh, const Topology& topology,
                                      const Association& association, const Wall& wall) {
  // Only cells on a wall edge can be pinched.
  std::vector<Index> candidates;
  for (Index e : wall.edges) {
    for (Index c : topology.cells_of_edge(e)) candidates.push_back(c);
  }
  make_sorted_set(candidates);

  std::vector<Index> pinched;
  for (Index c : candidates) {
    const Shape shape = mesh.cell_shape[at(c)];
    const std::span<const Index> cell_edges = topology.edges_of_cell(c);
    bool is_pinched = false;
    for (int corner = 0; corner < corner_count(shape) && !is_pinched; ++corner) {
      std::vector<std::array<Index, 2>> at_corner;
      int others = 0;
      for (std::size_t i = 0; i < cell_edges.size(); ++i) {
        const std::array<int, 2>& ends = edges(shape)[i];
        if (ends[0] != corner && ends[1] != corner) continue;
        const Index slot = wall.edge_slot[at(cell_edges[i])];
        if (slot == k_none) {
          ++others;
        } else {
          at_corner.push_back(patches_of_edge(association, wall, slot));
        }
      }
      if (others > 0 || at_corner.size() < 3) continue;
      for (Index patch : at_corner.front()) {
        is_pinched =
            is_pinched ||
            (patch != k_none && std::all_of(at_corner.begin(), at_corner.end(), [&](const auto& p) {
               return p[0] == patch || p[1] == patch;
             }));
      }
    }
    if (is_pinched) pinched.push_back(c);
  }
  return pinched;
}

std::vector<Index> edges_behind_pinched_tets(const LinearMesh& mesh, const Topology& topology,
                                             const Wall& wall, const std::vector<Index>& pinched) {
  std::vector<Index> behind;
  for (Index c : pinched) {
    if (mesh.cell_shape[at(c)] != Shape::tetrahedron) continue;
    // The corner that a wall face lacks is an end of the edge wanted.
    std::vector<Index> ends;
    for (Index f : topology.faces_of_cell(c)) {
      if (wall.face_slot[at(f)] == k_none) continue;
      const std::array<Index, 4>& corners = topology.face2vertex[at(f)];
      for (Index v : mesh.cell(c)) {
        if (std::find(corners.begin(), corners.end(), v) == corners.end()) ends.push_back(v);
      }
    }
    if (ends.size() == 2) behind.push_back(topology.find_edge(ends[0], ends[1]));
  }
  make_sorted_set(behind);
  return behind;
}

}  // namespace camber
