#include <camber/io/cgns/detail/zone_join.hpp>

#include <algorithm>
#include <numeric>

namespace camber::io::cgns {
namespace {

/// Of the box diagonal: writers round coordinates to single precision at worst.
constexpr double k_same_place = 1e-6;

Index root(std::vector<Index>& parent, Index i) {
  while (parent[at(i)] != i) {
    parent[at(i)] = parent[at(parent[at(i)])];
    i = parent[at(i)];
  }
  return i;
}

}  // namespace

void join_nodes(MeshData& mesh, const std::vector<std::pair<Index, Index>>& pairs) {
  if (pairs.empty()) return;
  Box box;
  for (const Vec3& x : mesh.points) box.add(x);
  const double reach = k_same_place * box.diagonal();
  std::vector<Index> parent(mesh.points.size());
  std::iota(parent.begin(), parent.end(), Index{0});
  for (const auto& [a, b] : pairs) {
    if ((mesh.points[at(a)] - mesh.points[at(b)]).norm() > reach) continue;
    const Index ra = root(parent, a), rb = root(parent, b);
    parent[at(std::max(ra, rb))] = std::min(ra, rb);
  }
  std::vector<Index> place(mesh.points.size());
  Index next = 0;
  for (Index i = 0; at(i) < mesh.points.size(); ++i) {
    const Index r = root(parent, i);
    if (r != i) {
      place[at(i)] = place[at(r)];
      continue;
    }
    place[at(i)] = next;
    mesh.points[at(next++)] = mesh.points[at(i)];
  }
  mesh.points.resize(at(next));
  for (ElementBlock& block : mesh.blocks) {
    for (Index& n : block.nodes) n = place[at(n)];
  }
}

}  // namespace camber::io::cgns
