#pragma once
#include <camber/elevate/wall.hpp>

#include <vector>

namespace camber {

/// Label of every wall face (by slot), counted from 0: faces joined over an edge have the same
/// label unless the edge is concave (seen from the cells) and sharp, more than 30 degrees between
/// the CAD normals. Walls of different labels each have a displacement of their own to carry into
/// the corner between them.
[[nodiscard]] std::vector<int> wall_sides(const LinearMesh& mesh, const Topology& topology,
                                          const Wall& wall);

}  // namespace camber
