#pragma once
// Layer columns: prisms, hexahedra and prisms split into three tetrahedra, stacked on a wall face.
#include <camber/elevate/wall.hpp>

#include <vector>

namespace camber {

struct Columns {
  std::vector<Index> base;            // vertex -> wall vertex at the foot of its column, or -1
  std::vector<double> height;         // vertex -> distance from that foot
  std::vector<Index> cell_face_slot;  // cell -> wall face slot at the foot of its column, or -1
  std::size_t column_count = 0;       // wall faces that carry at least one cell
};

/// Walks from every wall face, nearest cells first, through the opposite faces of prisms and of
/// prisms split into three tets (on triangles) and of hexahedra (on quadrilaterals). Three tets
/// count as a prism if each, in turn, puts its apex over a corner of the face below, nearer to it
/// than k_lateral_share of that face's shortest edge: cells as high as wide are no layer. A column
/// ends at another shape, at the boundary, or where a vertex already belongs to another foot.
[[nodiscard]] Columns find_columns(const LinearMesh& mesh, const Topology& topology,
                                   const Wall& wall);

}  // namespace camber
