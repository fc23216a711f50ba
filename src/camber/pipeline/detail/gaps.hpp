#pragma once
// Do the elements of a file fit together? Faces are matched by their corner nodes.
#include <camber/mesh/element_list.hpp>

#include <cstddef>

namespace camber {

/// What was found on the faces of the volume elements.
struct FaceFindings {
  double max_gap = 0.0;            // largest distance between two views of one face [length]
  Vec3 max_gap_at = Vec3::Zero();  // centre of that face
  int max_order_jump = 0;
  std::size_t inner_faces = 0, boundary_faces = 0;
  std::size_t crowded = 0;  // faces of more than two cells
  Vec3 crowded_at = Vec3::Zero();
  std::size_t twisted = 0;  // quadrilaterals whose corners the two cells walk differently
  std::size_t bare = 0;     // boundary faces without a surface element
  std::size_t loose = 0;    // surface elements that are no face of any cell
};

/// Matches the faces of `cells` by corner nodes, and `surfaces` with them, and evaluates what both
/// sides make of each face at the lattice of the higher order and at the sixth-order Gauss points.
/// Views that share all their nodes have no gap by construction. Parallel inside; the same bits for
/// any thread count.
[[nodiscard]] FaceFindings examine_faces(const MeshData& data, const ElementList& cells,
                                         const ElementList& surfaces);

}  // namespace camber
