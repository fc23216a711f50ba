#pragma once
// The paper's cost on one whole element, at points of the full polynomial map.
#include <camber/basis/shape.hpp>

#include <span>

namespace camber {

struct ElementCost {
  double minimum = 1.0;  // over the survey points
  double average = 1.0;
};

/// C = min(1, tau)/WCN, tau = det(A W^-1) = Jp/Jc, at the (p+1)^d Gauss points, A the Jacobian of
/// the curved element and W that of the straight one at the same xi; C = tau where tau <= 0.
/// [karman2022] eq. (2), (6). For triangles and quadrilaterals A and W are the 2 x 2 matrices in
/// the planes of the two faces and tau is the ratio of the normals, eq. (4). C = 0 where the
/// straight copy has no positive J.
/// @param nodes canonical order, order p in 1..16; the straight copy is made from its corners.
/// @return      costs in (-inf, 1] [-]
/// Tables are cached, any thread. Throws std::invalid_argument for another shape, order or node
/// count.
[[nodiscard]] ElementCost element_cost(Shape shape, int p, std::span<const Vec3> nodes);

}  // namespace camber
