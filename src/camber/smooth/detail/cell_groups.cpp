#include <camber/base/sorted_set.hpp>
#include <camber/smooth/detail/cell_groups.hpp>

#include <algorithm>
#include <map>
#include <numeric>
#include <unordered_map>

namespace camber::detail {

std::vector<Index> curved_neighbours(const CurvedMesh& curved, const std::vector<Index>& cells) {
  std::vector<Index> around = with_neighbours(curved.topology(), cells);
  std::erase_if(around, [&](Index c) { return curved.cell_order(c) < 2; });
  return around;
}

std::vector<std::uint8_t> nodes_of(const CurvedMesh& curved, const std::vector<Index>& cells,
                                   const std::vector<std::uint8_t>& is_free) {
  std::vector<std::uint8_t> is_own(is_free.size(), 0);
  for (Index c : cells) {
    for_each_node_range(curved, c, [&](std::size_t first, std::size_t count) {
      for (std::size_t i = first; i < first + count; ++i) is_own[i] = is_free[i];
    });
  }
  return is_own;
}

std::vector<std::vector<Index>> connected_groups(const Topology& topology,
                                                 const std::vector<Index>& cells) {
  std::vector<Index> parent(cells.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](Index i) {
    while (parent[at(i)] != i) i = parent[at(i)] = parent[at(parent[at(i)])];
    return i;
  };
  std::unordered_map<Index, Index> first_on_edge;
  for (Index i = 0; at(i) < cells.size(); ++i) {
    for (Index e : topology.edges_of_cell(cells[at(i)])) {
      const Index a = root(first_on_edge.emplace(e, i).first->second), b = root(i);
      parent[at(std::max(a, b))] = std::min(a, b);
    }
  }
  std::map<Index, std::vector<Index>> by_root;
  for (Index i = 0; at(i) < cells.size(); ++i) by_root[root(i)].push_back(cells[at(i)]);
  std::vector<std::vector<Index>> groups;
  for (auto& [first, group] : by_root) groups.push_back(std::move(group));
  return groups;
}

}  // namespace camber::detail
