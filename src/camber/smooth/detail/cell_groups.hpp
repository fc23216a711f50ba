#pragma once
// Sets of cells and of the nodes on them.
#include <camber/mesh/curved_mesh.hpp>

#include <cstdint>
#include <vector>

namespace camber::detail {

/// with_neighbours() without cells of order 1: all curved cells that depend on nodes of the cells.
[[nodiscard]] std::vector<Index> curved_neighbours(const CurvedMesh& curved,
                                                   const std::vector<Index>& cells);
/// Calls visit(first, count) for the high-order nodes of each edge, face and inside of a cell.
template <class Visit>
void for_each_node_range(const CurvedMesh& curved, Index c, const Visit& visit) {
  const Topology& topology = curved.topology();
  for (Index e : topology.edges_of_cell(c)) {
    visit(at(curved.first_edge_node(e)), curved.edge_nodes(e).size());
  }
  for (Index f : topology.faces_of_cell(c)) {
    visit(at(curved.first_face_node(f)), curved.face_nodes(f).size());
  }
  visit(at(curved.first_cell_node(c)), curved.cell_nodes(c).size());
}

/// By high-order node: on an entity of the cells, and free.
[[nodiscard]] std::vector<std::uint8_t> nodes_of(const CurvedMesh& curved,
                                                 const std::vector<Index>& cells,
                                                 const std::vector<std::uint8_t>& is_free);
/// Groups of cells connected through shared edges, by their lowest cell.
[[nodiscard]] std::vector<std::vector<Index>> connected_groups(const Topology& topology,
                                                               const std::vector<Index>& cells);

}  // namespace camber::detail
