#pragma once
// Numbers of vertices that suit collapsed coordinates.
#include <camber/mesh/mesh_data.hpp>

#include <string>
#include <vector>

namespace camber::io::nektar {

/// In Nektar++ each triangle has one corner into which its coordinates collapse, and all cells must
/// agree on it. Here it is the corner of the highest number, so the numbers must make that corner
/// fit the cells: in a pyramid the apex, in a prism two corners that an edge joins; a tet takes
/// any.
///
/// Vertices along the long edges of prisms form columns, which are numbered one after the other,
/// those of an apex after those of its base. Within these bounds the order of the points is kept.
/// @return point -> vertex number, k_none for points that are no corner of a cell
/// @throws FileError if no such numbers were found: apexes that are the base of each other, or
///         columns that meet themselves in a triangle
[[nodiscard]] std::vector<Index> number_vertices(const MeshData& mesh, const std::string& display);

}  // namespace camber::io::nektar
