#pragma once
// libMeshb's mesh format (GMF, Medit): what refine and the GAMMA tools write.
#include <camber/mesh/mesh_data.hpp>

#include <string>
#include <string_view>

namespace camber::io {

inline constexpr int k_meshb_curves = 1000000;

/// Reads a linear volume mesh, binary (.meshb; versions 1 to 4, either byte order) or text (.mesh),
/// told apart by the first bytes. Every reference r of faces and cells is one entity with the tag
/// r, named surface_r or volume_r; references below 1 get tags above all others. Numbers of faces
/// are those of the CAD in files of EGADS tools, so that these link by tags as Gmsh's do; numbers
/// of curves and vertices are not those of a STEP file of the same body: curve_r has the tag r +
/// k_meshb_curves, which no CAD has, and links find curves between faces.
/// VerticesOnGeometricVertices, -Edges, -Triangles and -Quadrilaterals classify their nodes in the
/// same numbers; the lowest dimension wins. Parameters are left out: they are those of another CAD
/// kernel. Other keywords are read past, and named in the log.
/// @throws FileError naming path, line (text) or byte (binary), what was found, what was expected;
///         for elements of higher order, polyhedra and two dimensions
/// Cost: linear in the file, which is held in memory. Any thread.
[[nodiscard]] MeshData read_meshb(const std::string& path);

/// The same from memory; `path` is used in messages only.
[[nodiscard]] MeshData parse_meshb(const std::string& path, std::string_view bytes);

}  // namespace camber::io
