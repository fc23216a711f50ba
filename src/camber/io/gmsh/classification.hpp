#pragma once
#include <camber/mesh/mesh_data.hpp>

#include <vector>

namespace camber::io::gmsh {

/// For every node the lowest (dimension, tag) of the entities whose elements use it; dim = -1 for
/// nodes that no element uses.
[[nodiscard]] std::vector<EntityKey> lowest_entities(const MeshData& mesh);

}  // namespace camber::io::gmsh
