#include <camber/elevate/columns.hpp>

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <queue>
#include <tuple>

namespace camber {
namespace {

/// Corner opposite to `corner` along the stacking direction that starts at local face `face`, for
/// every corner of that face; nothing if the shape has no opposite face there.
std::optional<std::array<int, 4>> opposite_corners(Shape shape, const LocalFace& face) {
  std::array<int, 4> across{-1, -1, -1, -1};
  const bool is_stackable = (shape == Shape::prism && face.shape == Shape::triangle) ||
                            (shape == Shape::hexahedron && face.shape == Shape::quadrilateral);
  if (!is_stackable) return {};
  const std::size_t n = face.shape == Shape::triangle ? 3 : 4;
  const auto on_face = [&](int c) {
    for (std::size_t i = 0; i < n; ++i) {
      if (face.corners[i] == c) return true;
    }
    return false;
  };
  for (const std::array<int, 2>& edge : edges(shape)) {
    if (on_face(edge[0]) == on_face(edge[1])) continue;
    const int low = on_face(edge[0]) ? edge[0] : edge[1],
              high = on_face(edge[0]) ? edge[1] : edge[0];
    for (std::size_t i = 0; i < n; ++i) {
      if (face.corners[i] == low) across[i] = high;
    }
  }
  return across;
}

/// A cell to be stacked next on a column; `height` is that of the lowest vertex it would add.
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
    if (columns.cell_face_slot[at(here.cell)] != k_none) continue;
    const Shape shape = mesh.cell_shape[at(here.cell)];
    const std::span<const Index> cell_faces = topology.faces_of_cell(here.cell);
    std::size_t local = 0;
    while (cell_faces[local] != here.face) ++local;
    const LocalFace& face = faces(shape)[local];
    const auto across = opposite_corners(shape, face);
    if (!across) continue;
    const std::span<const Index> v = mesh.cell(here.cell);
    const std::size_t n = face.shape == Shape::triangle ? 3 : 4;
    bool fits = true;
    for (std::size_t i = 0; i < n; ++i) {
      const Index low = v[static_cast<std::size_t>(face.corners[i])];
      const Index high = v[static_cast<std::size_t>((*across)[i])];
      const Index known = columns.base[at(high)];
      fits = fits && (known == k_none || known == columns.base[at(low)]);
    }
    if (!fits) continue;
    double top = 1e300;
    for (std::size_t i = 0; i < n; ++i) {
      const Index low = v[static_cast<std::size_t>(face.corners[i])];
      const Index high = v[static_cast<std::size_t>((*across)[i])];
      const Index foot = columns.base[at(low)];
      columns.base[at(high)] = foot;
      columns.height[at(high)] = (mesh.vertices[at(high)] - mesh.vertices[at(foot)]).norm();
      top = std::min(top, columns.height[at(high)]);
    }
    columns.cell_face_slot[at(here.cell)] = here.slot;
    if (here.is_first) ++columns.column_count;
    // The opposite face is the one that shares no corner with the face we came from.
    for (std::size_t j = 0; j < cell_faces.size(); ++j) {
      const LocalFace& other = faces(shape)[j];
      bool shares = false;
      for (int a : other.corners) {
        for (int b : face.corners) shares = shares || (a >= 0 && a == b);
      }
      if (shares) continue;
      const std::array<Index, 2>& cells = topology.face2cell[at(cell_faces[j])];
      const Index beyond = cells[0] == here.cell ? cells[1] : cells[0];
      if (beyond != k_none) front.push({top, cell_faces[j], beyond, here.slot, false});
    }
  }
  return columns;
}

}  // namespace camber
