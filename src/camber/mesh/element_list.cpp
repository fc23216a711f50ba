#include <camber/mesh/element_list.hpp>

namespace camber {

ElementList::ElementList(const MeshData& data, int dim)
    : data_(&data), first_(data.blocks.size(), 0) {
  for (std::size_t b = 0; b < data.blocks.size(); ++b) {
    if (dimension(data.blocks[b].shape) != dim) continue;
    first_[b] = block_of_.size();
    block_of_.insert(block_of_.end(), data.blocks[b].size(), b);
  }
}

GlobalId ElementList::tag(std::size_t i) const {
  const std::vector<GlobalId>& tags = block(i).tags;
  return tags.empty() ? static_cast<GlobalId>(i + 1) : tags[i - first_[block_of_[i]]];
}

std::span<const Index> ElementList::nodes(std::size_t i) const {
  const ElementBlock& b = block(i);
  const auto stride = static_cast<std::size_t>(node_count(b.shape, b.order));
  return std::span(b.nodes).subspan((i - first_[block_of_[i]]) * stride, stride);
}

void ElementList::gather(std::size_t i, Points& points) const {
  const std::span<const Index> n = nodes(i);
  points.resize(n.size());
  for (std::size_t k = 0; k < n.size(); ++k) points[k] = data_->points[at(n[k])];
}

Vec3 ElementList::centre(std::size_t i) const {
  const std::span<const Index> n = nodes(i);
  const std::vector<int>& corner = lattice_map(shape(i), order(i)).corner;
  Vec3 sum = Vec3::Zero();
  for (int c : corner) sum += data_->points[at(n[static_cast<std::size_t>(c)])];
  return sum / static_cast<double>(corner.size());
}

}  // namespace camber
