#pragma once
#include <camber/mesh/mesh_data.hpp>

#include <string>

namespace camber::io {

/// Nodes of one element; a point has one.
[[nodiscard]] int nodes_per_element(Shape shape, int order);

/// What every writer relies on.
/// @param display  name of the file in errors
/// @throws std::invalid_argument if arrays of the mesh contradict each other or an order is outside
///         1..4; FileError for a coordinate that is not finite
void check_mesh(const MeshData& mesh, const std::string& display);

}  // namespace camber::io
