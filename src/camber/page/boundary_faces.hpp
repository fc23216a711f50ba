#pragma once
// The faces of a file's cells that no other cell shares.
#include <camber/mesh/element_list.hpp>

#include <cstddef>
#include <vector>

namespace camber {

/// A face of one cell only, with the surface element of the file that lies on it.
struct BoundaryFace {
  std::size_t cell = 0;    // in ElementList(data, 3)
  int local = 0;           // face of the cell, shape.hpp
  Index surface = k_none;  // in ElementList(data, 2)
};

/// Faces are matched by their corner nodes, as check() does. Sorted by cell, then local face.
/// Cost: one sort over all faces. Threads: any.
[[nodiscard]] std::vector<BoundaryFace> boundary_faces(const ElementList& cells,
                                                       const ElementList& surfaces);

/// Nodes of a face as its cell has them: canonical order of the face's shape, outward by the
/// right-hand rule. @return the face's shape
Shape gather_face(const ElementList& cells, const BoundaryFace& face, Points& nodes);
/// Indices into MeshData::points of its corners; [3] is k_none for a triangle.
[[nodiscard]] std::array<Index, 4> face_corners(const ElementList& cells, const BoundaryFace& face);

}  // namespace camber
