#pragma once
// What a .msh file says beyond MeshData: defaults filled in, items sorted.
#include <camber/mesh/mesh_data.hpp>

#include <string>
#include <vector>

namespace camber::io::gmsh {

/// Nodes of one entity, all with or all without parameters.
struct NodeBlock {
  EntityKey entity;
  bool parametric = false;
  std::size_t begin = 0, end = 0;  // range of WritePlan::point_order
};

struct WritePlan {
  std::vector<EntityRecord>
      entities;                      // sorted by key: those of the mesh and those its items lie on
  std::vector<GlobalId> point_tags;  // [point]
  std::vector<Index> point_order;    // points sorted by entity
  std::vector<NodeBlock> node_blocks;
  std::vector<std::vector<GlobalId>> element_tags;  // [block][element]
};

/// @throws std::invalid_argument if arrays of the mesh contradict each other; FileError (naming
///         `display`) for coordinates that are not finite or more than one node of a number.
[[nodiscard]] WritePlan plan_write(const MeshData& mesh, const std::string& display);

}  // namespace camber::io::gmsh
