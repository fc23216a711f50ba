#pragma once
// SU2's own mesh format, linear and curved.
#include <camber/mesh/mesh_data.hpp>

#include <string>
#include <string_view>

namespace camber::io {

/// Reads a .su2 file in three dimensions: NELEM, NPOIN, NMARK in any order, other keys skipped. An
/// element's code is VTK type + 100 (order - 1), further thousands (the solution's order) are
/// dropped. Linear prisms are taken mirrored if most of the file have a negative volume, as
/// programs differ. Every marker is a patch of its name; partitioned files (SEND_RECEIVE) are
/// refused. All cells belong to one volume "volume".
/// @throws FileError naming path and line, what was found, what was expected
/// Cost: linear in the file, which is held in memory. Any thread.
[[nodiscard]] MeshData read_su2(const std::string& path);

/// The same from memory; `path` is used in messages only.
[[nodiscard]] MeshData parse_su2(const std::string& path, std::string_view bytes);

}  // namespace camber::io
