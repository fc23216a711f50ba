#pragma once
// The lattice of equispaced nodes of a shape, in Camber's one canonical order.
#include <camber/basis/shape.hpp>

#include <array>
#include <span>
#include <vector>

namespace camber {

/// Integer coordinates (i,j,k), 0..p; the reference point is (i,j,k)/p.
using LatticePoint = std::array<int, 3>;

/// Equispaced interpolation has lost all meaning in double precision long before this order; a
/// higher one is refused with std::invalid_argument, as is a negative one. Order 0 is the constant
/// (one node, at the centroid), for polynomials; elements start at 1.
inline constexpr int k_max_lattice_order = 31;

/// Number of nodes of the full Lagrange element of order p: line p+1, tri (p+1)(p+2)/2,
/// quad (p+1)^2, tet (p+1)(p+2)(p+3)/6, pyramid (p+1)(p+2)(2p+3)/6, prism (p+1)^2(p+2)/2, hex
/// (p+1)^3.
[[nodiscard]] int node_count(Shape shape, int p);

/// All nodes in canonical order: k slowest, then j, then i fastest (the rows shrink in triangles,
/// tets and pyramids: pyramid layer k has 0 <= i,j <= p-k). Cached; any thread.
[[nodiscard]] std::span<const LatticePoint> lattice(Shape shape, int p);
/// The same as reference coordinates.
[[nodiscard]] std::span<const Vec3> lattice_xi(Shape shape, int p);
/// Place of a lattice point in the canonical order.
[[nodiscard]] int lattice_index(Shape shape, int p, const LatticePoint& point);

/// Which nodes of an element lie where, and how its sub-entities' own lattices map onto it.
/// All tables hold canonical node numbers of (shape, p >= 1). A line is its own edge, a triangle or
/// quadrilateral its own face: there `interior` repeats edge_interior[0] or face_interior[0].
struct LatticeMap {
  std::vector<int> corner;             // [corner] -> node
  std::vector<std::vector<int>> edge;  // [edge][i]: all p+1 nodes walking a -> b
  std::vector<std::vector<int>> face;  // [face][n]: node of the face lattice point n (canonical
                                       // order of the face's shape, face axes: corner 0 -> 1 is
                                       // i, corner 0 -> last is j)
  std::vector<std::vector<int>> edge_interior;  // as edge, without the ends
  std::vector<std::vector<int>> face_interior;  // the subset of face strictly inside, in order
  std::vector<int> interior;                    // nodes strictly inside the shape, in order
};
[[nodiscard]] const LatticeMap& lattice_map(Shape shape, int p);

/// Canonical node numbers (of the 2D shape itself) strictly inside a tri or quad of order q; the
/// order in which a face owns its nodes.
[[nodiscard]] std::span<const int> interior_nodes(Shape shape, int q);

/// The permutation between two views of one face or edge: corner i of view B is corner
/// corner_of_a[i] of view A. result[n] = node of A (canonical) at the place of node n of B.
/// For line (2 corners), triangle (3) and quadrilateral (4, cyclic or reversed); anything else
/// throws std::invalid_argument.
[[nodiscard]] std::vector<int> reorient(Shape shape, int p, std::span<const int> corner_of_a);

}  // namespace camber
