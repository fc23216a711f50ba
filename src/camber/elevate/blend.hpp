#pragma once
// Transfinite interpolation: what the edges of a face do to its inside.
#include <camber/basis/shape.hpp>

#include <array>
#include <span>

namespace camber {

/// Linear (barycentric) or bilinear weights of the corners at xi.
void corner_weights(Shape shape, const Vec3& xi, std::array<double, 4>& weight);

/// Fills the interior lattice nodes of a displacement whose corner values are zero from its edge
/// values:
///   triangle       u = sum_edges (1 - l_c) u_e(l_b / (l_a + l_b)),   c the corner opposite edge e
///   = (a,b) quadrilateral  Coons: (1-y) u_0(x) + y u_2(x) + x u_1(y) + (1-x) u_3(y)
/// with u_e the edge's polynomial of order q. Source: Gordon and Hall 1973, doi 10.1007/BF01436298.
/// @param u  all lattice nodes, canonical order, order q; interior entries are overwritten
void blend_face_interior(Shape shape, int q, std::span<Vec3> u);

}  // namespace camber
