#include <camber/page/boundary_faces.hpp>

#include <algorithm>
#include <array>

namespace camber {
namespace {

using Key = std::array<Index, 4>;  // sorted corner nodes; k_none first for triangles

struct KeyedFace {
  Key key;
  std::size_t element;
  int local;  // k_surface: a surface element
};
constexpr int k_surface = -1;

Key sorted_key(std::array<Index, 4> corners) {
  std::sort(corners.begin(), corners.end());
  return corners;
}

std::vector<KeyedFace> keyed_faces(const ElementList& cells, const ElementList& surfaces) {
  std::vector<KeyedFace> list;
  list.reserve(cells.size() * 5 + surfaces.size());
  for (std::size_t i = 0; i < surfaces.size(); ++i) {
    const std::vector<int>& corner = lattice_map(surfaces.shape(i), surfaces.order(i)).corner;
    Key key{k_none, k_none, k_none, k_none};
    for (std::size_t k = 0; k < corner.size(); ++k) {
      key[k] = surfaces.nodes(i)[static_cast<std::size_t>(corner[k])];
    }
    list.push_back({sorted_key(key), i, k_surface});
  }
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const int count = static_cast<int>(faces(cells.shape(c)).size());
    for (int f = 0; f < count; ++f) {
      list.push_back({sorted_key(face_corners(cells, {c, f, k_none})), c, f});
    }
  }
  return list;
}

}  // namespace

std::array<Index, 4> face_corners(const ElementList& cells, const BoundaryFace& face) {
  const LocalFace& local = faces(cells.shape(face.cell))[static_cast<std::size_t>(face.local)];
  const std::vector<int>& corner =
      lattice_map(cells.shape(face.cell), cells.order(face.cell)).corner;
  std::array<Index, 4> result{k_none, k_none, k_none, k_none};
  for (std::size_t k = 0; k < 4 && local.corners[k] >= 0; ++k) {
    const int node = corner[static_cast<std::size_t>(local.corners[k])];
    result[k] = cells.nodes(face.cell)[static_cast<std::size_t>(node)];
  }
  return result;
}

Shape gather_face(const ElementList& cells, const BoundaryFace& face, Points& nodes) {
  const Shape shape = cells.shape(face.cell);
  thread_local Points all;
  cells.gather(face.cell, all);
  const auto f = static_cast<std::size_t>(face.local);
  const std::vector<int>& on_face = lattice_map(shape, cells.order(face.cell)).face[f];
  nodes.resize(on_face.size());
  for (std::size_t n = 0; n < on_face.size(); ++n) {
    nodes[n] = all[static_cast<std::size_t>(on_face[n])];
  }
  return faces(shape)[f].shape;
}

std::vector<BoundaryFace> boundary_faces(const ElementList& cells, const ElementList& surfaces) {
  std::vector<KeyedFace> list = keyed_faces(cells, surfaces);
  // Surface elements come first within a key: the list is stable, and they were listed first.
  std::stable_sort(list.begin(), list.end(),
                   [](const KeyedFace& a, const KeyedFace& b) { return a.key < b.key; });
  std::vector<BoundaryFace> result;
  for (std::size_t begin = 0, end = 0; begin < list.size(); begin = end) {
    while (end < list.size() && list[end].key == list[begin].key) ++end;
    std::size_t first_cell = begin;
    while (first_cell < end && list[first_cell].local == k_surface) ++first_cell;
    if (end - first_cell != 1) continue;  // inside, or a surface element without a cell
    const KeyedFace& face = list[first_cell];
    result.push_back({face.element, face.local,
                      first_cell > begin ? static_cast<Index>(list[begin].element) : k_none});
  }
  std::sort(result.begin(), result.end(), [](const BoundaryFace& a, const BoundaryFace& b) {
    return a.cell != b.cell ? a.cell < b.cell : a.local < b.local;
  });
  return result;
}

}  // namespace camber
