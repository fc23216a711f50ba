#pragma once
// Gmsh .msh 4.1 and 2.2, text and binary.
#include <camber/mesh/mesh_data.hpp>

#include <string>
#include <string_view>

namespace camber::io {

/// Reads a .msh file: linear and complete curved elements to order 4 of all shapes, points and
/// lines.
///
/// Version 4.1: one block per element block of the file; classification and parameters of the
/// nodes, boxes and groups of the entities as stated there. Version 2.2: one block per element type
/// and entity; a node is classified on the lowest (dimension, tag) of the elements that use it,
/// unless the file says so itself ($ParametricNodes); elements that the file repeats for a second
/// physical group are taken once; an elementary tag shared by different elements of several groups
/// is split into one entity a group. Sections without meaning for a mesh are skipped.
/// @throws FileError naming path, line (text) or byte (binary), what was found, what was expected.
/// Cost: linear in the file, which is held in memory while it is parsed. Any thread.
[[nodiscard]] MeshData read_gmsh(const std::string& path);

/// The same from memory; `path` is used in messages only.
[[nodiscard]] MeshData parse_gmsh(const std::string& path, std::string_view bytes);

}  // namespace camber::io
