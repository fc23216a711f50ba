#pragma once
// Layer columns: prisms and hexahedra stacked on a wall face through opposite faces.
#include <camber/elevate/wall.hpp>

#include <vector>

namespace camber {

struct Columns {
  std::vector<Index> base;            // vertex -> wall vertex at the foot of its column, or -1
  std::vector<double> height;         // vertex -> distance from that foot
  std::vector<Index> cell_face_slot;  // cell -> wall face slot at the foot of its column, or -1
  std::size_t column_count = 0;       // wall faces that carry at least one cell
};

/// Walks from every wall face, nearest cells first, through the opposite faces of prisms (on
/// triangles) and hexahedra (on quadrilaterals). A column ends at another shape, at the boundary,
/// or where a vertex already belongs to another foot.
[[nodiscard]] Columns find_columns(const LinearMesh& mesh, const Topology& topology,
                                   const Wall& wall);

}  // namespace camber
