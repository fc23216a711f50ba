#pragma once
// The nodes of MFEM's H1 elements on Gauss-Lobatto points (collection "H1_3D_Pp").
#include <camber/basis/shape.hpp>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace camber::io::mfem {

/// Nodes strictly inside one corner, edge, face or the cell itself, in the order in which the file
/// lists them where the entity is seen from this element.
struct NodeGroup {
  int dim = 0;                       // 0 corner, 1 edge, 2 face, 3 the cell itself
  std::array<int, 4> corners{};      // of the element; the first dim + 1, or 4 of a square face
  std::size_t first = 0, count = 0;  // into ElementNodes::xi
  Shape shape = Shape::point;        // of the entity
};

struct ElementNodes {
  std::vector<Vec3> xi;           // reference coordinates, as in shape.hpp
  std::vector<NodeGroup> groups;  // corners, edges, faces, interior, each in MFEM's order
};

/// Corners in both programs are the same. Edges walk from their first corner; triangles list
/// (x_i f0 + x_j f1 + x_k f2) / (x_i + x_j + x_k) with Gauss-Lobatto points x, squares the tensor
/// product, i fastest, in the axes f0 -> f1 and f0 -> last. Inside a pyramid: the nodes of the
/// space of Fuentes et al. (2015), MFEM's default since 4.8, which contains the space of
/// lagrange.hpp.
/// Source: MFEM's documentation of mesh formats and the files that it ships.
/// @param shape  triangle, quadrilateral or a cell
/// @param p      1..k_max_order. Cached; any thread.
[[nodiscard]] const ElementNodes& element_nodes(Shape shape, int p);

/// Number of the shape in the file ("geometry type").
[[nodiscard]] int geometry_type(Shape shape);

}  // namespace camber::io::mfem
