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
  std::sort(candidates.begin(), candidates.end());
  candidates.erase(std::unique(candidates.begin(), candidates.end()), candidates.end());

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

}  // namespace camber
