#pragma once
// VTK unstructured grids (.vtu) with curved cells, for ParaView and PyVista.
#include <camber/io/file_summary.hpp>
#include <camber/mesh/mesh_data.hpp>

#include <string>

namespace camber::io {

struct VtuWriteOptions {
  bool binary = true;  // raw appended data; else text
};

/// Writes the surface and volume elements (see vtu_cells.hpp for the cell types) with cell data
///   dim, order, entity, group (first physical tag, 0 if none), element (number in the mesh, from 0
///   over all blocks), and each of mesh.element_fields (NaN where it has no value).
/// A pyramid of order 3 or 4 becomes several cells that repeat its data. File version 2.2: older
/// versions have another node order in hexahedra.
/// @param display  name used in errors (the user's file, when `path` is a temporary)
/// @throws FileError if the disk refuses or a coordinate is not finite; std::invalid_argument if
/// the
///         arrays of `mesh` contradict each other
[[nodiscard]] FileSummary write_vtu(const MeshData& mesh, const std::string& path,
                                    const VtuWriteOptions& options, const std::string& display);

}  // namespace camber::io
