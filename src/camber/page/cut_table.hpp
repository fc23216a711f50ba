#pragma once
// How a curved cell is cut: its polynomial at a lattice, and the lattice divided into tetrahedra.
#include <camber/basis/shape.hpp>

#include <array>
#include <vector>

namespace camber {

/// Tetrahedra that fill the reference volume shape and whose corners are the lattice nodes of order
/// `level` (canonical numbers), all with positive volume. The Kuhn division of the cubes of an
/// integer grid, of which the shapes are unions: hexahedron 0 <= a,b,c <= n; prism b <= a with
/// a = x+y, b = y; tetrahedron c <= b <= a with a = x+y+z, b = y+z, c = z; pyramid c <= a, c <= b
/// with a = x+z, b = y+z, c = z. hex 6 n^3, prism 3 n^3, pyramid 2 n^3, tet n^3 of them.
/// @throws std::invalid_argument for another shape or level < 1
[[nodiscard]] std::vector<std::array<int, 4>> lattice_tetrahedra(Shape shape, int level);

/// The triangles of those tetrahedra that lie on the shape's faces, outward by the right-hand rule.
[[nodiscard]] std::vector<std::array<int, 3>> skin(const std::vector<std::array<int, 4>>& tets);

/// Triangles that fill the reference triangle or quadrilateral, corners in the lattice of order
/// `level`, counter-clockwise: level^2 or 2 level^2 of them.
[[nodiscard]] std::vector<std::array<int, 3>> lattice_triangles(Shape shape, int level);

}  // namespace camber
