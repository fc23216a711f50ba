#pragma once
#include <camber/basis/shape.hpp>

#include <array>
#include <cstdint>
#include <optional>

namespace camber::io::su2 {

struct ElementType {
  Shape shape = Shape::point;
  int order = 1;
};

/// VTK numbers of the linear cells; an order is added as 100 (order - 1).
struct Code {
  Shape shape;
  int number;
};
inline constexpr std::array k_codes{Code{Shape::line, 3},          Code{Shape::triangle, 5},
                                    Code{Shape::quadrilateral, 9}, Code{Shape::tetrahedron, 10},
                                    Code{Shape::pyramid, 14},      Code{Shape::prism, 13},
                                    Code{Shape::hexahedron, 12}};

[[nodiscard]] inline std::optional<ElementType> element_type(std::int64_t code) {
  const std::int64_t geometry = code % 10000;
  if (code < 0) return std::nullopt;
  for (const Code& known : k_codes) {
    const std::int64_t order = 1 + geometry / 100;
    if (geometry % 100 == known.number && order <= k_max_order) {
      return ElementType{known.shape, static_cast<int>(order)};
    }
  }
  return std::nullopt;
}

[[nodiscard]] inline int element_code(Shape shape, int order) {
  int number = 0;
  for (const Code& known : k_codes) {
    if (known.shape == shape) number = known.number;
  }
  return number + 100 * (order - 1);
}

}  // namespace camber::io::su2
