#pragma once
// Elements as VTK cells.
#include <camber/mesh/mesh_data.hpp>

#include <cstdint>
#include <vector>

namespace camber::io::vtu {

/// Cells in the layout of a .vtu file.
struct Cells {
  Points points;  // those of the mesh, then extra ones of quadratic pyramids
  std::vector<std::int64_t> connectivity;  // places in points, cell after cell
  std::vector<std::int64_t> offsets;       // end of each cell in connectivity
  std::vector<std::uint8_t> types;
  std::vector<std::size_t> cell2element;  // over all blocks of the mesh in order
  std::vector<std::size_t> cell2block;
};

/// Surface and volume elements of a mesh (points and lines are left out). Linear elements become
/// the linear VTK cells (10, 12, 13, 14, 5, 9), curved ones Lagrange cells of their order (69..73),
/// curved pyramids of order 2 the 19-node pyramid (37), whose added nodes are evaluated from the
/// element. VTK has no pyramid of order 3 or more: those are cut along their lattice into linear
/// pyramids and tetrahedra that fit each other and the lattices of the neighbours' faces.
[[nodiscard]] Cells make_cells(const MeshData& mesh);

}  // namespace camber::io::vtu
