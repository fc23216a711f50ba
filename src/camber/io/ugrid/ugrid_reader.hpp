#pragma once
// UGRID files of AFLR3 and its many readers; linear.
#include <camber/mesh/mesh_data.hpp>

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

namespace camber::io {

/// Reads NAME.ugrid (text), NAME.b8.ugrid, .lb8, .r8 or .lr8. A patch is the faces of one tag; its
/// name is that of NAME.mapbc, if it is there and gives one, else "surface_TAG". The order of a
/// boundary face's corners is taken as it stands: it tells nothing about the side of the fluid.
/// What follows the hexes is not read.
/// @throws FileError naming path, line (text) or byte (binary), what was found, what was expected.
/// Cost: linear in the file, which is held in memory. Any thread.
[[nodiscard]] MeshData read_ugrid(const std::string& path);

/// The same from memory; the kind follows from the name. `mapbc` may be empty.
[[nodiscard]] MeshData parse_ugrid(const std::string& path, std::string_view bytes,
                                   std::string_view mapbc);

/// Patch names by tag as a .mapbc file gives them: a count, then "tag boundary_condition name" a
/// line; the name may be missing. @throws FileError
[[nodiscard]] std::map<std::int64_t, std::string> parse_mapbc(const std::string& path,
                                                              std::string_view text);

}  // namespace camber::io
