#pragma once
// STL: triangles without connectivity, binary (little-endian, 50 bytes each) or ASCII.
#include <camber/mesh/mesh_data.hpp>

#include <string>

namespace camber::io {

/// One block of triangles on surface entity 1. Corners with the same coordinates, to the bit, are
/// one point; triangles with two corners in one place are left out, normals are not read.
/// @throws FileError
[[nodiscard]] MeshData read_stl(const std::string& path);

}  // namespace camber::io
