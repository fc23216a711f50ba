#pragma once
// Nektar++ geometry as XML.
#include <camber/io/detail/named_mesh.hpp>
#include <camber/io/file_summary.hpp>

#include <string>

namespace camber::io {

/// What the names of composites allow: anything; volumes are kept.
[[nodiscard]] NameRules nektar_name_rules();

/// Writes the GEOMETRY section of a Nektar++ session as plain text, for a mesh whose elements all
/// have one order p: vertices, edges, faces, elements, curved edges and faces, one composite for
/// each patch and for each volume and shape, all volumes as domain. Expansions and conditions are
/// the user's.
///
/// Shape is carried by edges and faces alone, p + 1 equidistant points along each
/// (PolyEvenlySpaced, NodalTriEvenlySpaced): nodes inside of cells are dropped, the volume of a
/// cell stays. A face that is straight to rounding gets no points; the edges of a curved face
/// always do, as Nektar++ wants as many on them as on the face (which is why orders cannot be mixed
/// among curved faces). Vertices and cells are numbered for collapsed coordinates, see
/// vertex_order.hpp.
/// @throws FileError if the disk refuses, a coordinate is not finite, orders differ, a surface
///         element is no face of a cell, neighbours make different shapes of what they share, or
///         the collapsed coordinates cannot be aligned
/// Cost: linear in the mesh; its edges and faces with their points in memory.
[[nodiscard]] FileSummary write_nektar(const NamedMesh& named, const std::string& path,
                                       const std::string& display);

}  // namespace camber::io
