#pragma once
// VTK unstructured grids (.vtu), linear and curved.
#include <camber/mesh/mesh_data.hpp>

#include <string>
#include <string_view>

namespace camber::io {

/// Reads a .vtu file: text, base64, or appended data (raw or base64), any number of pieces. Cells
/// are the linear ones, the complete quadratic ones and Lagrange cells of order 1 to 4, with the
/// node order of the file's version. The cell array "entity", "CellEntityIds", "gmsh:geometrical",
/// "attribute" or "material", whichever comes first in this list, tells surfaces and volumes apart;
/// other arrays, points and lines are left out.
/// @throws FileError naming path and place, what was found, what was expected: compressed data,
/// other
///         cells (polyhedra, cells without inner nodes), nodes out of range, pyramids of order 3 or
///         4 that write_vtu cut into pieces for viewing
/// Cost: linear in the file, which is held in memory. Any thread.
[[nodiscard]] MeshData read_vtu(const std::string& path);

/// The same from memory; `path` is used in messages only.
[[nodiscard]] MeshData parse_vtu(const std::string& path, std::string_view bytes);

}  // namespace camber::io
