#pragma once
// The paper's cost on one whole element, at points of the full polynomial map.
#include <camber/basis/shape.hpp>

#include <functional>
#include <span>
#include <utility>
#include <vector>

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

/// The same bits for several volume elements of one kind, as many at once as the processor has
/// lanes.
/// @param nodes  those of all elements, one element after the other
/// @param costs  one per element, overwritten
void element_costs(Shape shape, int p, std::span<const Vec3> nodes, std::span<ElementCost> costs);

/// Fills `nodes` with the canonical nodes of element i and gives its shape and order; of an element
/// of order 1 the nodes are not needed. Called once per element, from several threads at once.
using GatherElement = std::function<std::pair<Shape, int>(std::size_t i, Points& nodes)>;

/// Lowest cost of volume elements 0..n-1, 1 where the order is: a linear cell is its own straight
/// copy. Same bits for any number of threads.
[[nodiscard]] std::vector<double> lowest_costs(std::size_t n, const GatherElement& gather);

}  // namespace camber
