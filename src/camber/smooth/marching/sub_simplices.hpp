#pragma once
// The triangles and tetrahedra of an element's node lattice, on which the cost is computed.
#include <camber/basis/lattice.hpp>

#include <array>
#include <span>

namespace camber {

/// Canonical lattice nodes of one sub-simplex; [3] is -1 in a triangle. Counter-clockwise, or of
/// positive volume, on the reference shape.
using SubSimplex = std::array<int, 4>;

/// Sub-triangles of a triangle or quadrilateral, sub-tetrahedra of a volume shape, order p in 1..6.
/// The lattice is cut into small elements: triangles and tets into p^2 and p^3 of their own kind
/// (the octahedra between the corners of a tet's lattice by their diagonal along (1, -1, 1));
/// quadrilaterals, prisms and hexahedra into p^2 and p^3 of theirs, pyramids into upright and
/// turned pyramids and the tets between. Of a small element that is no simplex every corner with
/// its edge neighbours counts as one (two of a pyramid's apex would be arbitrary: its four base
/// corners contain the apex already). Source: [karman2022] 2.2.5, "Surface" and "Volume Weighted
/// Condition Number". Cached; any thread.
/// @throws std::invalid_argument for a point or line, or another order
[[nodiscard]] std::span<const SubSimplex> sub_simplices(Shape shape, int p);

}  // namespace camber
