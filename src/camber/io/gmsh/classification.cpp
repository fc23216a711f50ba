#include <camber/io/gmsh/classification.hpp>

namespace camber::io::gmsh {

std::vector<EntityKey> lowest_entities(const MeshData& mesh) {
  std::vector<EntityKey> lowest(mesh.points.size());
  for (const ElementBlock& block : mesh.blocks) {
    const EntityKey key{dimension(block.shape), block.entity};
    for (const Index n : block.nodes) {
      EntityKey& best = lowest[at(n)];
      if (best.dim < 0 || key < best) best = key;
    }
  }
  return lowest;
}

}  // namespace camber::io::gmsh
