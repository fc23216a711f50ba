#pragma once
// The elements of one dimension of a mesh file, numbered through all blocks.
#include <camber/mesh/mesh_data.hpp>

#include <span>
#include <vector>

namespace camber {

/// Elements of dimension `dim`, block after block in the order of the file. Keeps a reference to
/// the mesh. Any thread may read.
class ElementList {
 public:
  ElementList(const MeshData& data, int dim);

  [[nodiscard]] std::size_t size() const { return block_of_.size(); }
  [[nodiscard]] const ElementBlock& block(std::size_t i) const {
    return data_->blocks[block_of_[i]];
  }
  [[nodiscard]] Shape shape(std::size_t i) const { return block(i).shape; }
  [[nodiscard]] int order(std::size_t i) const { return block(i).order; }
  [[nodiscard]] int entity(std::size_t i) const { return block(i).entity; }
  /// Number in the file; position among the elements of this dimension, from 1, where it has none.
  [[nodiscard]] GlobalId tag(std::size_t i) const;
  /// Indices into MeshData::points, canonical order.
  [[nodiscard]] std::span<const Index> nodes(std::size_t i) const;
  /// Points of all nodes, canonical order.
  void gather(std::size_t i, Points& points) const;
  /// Mean of the corners.
  [[nodiscard]] Vec3 centre(std::size_t i) const;

 private:
  const MeshData* data_;
  std::vector<std::size_t> block_of_;
  std::vector<std::size_t> first_;  // by block: number of its first element in this list
};

}  // namespace camber
