#pragma once
// Edges and faces of the linear mesh, with their orientation as seen from the cells.
#include <camber/base/by_key.hpp>
#include <camber/mesh/linear_mesh.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace camber {

/// Every edge and face once. An edge runs from its smaller to its larger vertex. A face starts at
/// its smallest vertex and goes round towards the smaller of that vertex's two neighbours: the
/// frame in which its nodes are stored.
struct Topology {
  std::vector<std::array<Index, 2>> edge2vertex;
  std::vector<Shape> face_shape;
  std::vector<std::array<Index, 4>> face2vertex;  // in the face's frame; [3] = -1 for triangles
  std::vector<std::array<Index, 4>> face2edge;    // edge i joins corners i and i+1 of the frame
  std::vector<std::array<Index, 2>> face2cell;    // [1] = -1 on the boundary

  std::vector<Index> cell2edge_offset, cell2edge;  // local edges of shape.hpp
  std::vector<std::uint8_t> cell2edge_reversed;    // local edge runs against the stored one
  std::vector<Index> cell2face_offset, cell2face;  // local faces of shape.hpp
  std::vector<std::uint8_t>
      cell2face_view;  // index into face_views(): local corner -> frame corner

  std::vector<Index> edge2cell_offset, edge2cell;

  std::vector<Index> patch_face2face;  // LinearMesh patch face -> face
  std::vector<Index> face2patch_face;  // face -> patch face or -1

  [[nodiscard]] std::size_t edge_count() const { return edge2vertex.size(); }
  [[nodiscard]] std::size_t face_count() const { return face_shape.size(); }
  [[nodiscard]] std::span<const Index> edges_of_cell(Index c) const {
    return {cell2edge.data() + cell2edge_offset[at(c)],
            static_cast<std::size_t>(cell2edge_offset[at(c) + 1] - cell2edge_offset[at(c)])};
  }
  [[nodiscard]] std::span<const Index> faces_of_cell(Index c) const {
    return {cell2face.data() + cell2face_offset[at(c)],
            static_cast<std::size_t>(cell2face_offset[at(c) + 1] - cell2face_offset[at(c)])};
  }
  [[nodiscard]] std::span<const Index> cells_of_edge(Index e) const {
    return {edge2cell.data() + edge2cell_offset[at(e)],
            static_cast<std::size_t>(edge2cell_offset[at(e) + 1] - edge2cell_offset[at(e)])};
  }
  [[nodiscard]] int corners_of_face(Index f) const {
    return face_shape[at(f)] == Shape::triangle ? 3 : 4;
  }
  [[nodiscard]] bool is_boundary(Index f) const { return face2cell[at(f)][1] == k_none; }
  /// Edge between two vertices, or k_none.
  [[nodiscard]] Index find_edge(Index a, Index b) const;
};

/// The cells and all that share an edge or more with one of them, sorted.
[[nodiscard]] std::vector<Index> with_neighbours(const Topology& topology,
                                                 const std::vector<Index>& cells);

/// @throws MeshError if a face has more than two cells, a surface element is no face of any cell,
/// or a
///         quadrilateral's corners are walked differently by those who share it.
[[nodiscard]] Topology build_topology(const LinearMesh& mesh);

/// The views of a face: view w maps corner i of the viewer to corner face_view(shape, w)[i] of the
/// frame. Triangle 6 views, quadrilateral 8.
[[nodiscard]] std::span<const std::array<int, 4>> face_views(Shape shape);
/// The view of a face (frame corners as in face2vertex) for a viewer who lists its corners in
/// another order, or -1 if the viewer walks other corners or twists a quadrilateral.
[[nodiscard]] int face_view(Shape shape, std::span<const Index> viewer,
                            const std::array<Index, 4>& frame);
/// Lattice nodes of order q of the straight face, in its frame.
[[nodiscard]] Points straight_face_nodes(const LinearMesh& mesh, const Topology& topology, Index f,
                                         int q);
/// The node permutations that belong to them: result[n] = frame node at the viewer's node n.
[[nodiscard]] std::span<const int> face_view_nodes(Shape shape, int view, int p);
/// The same among the nodes inside: result[k] = place, among the face's own nodes, of the one at
/// the viewer's k-th interior node.
[[nodiscard]] std::span<const int> face_view_interior(Shape shape, int view, int p);

}  // namespace camber
