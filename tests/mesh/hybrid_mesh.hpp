#pragma once
// A small mesh with all four shapes, its boundary partly covered, for tests.
#include <camber/basis/lagrange.hpp>
#include <camber/mesh/mesh_data.hpp>

#include <cmath>
#include <functional>

namespace camber::testing {

/// A block of one linear element from its corners.
inline ElementBlock linear_block(Shape shape, int entity, GlobalId tag,
                                 const std::vector<Index>& corner) {
  ElementBlock block{shape, 1, entity, std::vector<Index>(corner.size()), {tag}};
  const std::vector<int>& place = lattice_map(shape, 1).corner;
  for (std::size_t i = 0; i < corner.size(); ++i) {
    block.nodes[static_cast<std::size_t>(place[i])] = corner[i];
  }
  return block;
}

/// A unit cube with a pyramid on its top (apex at height 2), a prism at its side x = 1 and a tet on
/// the prism's front; four surface elements and a line that walk their corners in other orders than
/// the cells do. Faces: 3 between cells, 4 + 4 + 3 + 3 = 14 on the boundary. Volumes: cube 1,
/// pyramid 1/3, prism 1/2, tet 1/6.
inline MeshData hybrid_mesh() {
  MeshData data;
  data.source = "hybrid";
  data.points = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0},     {0, 1, 0},   {0, 0, 1},   {1, 0, 1},
                 {1, 1, 1}, {0, 1, 1}, {0.5, 0.5, 2}, {2, 0, 0.5}, {2, 1, 0.5}, {1.4, -1, 0.5}};
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    data.point_tags.push_back(static_cast<GlobalId>(10 * i + 1));
  }
  data.blocks = {linear_block(Shape::line, 3, 101, {5, 1}),
                 linear_block(Shape::triangle, 1, 102, {8, 4, 7}),
                 linear_block(Shape::triangle, 1, 103, {10, 2, 6}),
                 linear_block(Shape::quadrilateral, 2, 104, {3, 2, 1, 0}),
                 linear_block(Shape::quadrilateral, 2, 105, {0, 3, 7, 4}),
                 linear_block(Shape::hexahedron, 1, 106, {0, 1, 2, 3, 4, 5, 6, 7}),
                 linear_block(Shape::pyramid, 1, 107, {4, 5, 6, 7, 8}),
                 linear_block(Shape::prism, 1, 108, {1, 5, 9, 2, 6, 10}),
                 linear_block(Shape::tetrahedron, 1, 109, {1, 9, 5, 11})};
  return data;
}

/// Moves all points by a smooth map that is no polynomial.
inline void bend(MeshData& data, double amplitude = 0.05) {
  for (Vec3& x : data.points) {
    x += amplitude * Vec3(std::sin(2.0 * x.y() + x.z()), std::cos(1.5 * x.x() - x.z()),
                          std::sin(x.x() + 0.7 * x.y()));
  }
}

/// Points of element i of a block.
inline Points nodes_of(const MeshData& data, const ElementBlock& block, std::size_t i = 0) {
  const auto stride = static_cast<std::size_t>(node_count(block.shape, block.order));
  Points points;
  for (std::size_t k = 0; k < stride; ++k) {
    points.push_back(data.points[at(block.nodes[i * stride + k])]);
  }
  return points;
}

}  // namespace camber::testing
