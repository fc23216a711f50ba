#pragma once
// UGRID (AFLR3): how the numbers are stored, and which corner stands where.
#include <camber/basis/shape.hpp>

#include <array>
#include <string>

namespace camber::io::ugrid {

/// By the name: NAME.ugrid text; NAME.b8.ugrid and NAME.lb8.ugrid streams of 4-byte integers and
/// 8-byte reals, high or low byte first; NAME.r8.ugrid and NAME.lr8.ugrid the same in two Fortran
/// records.
struct Layout {
  bool is_binary = false, is_big_endian = false, has_records = false;
};
/// @throws FileError for single precision (b4, lb4, r4, lr4) and 8-byte integers (b8l, lb8l)
[[nodiscard]] Layout layout_of(const std::string& path);

/// Corner i of the file is corner corner_of_file[i] of the shape. The apex of a pyramid is its
/// third node: (u0, u3, u4, u1, u2) are the corners 0 to 4.
struct Kind {
  Shape shape;
  std::array<int, 8> corner_of_file;
};
inline constexpr std::array k_faces{Kind{Shape::triangle, {0, 1, 2}},
                                    Kind{Shape::quadrilateral, {0, 1, 2, 3}}};
inline constexpr std::array k_cells{
    Kind{Shape::tetrahedron, {0, 1, 2, 3}}, Kind{Shape::pyramid, {0, 3, 4, 1, 2}},
    Kind{Shape::prism, {0, 1, 2, 3, 4, 5}}, Kind{Shape::hexahedron, {0, 1, 2, 3, 4, 5, 6, 7}}};

/// The file with the names of the patches: NAME.mapbc for NAME[.lb8 ..].ugrid.
[[nodiscard]] std::string mapbc_path(const std::string& path);

}  // namespace camber::io::ugrid
