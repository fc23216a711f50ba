#pragma once
// Small connected meshes of all four cells for writers that number edges and faces.
#include <camber/mesh/mesh_data.hpp>

#include <string>

namespace camber::io {

/// Two hexes, two pyramids, three tets and a prism that share faces, bent by a smooth map; all of
/// one order. Nodes are shared; points are in random order, and every cell starts at a random
/// corner (all numberings that keep the shape positive occur). Boundary faces are the surface
/// elements of two patches, "wall" and "far & <away>"; cells are in the volumes "left" and "right".
[[nodiscard]] MeshData hybrid(int order, unsigned seed);

/// The same cells of orders 2 to 4 (pyramids: 2), bent by a quadratic map, so that every cell makes
/// the same of a common face. Neighbours of one order share nodes, others their corners only.
[[nodiscard]] MeshData hybrid_of_mixed_order(unsigned seed);

/// A cube of side 2, bent by a smooth map, in 8 hexes or 48 tets; otherwise as hybrid().
[[nodiscard]] MeshData bent_cube(Shape shape, int order, unsigned seed);

/// What the independent readers compare with: lines "volume V", "area A" for each cell and surface
/// element of dimension 3 and 2, and "node X Y Z" for each point of the mesh, "inner X Y Z" for
/// those inside of a cell.
void write_sizes(const MeshData& mesh, const std::string& path);

}  // namespace camber::io
