#pragma once
// Gmsh's element numbers.
#include <camber/basis/shape.hpp>

#include <optional>
#include <span>
#include <string>

namespace camber::io::gmsh {

/// A full Lagrange element that Camber handles.
struct ElementType {
  Shape shape = Shape::point;
  int order = 1;
  int node_count = 1;
};

/// Element type of a Gmsh number; none if Camber cannot take it (see explain_type).
[[nodiscard]] std::optional<ElementType> element_type(std::int64_t gmsh_number);

/// Why a number without element_type is refused, e.g. "element type 16 (8-node serendipity
/// quadrilateral)", and what to do about it.
struct Refusal {
  std::string found, remedy;
};
[[nodiscard]] Refusal explain_type(std::int64_t gmsh_number);

/// Gmsh number of the full Lagrange element, order 1 to 4. @throws std::invalid_argument otherwise.
[[nodiscard]] int gmsh_number(Shape shape, int order);

/// file2canonical of node_order.hpp for Gmsh; the identity for a point.
[[nodiscard]] std::span<const int> gmsh_to_canonical(Shape shape, int order);

}  // namespace camber::io::gmsh
