#pragma once
#include <camber/mesh/mesh_data.hpp>

#include <utility>
#include <vector>

namespace camber::io::cgns {

/// Joins the nodes of each pair that lie at one place; the lower number stays, what is left is
/// numbered without gaps. `nodes` of all blocks follow.
void join_nodes(MeshData& mesh, const std::vector<std::pair<Index, Index>>& pairs);

}  // namespace camber::io::cgns
