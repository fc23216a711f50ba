#pragma once
// Tables of an energy kernel for one shape and order, and elements evaluated through it.
#include <camber/basis/shape.hpp>
#include <camber/smooth/detail/energy_view.hpp>

#include <vector>

namespace camber::detail {

/// Samples of the shape energy on one element: the Gauss points exact to degree 2p + 1 with weights
/// of sum 1, and the lattice of the order with weights of sum k_lattice_weight, so that corners and
/// edges are watched. The pyramid's apex, where its map is singular, is sampled just below.
class EnergyPlan {
 public:
  EnergyPlan(Shape shape, int order);

  [[nodiscard]] EnergyView view() const;
  [[nodiscard]] Shape shape() const { return shape_; }
  [[nodiscard]] int order() const { return order_; }
  [[nodiscard]] int nodes() const { return nodes_; }
  /// Lattice node of order 1 -> node of the element.
  [[nodiscard]] const std::vector<int>& corner_nodes() const { return corner_node_; }
  [[nodiscard]] const std::vector<Vec3>& points() const { return points_; }
  [[nodiscard]] const std::vector<double>& weights() const { return weight_; }

  static constexpr double k_lattice_weight = 0.1;

 private:
  Shape shape_;
  int order_, nodes_;
  std::vector<int> corner_node_;
  std::vector<Vec3> points_;
  std::vector<double> gradient_, straight_gradient_, weight_;
};

/// Cached, any thread; shapes of dimension 3, orders 1..k_max_tested_order.
[[nodiscard]] const EnergyPlan& energy_plan(Shape shape, int order);

}  // namespace camber::detail
