#pragma once
// Lagrange bases on the equispaced lattice, values and gradients, every shape, any order.
#include <camber/basis/lattice.hpp>

#include <span>
#include <vector>

namespace camber {

/// N_n(xi) for all nodes n in canonical order; N has node_count(shape,p) entries.
/// Spaces: P_p (line, tri, tet), Q_p (quad, hex), P_p x P_p (prism), and for the pyramid the
/// rational nodal space span{ x^i y^j (1-z)^(max(i,j)-i-j) z^k : k <= p - max(i,j) } (Bergot,
/// Cohen, Durufle 2010, doi 10.1007/s10915-009-9334-9), which is that of Gmsh; its traces are P_p
/// and Q_p.
void lagrange_values(Shape shape, int p, const Vec3& xi, std::span<double> N);
/// Gradients with respect to xi. At the pyramid's apex the limit along its axis is returned.
void lagrange_gradients(Shape shape, int p, const Vec3& xi, std::span<Vec3> dN);

/// Basis functions at a set of points.
struct Tabulation {
  MatX values;                   // points x nodes
  std::array<MatX, 3> gradient;  // d/dx, d/dy, d/dz: points x nodes (unused directions are empty)
};
[[nodiscard]] Tabulation tabulate(Shape shape, int p, std::span<const Vec3> xi);

/// E such that nodes_q = E * nodes_p describes the same polynomial, q >= p: (node_count q) x
/// (node_count p). For q < p it interpolates (samples) instead. Cached; any thread.
[[nodiscard]] const MatX& elevation_matrix(Shape shape, int p, int q);

/// x(xi) = sum_n N_n(xi) nodes[n].
[[nodiscard]] Vec3 evaluate(Shape shape, int p, std::span<const Vec3> nodes, const Vec3& xi);
/// dx/dxi: column c is the derivative along reference direction c (unused columns are zero).
[[nodiscard]] Mat3 jacobian(Shape shape, int p, std::span<const Vec3> nodes, const Vec3& xi);

/// Nodes of the straight-sided element of order p from its corners (in corner order): the paper's
/// computational element (straight edges; quadrilaterals stay bilinear).
[[nodiscard]] Points straight_nodes(Shape shape, int p, std::span<const Vec3> corner_points);

}  // namespace camber
