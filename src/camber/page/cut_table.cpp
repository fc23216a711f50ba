#include <camber/basis/lattice.hpp>
#include <camber/page/cut_table.hpp>

#include <algorithm>
#include <map>
#include <optional>
#include <stdexcept>

namespace camber {
namespace {

using Grid = std::array<int, 3>;  // a, b, c of the header

/// Lattice point of a grid point; empty where it lies outside of the shape.
std::optional<LatticePoint> inside(Shape shape, const Grid& g) {
  const auto [a, b, c] = g;
  switch (shape) {
    case Shape::hexahedron:
      return LatticePoint{a, b, c};
    case Shape::prism:
      if (b > a) return {};
      return LatticePoint{a - b, b, c};
    case Shape::tetrahedron:
      if (b > a || c > b) return {};
      return LatticePoint{a - b, b - c, c};
    case Shape::pyramid:
      if (c > a || c > b) return {};
      return LatticePoint{a - c, b - c, c};
    default:
      throw std::invalid_argument("only volume shapes are cut");
  }
}

int orientation(const std::array<LatticePoint, 4>& x) {
  std::array<std::array<int, 3>, 3> e{};
  for (std::size_t k = 0; k < 3; ++k) {
    for (std::size_t d = 0; d < 3; ++d) e[k][d] = x[k + 1][d] - x[0][d];
  }
  return e[0][0] * (e[1][1] * e[2][2] - e[1][2] * e[2][1]) -
         e[0][1] * (e[1][0] * e[2][2] - e[1][2] * e[2][0]) +
         e[0][2] * (e[1][0] * e[2][1] - e[1][1] * e[2][0]);
}

}  // namespace

std::vector<std::array<int, 4>> lattice_tetrahedra(Shape shape, int level) {
  if (level < 1) throw std::invalid_argument("a lattice has at least one cell a side");
  std::vector<std::array<int, 4>> tets;
  const auto add_walk = [&](Grid at, const Grid& axes) {
    std::array<LatticePoint, 4> corner{};
    for (std::size_t k = 0; k < 4; ++k) {
      const std::optional<LatticePoint> point = inside(shape, at);
      if (!point) return;
      corner[k] = *point;
      if (k < 3) ++at[static_cast<std::size_t>(axes[k])];
    }
    if (orientation(corner) < 0) std::swap(corner[2], corner[3]);
    std::array<int, 4> tet{};
    for (std::size_t k = 0; k < 4; ++k) tet[k] = lattice_index(shape, level, corner[k]);
    tets.push_back(tet);
  };
  for (int c = 0; c < level; ++c) {
    for (int b = 0; b < level; ++b) {
      for (int a = 0; a < level; ++a) {
        Grid axes{0, 1, 2};
        do add_walk({a, b, c}, axes);
        while (std::next_permutation(axes.begin(), axes.end()));
      }
    }
  }
  return tets;
}

std::vector<std::array<int, 3>> skin(const std::vector<std::array<int, 4>>& tets) {
  // Facets of a positive tetrahedron, outward.
  constexpr std::array<std::array<std::size_t, 3>, 4> k_facets{
      {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
  std::map<std::array<int, 3>, std::pair<int, std::array<int, 3>>> seen;
  for (const std::array<int, 4>& tet : tets) {
    for (const auto& facet : k_facets) {
      const std::array<int, 3> triangle{tet[facet[0]], tet[facet[1]], tet[facet[2]]};
      std::array<int, 3> key = triangle;
      std::sort(key.begin(), key.end());
      auto& [count, first] = seen[key];
      if (count++ == 0) first = triangle;
    }
  }
  std::vector<std::array<int, 3>> result;
  for (const auto& [key, entry] : seen) {
    if (entry.first == 1) result.push_back(entry.second);
  }
  return result;
}

std::vector<std::array<int, 3>> lattice_triangles(Shape shape, int level) {
  if (shape != Shape::triangle && shape != Shape::quadrilateral) {
    throw std::invalid_argument("only triangles and quadrilaterals are divided into triangles");
  }
  std::vector<std::array<int, 3>> result;
  const auto node = [&](int i, int j) { return lattice_index(shape, level, {i, j, 0}); };
  for (int j = 0; j < level; ++j) {
    const int width = shape == Shape::triangle ? level - j : level;
    for (int i = 0; i < width; ++i) {
      result.push_back({node(i, j), node(i + 1, j), node(i, j + 1)});
      if (shape == Shape::quadrilateral || i + 1 < width) {
        result.push_back({node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)});
      }
    }
  }
  return result;
}

}  // namespace camber
