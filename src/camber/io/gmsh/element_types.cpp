#include <camber/basis/node_order.hpp>
#include <camber/io/detail/mesh_check.hpp>
#include <camber/io/gmsh/element_types.hpp>

#include <algorithm>
#include <array>
#include <stdexcept>

#include <fmt/format.h>

namespace camber::io::gmsh {
namespace {

struct Numbers {
  Shape shape;
  std::array<int, k_max_order> of_order;  // orders 1..4
};
// Gmsh reference manual, "MSH file format", list of elm-type; checked against gmsh 4.8.
constexpr std::array<Numbers, 8> k_numbers{{{Shape::point, {15, 0, 0, 0}},
                                            {Shape::line, {1, 8, 26, 27}},
                                            {Shape::triangle, {2, 9, 21, 23}},
                                            {Shape::quadrilateral, {3, 10, 36, 37}},
                                            {Shape::tetrahedron, {4, 11, 29, 30}},
                                            {Shape::pyramid, {7, 14, 118, 119}},
                                            {Shape::prism, {6, 13, 90, 91}},
                                            {Shape::hexahedron, {5, 12, 92, 93}}}};

struct Serendipity {
  int number;
  const char* name;
};
constexpr std::array<Serendipity, 18> k_serendipity{{{16, "8-node quadrilateral"},
                                                     {17, "20-node hexahedron"},
                                                     {18, "15-node prism"},
                                                     {19, "13-node pyramid"},
                                                     {20, "9-node triangle"},
                                                     {22, "12-node triangle"},
                                                     {32, "22-node tetrahedron"},
                                                     {39, "12-node quadrilateral"},
                                                     {40, "16-node quadrilateral of order 4"},
                                                     {99, "32-node hexahedron"},
                                                     {100, "44-node hexahedron"},
                                                     {111, "24-node prism"},
                                                     {112, "33-node prism"},
                                                     {125, "21-node pyramid"},
                                                     {126, "29-node pyramid"},
                                                     {137, "16-node tetrahedron"},
                                                     {24, "15-node triangle of order 5"},
                                                     {33, "28-node tetrahedron of order 5"}}};

/// Numbers of complete and incomplete elements of order 5 and above.
bool is_of_high_order(std::int64_t n) {
  return n == 25 || n == 28 || n == 31 || n == 38 || n == 41 || (n >= 42 && n <= 66) ||
         (n >= 71 && n <= 75) || (n >= 79 && n <= 83) || (n >= 94 && n <= 98) ||
         (n >= 101 && n <= 110) || (n >= 113 && n <= 117) || (n >= 120 && n <= 124) ||
         (n >= 127 && n <= 131);
}

}  // namespace

std::optional<ElementType> element_type(std::int64_t gmsh_number) {
  if (gmsh_number <= 0) return std::nullopt;
  for (const Numbers& row : k_numbers) {
    for (std::size_t i = 0; i < row.of_order.size(); ++i) {
      if (row.of_order[i] != gmsh_number) continue;
      const int order = static_cast<int>(i) + 1;
      return ElementType{row.shape, order, nodes_per_element(row.shape, order)};
    }
  }
  return std::nullopt;
}

Refusal explain_type(std::int64_t gmsh_number) {
  const auto* const row =
      std::find_if(k_serendipity.begin(), k_serendipity.end(),
                   [&](const Serendipity& s) { return s.number == gmsh_number; });
  if (row != k_serendipity.end()) {
    return {fmt::format("element type {} ({}, serendipity)", gmsh_number, row->name),
            "save complete elements: Mesh.SecondOrderIncomplete = 0 in Gmsh, or a linear mesh"};
  }
  if (is_of_high_order(gmsh_number)) {
    return {fmt::format("element type {} (order 5 or higher)", gmsh_number),
            "save the mesh with order 4 or lower, e.g. gmsh -order 1"};
  }
  if (gmsh_number >= 84 && gmsh_number <= 89) {
    return {fmt::format("element type {} (order 0)", gmsh_number), "save the mesh with order 1"};
  }
  if (gmsh_number == 34 || gmsh_number == 35) {
    return {fmt::format("element type {} (polygon or polyhedron)", gmsh_number),
            "save triangles, quadrilaterals, tetrahedra, pyramids, prisms and hexahedra only"};
  }
  return {fmt::format("element type {}, which is no mesh element", gmsh_number),
          "the file is damaged or incomplete: save it again"};
}

int gmsh_number(Shape shape, int order) {
  const Numbers& row = k_numbers[static_cast<std::size_t>(shape)];
  const bool known = order >= 1 && order <= k_max_order;
  const int number = known ? row.of_order[static_cast<std::size_t>(order - 1)] : 0;
  if (number == 0) throw std::invalid_argument("no Gmsh element of this shape and order");
  return number;
}

std::span<const int> gmsh_to_canonical(Shape shape, int order) {
  static constexpr std::array<int, 1> k_identity{0};
  if (shape == Shape::point) return k_identity;
  return file_to_canonical(NodeConvention::gmsh, shape, order);
}

}  // namespace camber::io::gmsh
