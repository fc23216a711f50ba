#pragma once
// A block of n^3 hexahedra of some order, bent onto an ellipsoid: meshes for the tests of the page.
#include <camber/basis/lattice.hpp>
#include <camber/mesh/mesh_data.hpp>

#include <map>

namespace camber::test {

/// Cube to ball: rays through the centre are kept, the cube's surface goes onto the unit sphere.
inline Vec3 onto_ball(const Vec3& x) {
  const double length = x.norm();
  return length > 0.0 ? Vec3(x * (x.cwiseAbs().maxCoeff() / length)) : x;
}

/// Cells of [-1,1]^3 with nodes moved onto the ball, then scaled along the axes. Surface elements
/// only on the side z = 1, with entity 7 named "top".
inline MeshData round_block(int n, int order, const Vec3& axes = Vec3::Ones()) {
  MeshData data;
  data.source = "block.msh";
  std::map<std::array<int, 3>, Index> known;
  const auto node = [&](const std::array<int, 3>& at) {
    const auto [place, is_new] = known.try_emplace(at, static_cast<Index>(data.points.size()));
    if (is_new) {
      Vec3 x;
      for (int d = 0; d < 3; ++d) x[d] = 2.0 * at[static_cast<std::size_t>(d)] / (n * order) - 1.0;
      data.points.push_back(onto_ball(x).cwiseProduct(axes));
    }
    return place->second;
  };
  ElementBlock cells{Shape::hexahedron, order, 1, {}, {}};
  ElementBlock top{Shape::quadrilateral, order, 7, {}, {}};
  for (int k = 0; k < n; ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        for (const LatticePoint& p : lattice(Shape::hexahedron, order)) {
          cells.nodes.push_back(node({i * order + p[0], j * order + p[1], k * order + p[2]}));
        }
        cells.tags.push_back(100 + static_cast<GlobalId>(cells.tags.size()));
        if (k + 1 < n) continue;
        for (const LatticePoint& p : lattice(Shape::quadrilateral, order)) {
          top.nodes.push_back(node({i * order + p[0], j * order + p[1], n * order}));
        }
      }
    }
  }
  data.blocks = {cells, top};
  data.entities = {{{2, 7}, "top", {}, {}}};
  return data;
}

}  // namespace camber::test
