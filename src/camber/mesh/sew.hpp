#pragma once
#include <camber/mesh/linear_mesh.hpp>

#include <cstddef>

namespace camber {

/// Joins parts of a mesh that touch but do not share vertices (layers and tets written by two
/// meshers): vertices with bitwise equal coordinates become one where all of them lie on boundary
/// faces without a surface element. Slits and baffles whose two sides are listed as surface
/// elements stay open. Vertices keep their order; the lowest of each group remains. @return
/// vertices removed
std::size_t sew_coincident_vertices(LinearMesh& mesh);

}  // namespace camber
