#pragma once
// Bernstein form: bounds and subdivision of polynomials on line, triangle and tetrahedron; tensor
// shapes are built from these one direction at a time.
#include <camber/basis/lattice.hpp>

#include <array>
#include <span>

namespace camber {

/// Coefficients c = M v from the values v at the lattice (shape, n), both in canonical order;
/// shape is line, triangle or tetrahedron (others throw std::invalid_argument), n >= 0 the degree.
/// The entries are exact to double rounding. Cached; any thread.
[[nodiscard]] const MatX& bernstein_from_lattice(Shape shape, int n);

/// B_a(xi) for all lattice points a of (shape, n), canonical order.
void bernstein_values(Shape shape, int n, const Vec3& xi, std::span<double> B);

/// Subdivision matrices: coefficients on child c = S[c] * coefficients. Children: line 2 halves,
/// triangle 4 (three corners, then the middle), tetrahedron 8 (four corners, then the four of the
/// inner octahedron). bernstein_children gives each child's corners in the parent's reference
/// coordinates (unused ones are zero), all with the parent's orientation. Cached; any thread.
[[nodiscard]] std::span<const MatX> bernstein_subdivision(Shape shape, int n);
[[nodiscard]] std::span<const std::array<Vec3, 4>> bernstein_children(Shape shape);

}  // namespace camber
