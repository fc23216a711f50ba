#include <camber/elevate/columns.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <queue>
#include <span>
#include <tuple>

namespace camber {
namespace {

/// The lateral edges of a prism split into tets are shorter than this share of its foot's edges.
constexpr double k_lateral_share = 0.8;

/// Cells stacked at once on a foot face: one prism or hexahedron, or the three tets of a prism.
struct Stack {
  std::size_t corner_count = 0;
  std::array<Index, 4> low{}, high{};  // corners of the foot; the vertices above them
  std::array<Index, 3> cells{k_none, k_none, k_none};
  Index top_face = k_none, beyond = k_none;  // the face opposite to the foot; the cell behind it
};

Index across(const Topology& topology, Index face, Index cell) {
  const std::array<Index, 2>& sides = topology.face2cell[at(face)];
  return sides[0] == cell ? sides[1] : sides[0];
}

/// Face of the cell that has none of the given vertices.
Index face_without(const Topology& topology, Index cell, std::span<const Index> vertices) {
  for (Index f : topology.faces_of_cell(cell)) {
    const std::array<Index, 4>& corners = topology.face2vertex[at(f)];
    const bool shares = std::any_of(vertices.begin(), vertices.end(), [&](Index v) {
      return std::find(corners.begin(), corners.end(), v) != corners.end();
    });
    if (!shares) return f;
  }
  return k_none;
}

/// A prism on a triangle or a hexahedron on a quadrilateral.
std::optional<Stack> single_cell(const LinearMesh& mesh, const Topology& topology, Index face,
                                 Index cell) {
  const Shape shape = mesh.cell_shape[at(cell)], foot = topology.face_shape[at(face)];
  if (!(shape == Shape::prism && foot == Shape::triangle) &&
      !(shape == Shape::hexahedron && foot == Shape::quadrilateral)) {
    return {};
  }
  Stack stack;
  stack.corner_count = foot == Shape::triangle ? 3 : 4;
  stack.low = topology.face2vertex[at(face)];
  stack.cells[0] = cell;
  const std::span<const Index> low(stack.low.data(), stack.corner_count);
  const std::span<const Index> v = mesh.cell(cell);
  for (const std::array<int, 2>& edge : edges(shape)) {
    const Index a = v[static_cast<std::size_t>(edge[0])], b = v[static_cast<std::size_t>(edge[1])];
    const auto low_a = std::find(low.begin(), low.end(), a),
               low_b = std::find(low.begin(), low.end(), b);
    if ((low_a == low.end()) == (low_b == low.end())) continue;
    const auto corner = low_a == low.end() ? low_b : low_a;
    stack.high[static_cast<std::size_t>(corner - low.begin())] = low_a == low.end() ? a : b;
  }
  stack.top_face = face_without(topology, cell, low);
  stack.beyond = across(topology, stack.top_face, cell);
  return stack;
}

/// The three tets of a prism on a triangle: the apex of each stands over one corner of the foot,
/// the next tet lies across the face opposite to that corner.
std::optional<Stack> three_tets(const LinearMesh& mesh, const Topology& topology, Index face,
                                Index cell) {
  if (topology.face_shape[at(face)] != Shape::triangle) return {};
  Stack stack;
  stack.corner_count = 3;
  stack.low = topology.face2vertex[at(face)];
  stack.high = {k_none, k_none, k_none, k_none};
  double shortest = 1e300;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 edge = mesh.vertices[at(stack.low[i])] - mesh.vertices[at(stack.low[(i + 1) % 3])];
    shortest = std::min(shortest, edge.norm());
  }
  Index below = face;
  for (Index& slot : stack.cells) {
    if (cell == k_none || mesh.cell_shape[at(cell)] != Shape::tetrahedron) return {};
    slot = cell;
    const std::array<Index, 4>& base = topology.face2vertex[at(below)];
    const std::span<const Index> v = mesh.cell(cell);
    const Index apex = *std::find_if(v.begin(), v.end(), [&](Index w) {
      return std::find(base.begin(), base.begin() + 3, w) == base.begin() + 3;
    });
    std::size_t corner = 3;
    double nearest = k_lateral_share * shortest;
    for (std::size_t i = 0; i < 3; ++i) {
      if (stack.high[i] != k_none) continue;
      const double distance = (mesh.vertices[at(apex)] - mesh.vertices[at(stack.low[i])]).norm();
      if (distance < nearest) {
        nearest = distance;
        corner = i;
      }
    }
    if (corner == 3) return {};
    stack.high[corner] = apex;
    below = face_without(topology, cell, {&stack.low[corner], 1});
    cell = across(topology, below, cell);
  }
  stack.top_face = below;
  stack.beyond = cell;
  return stack;
}

/// None of the cells is on a column yet, and no vertex above belongs to another foot.
bool fits(const Columns& columns, const Stack& stack) {
  for (Index c : stack.cells) {
    if (c != k_none && columns.cell_face_slot[at(c)] != k_none) return false;
  }
  for (std::size_t i = 0; i < stack.corner_count; ++i) {
    const Index known = columns.base[at(stack.high[i])];
    if (known != k_none && known != columns.base[at(stack.low[i])]) return false;
  }
  return true;
}

/// Where a column goes on; `height` is that of the lowest vertex it would add.
struct Front {
  double height;
  Index face, cell, slot;
  bool is_first;
  friend bool operator>(const Front& a, const Front& b) {
    return std::tie(a.height, a.cell, a.slot) > std::tie(b.height, b.cell, b.slot);
  }
};

}  // namespace

Columns find_columns(const LinearMesh& mesh, const Topology& topology, const Wall& wall) {
  Columns columns;
  columns.base.assign(mesh.vertices.size(), k_none);
  columns.height.assign(mesh.vertices.size(), 0.0);
  columns.cell_face_slot.assign(mesh.cell_count(), k_none);
  // Nearest first: where columns of two walls meet, each cell belongs to the wall that is nearer.
  std::priority_queue<Front, std::vector<Front>, std::greater<>> front;
  for (std::size_t s = 0; s < wall.face_count(); ++s) {
    const Index f = wall.faces[s];
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      const Index v = topology.face2vertex[at(f)][static_cast<std::size_t>(i)];
      columns.base[at(v)] = v;
    }
    for (Index c : topology.face2cell[at(f)]) {
      if (c != k_none) front.push({0.0, f, c, static_cast<Index>(s), true});
    }
  }
  while (!front.empty()) {
    const Front here = front.top();
    front.pop();
    std::optional<Stack> stack = single_cell(mesh, topology, here.face, here.cell);
    if (!stack) stack = three_tets(mesh, topology, here.face, here.cell);
    if (!stack || !fits(columns, *stack)) continue;
    double top = 1e300;
    for (std::size_t i = 0; i < stack->corner_count; ++i) {
      const Index foot = columns.base[at(stack->low[i])], high = stack->high[i];
      columns.base[at(high)] = foot;
      columns.height[at(high)] = (mesh.vertices[at(high)] - mesh.vertices[at(foot)]).norm();
      top = std::min(top, columns.height[at(high)]);
    }
    for (Index c : stack->cells) {
      if (c != k_none) columns.cell_face_slot[at(c)] = here.slot;
    }
    if (here.is_first) ++columns.column_count;
    if (stack->beyond != k_none) {
      front.push({top, stack->top_face, stack->beyond, here.slot, false});
    }
  }
  return columns;
}

}  // namespace camber
