#pragma once
// Reference shapes: corners, edges and faces.
#include <camber/base/vec.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <string_view>

namespace camber {

/// Highest polynomial order (degree) of geometry that is tested; the code is written for any.
inline constexpr int k_max_tested_order = 6;
/// Highest order the pipeline asks for: Q4, as in the paper.
inline constexpr int k_max_order = 4;

enum class Shape : std::uint8_t {
  point,
  line,
  triangle,
  quadrilateral,
  tetrahedron,
  pyramid,
  prism,
  hexahedron
};
inline constexpr int k_shape_count = 8;

/// Reference domains (all coordinates in [0,1]; unused ones are 0):
///   line 0<=x<=1 · triangle x,y>=0, x+y<=1 · quadrilateral [0,1]^2
///   tetrahedron x,y,z>=0, x+y+z<=1 · prism triangle(x,y) x [0,1] · hexahedron [0,1]^3
///   pyramid 0<=x,y<=1-z, 0<=z<=1: base [0,1]^2 at z=0, apex (0,0,1), over corner 0
/// Corner numbers are those of CGNS = Gmsh = VTK:
///   quad (0,0)(1,0)(1,1)(0,1); prism triangle z=0 then z=1; hexahedron quad z=0 then z=1;
///   pyramid quad, then apex.
[[nodiscard]] int dimension(Shape shape);
[[nodiscard]] int corner_count(Shape shape);
[[nodiscard]] std::string_view name(
    Shape shape);  // "point","line","tri","quad","tet","pyramid","prism","hex"
[[nodiscard]] std::span<const Vec3> corners(Shape shape);

/// Local corner pairs, in CGNS order (formats table), walked a -> b.
[[nodiscard]] std::span<const std::array<int, 2>> edges(Shape shape);

struct LocalFace {
  Shape shape;                 // triangle or quadrilateral
  std::array<int, 4> corners;  // [3] is -1 for a triangle; outward normal by the right-hand rule
};
/// Faces of a volume shape; for tri and quad the one face that is the shape itself; else empty.
[[nodiscard]] std::span<const LocalFace> faces(Shape shape);

/// Volume (area, length) of the reference domain.
[[nodiscard]] double reference_measure(Shape shape);
[[nodiscard]] Vec3 reference_centroid(Shape shape);

}  // namespace camber
