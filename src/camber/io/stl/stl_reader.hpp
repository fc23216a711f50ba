#pragma once
// STL: triangles without connectivity, binary (little-endian, 50 bytes each) or ASCII.
#include <camber/mesh/mesh_data.hpp>

#include <string>
#include <string_view>

namespace camber::io {

/// One block of triangles on surface entity 1. Corners with the same coordinates, to the bit, are
/// one point; triangles with two corners in one place are left out, normals are not read.
/// @throws FileError
[[nodiscard]] MeshData read_stl(const std::string& path);

/// The same for the bytes of such a file. @param path for messages @throws FileError
[[nodiscard]] MeshData parse_stl(const std::string& path, std::string_view bytes);

}  // namespace camber::io
