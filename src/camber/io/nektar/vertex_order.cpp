#include <camber/base/error.hpp>
#include <camber/io/detail/mesh_check.hpp>
#include <camber/io/nektar/vertex_order.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <numeric>
#include <queue>

namespace camber::io::nektar {
namespace {

/// visit(corners of the cell as points) for the cells of one shape.
template <class Visit>
void for_each_cell(const MeshData& mesh, Shape shape, const Visit& visit) {
  std::vector<Index> corners;
  for (const ElementBlock& b : mesh.blocks) {
    if (b.shape != shape) continue;
    const std::vector<int>& corner = lattice_map(shape, b.order).corner;
    const auto per = static_cast<std::size_t>(nodes_per_element(shape, b.order));
    for (std::size_t e = 0; e < b.nodes.size(); e += per) {
      corners.clear();
      for (const int c : corner) corners.push_back(b.nodes[e + static_cast<std::size_t>(c)]);
      visit(corners);
    }
  }
}

/// Sets of points, each known by its lowest point.
class Columns {
 public:
  explicit Columns(std::size_t points) : parent_(points) {
    std::iota(parent_.begin(), parent_.end(), 0);
  }
  Index of(Index i) {
    while (parent_[at(i)] != i) {
      parent_[at(i)] = parent_[at(parent_[at(i)])];
      i = parent_[at(i)];
    }
    return i;
  }
  void join(Index a, Index b) {
    a = of(a);
    b = of(b);
    parent_[at(std::max(a, b))] = std::min(a, b);
  }

 private:
  std::vector<Index> parent_;
};

[[noreturn]] void fail(const char* what, const std::string& display) {
  throw FileError(what, display, "write .msh and let NekMesh convert it");
}

}  // namespace

std::vector<Index> number_vertices(const MeshData& mesh, const std::string& display) {
  const std::size_t n = mesh.points.size();
  Columns columns(n);
  for_each_cell(mesh, Shape::prism, [&](const std::vector<Index>& v) {
    for (std::size_t i = 0; i < 3; ++i) columns.join(v[i], v[i + 3]);
  });
  std::vector<std::vector<Index>> members(n), above(n);  // by column
  std::vector<int> below(n, 0);
  std::vector<char> is_corner(n, 0);
  for (const Shape shape : {Shape::tetrahedron, Shape::pyramid, Shape::prism, Shape::hexahedron}) {
    for_each_cell(mesh, shape, [&](const std::vector<Index>& v) {
      for (const Index i : v) is_corner[at(i)] = 1;
    });
  }
  for (Index i = 0; at(i) < n; ++i) {
    if (is_corner[at(i)] != 0) members[at(columns.of(i))].push_back(i);
  }
  for_each_cell(mesh, Shape::pyramid, [&](const std::vector<Index>& v) {
    for (std::size_t i = 0; i < 4; ++i) {
      above[at(columns.of(v[i]))].push_back(columns.of(v[4]));
      ++below[at(columns.of(v[4]))];
    }
  });
  std::priority_queue<Index, std::vector<Index>, std::greater<>> ready;
  std::size_t left = 0;
  for (Index c = 0; at(c) < n; ++c) {
    if (members[at(c)].empty()) continue;
    ++left;
    if (below[at(c)] == 0) ready.push(c);
  }
  std::vector<Index> number(n, k_none);
  Index next = 0;
  while (!ready.empty()) {
    const Index c = ready.top();
    ready.pop();
    --left;
    for (const Index i : members[at(c)]) number[at(i)] = next++;
    for (const Index apex : above[at(c)]) {
      if (--below[at(apex)] == 0) ready.push(apex);
    }
  }
  if (left > 0)
    fail("pyramids stand on the apexes of each other, which Nektar++ cannot have", display);
  for_each_cell(mesh, Shape::prism, [&](const std::vector<Index>& v) {
    const auto highest = [&](std::size_t first) {
      std::size_t best = 0;
      for (std::size_t i = 1; i < 3; ++i) {
        if (number[at(v[first + i])] > number[at(v[first + best])]) best = i;
      }
      return best;
    };
    if (highest(0) != highest(3)) {
      fail("a stack of prisms meets itself, which Nektar++ cannot have", display);
    }
  });
  return number;
}

}  // namespace camber::io::nektar
