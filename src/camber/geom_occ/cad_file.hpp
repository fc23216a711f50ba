#pragma once
#include <camber/geom/geometry_model.hpp>

#include <memory>
#include <string>

namespace camber {

/// Reads .step/.stp, .iges/.igs or .brep (by extension, case ignored) with OpenCASCADE.
/// Entities are numbered as Gmsh numbers them: sub-shapes of all solids first, then shells, faces,
/// wires, edges, then the whole. Lengths are those of the file's own unit converted to millimetres
/// (OpenCASCADE's habit, and Gmsh's); use set_scale for another unit.
/// @throws FileError (missing, unreadable, truncated), GeometryError (no faces)
[[nodiscard]] std::unique_ptr<GeometryModel> read_cad(const std::string& path);

}  // namespace camber
