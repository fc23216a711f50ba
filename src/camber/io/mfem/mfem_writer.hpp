#pragma once
// MFEM's own mesh format, version 1.0, with curved elements.
#include <camber/io/detail/named_mesh.hpp>
#include <camber/io/file_summary.hpp>

#include <string>

namespace camber::io {

/// What the comments that carry the names allow: no line ends; volumes are kept.
[[nodiscard]] NameRules mfem_name_rules();

/// Writes a mesh whose elements all have one order p. The attributes of elements and boundary
/// elements are the numbers of their volume or patch, 1, 2, ...; comments at the top tell the
/// names. For p > 1 the shape is a `nodes` grid function of the collection H1_3D_Pp: the element's
/// own polynomial at Gauss-Lobatto points. Its unknowns follow MFEM's numbers of edges and faces,
/// which are those of their first appearance in the list of elements. A pyramid of p > 1 needs MFEM
/// 4.8.
/// @throws FileError if the disk refuses, a coordinate is not finite, orders differ, a surface
///         element is no face of a cell, or neighbours make different curves or faces of what they
///         share (one value for both is all that the format can hold)
/// Cost: linear in the mesh; one table of its edges and faces in memory.
[[nodiscard]] FileSummary write_mfem(const NamedMesh& named, const std::string& path,
                                     const std::string& display);

}  // namespace camber::io
