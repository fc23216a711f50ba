#include <camber/basis/lagrange.hpp>
#include <camber/basis/quadrature.hpp>
#include <camber/smooth/detail/energy_plan.hpp>

#include <array>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

namespace camber::detail {
namespace {

/// Where the pyramid's map is sampled instead of at its apex.
const Vec3 k_below_apex(5e-4, 5e-4, 1.0 - 1e-3);

/// [sample][direction][node].
std::vector<double> stacked_gradients(Shape shape, int order, const std::vector<Vec3>& points) {
  const auto nodes = static_cast<std::size_t>(node_count(shape, order));
  std::vector<Vec3> dN(nodes);
  std::vector<double> values;
  values.reserve(3 * nodes * points.size());
  for (const Vec3& xi : points) {
    lagrange_gradients(shape, order, xi, dN);
    for (int d = 0; d < 3; ++d) {
      for (const Vec3& g : dN) values.push_back(g[d]);
    }
  }
  return values;
}

}  // namespace

EnergyPlan::EnergyPlan(Shape shape, int order)
    : shape_(shape), order_(order), nodes_(node_count(shape, order)) {
  const Quadrature& rule = gauss(shape, 2 * order + 1);
  points_ = rule.points;
  for (double w : rule.weights) weight_.push_back(w / reference_measure(shape));
  for (const Vec3& xi : lattice_xi(shape, order)) {
    const bool is_apex = shape == Shape::pyramid && xi.z() > k_below_apex.z();
    points_.push_back(is_apex ? k_below_apex : xi);
    weight_.push_back(k_lattice_weight / nodes_);
  }
  gradient_ = stacked_gradients(shape, order, points_);
  straight_gradient_ = stacked_gradients(shape, 1, points_);
  const std::vector<int>& corner = lattice_map(shape, order).corner;
  const std::vector<int>& linear_corner = lattice_map(shape, 1).corner;
  corner_node_.resize(corner.size());
  for (std::size_t c = 0; c < corner.size(); ++c) {
    corner_node_[static_cast<std::size_t>(linear_corner[c])] = corner[c];
  }
}

EnergyView EnergyPlan::view() const {
  return {nodes_,
          static_cast<int>(corner_node_.size()),
          static_cast<int>(points_.size()),
          gradient_.data(),
          straight_gradient_.data(),
          weight_.data()};
}

const EnergyPlan& energy_plan(Shape shape, int order) {
  struct Slot {
    std::once_flag once;
    std::unique_ptr<const EnergyPlan> plan;
  };
  static std::array<std::array<Slot, k_max_tested_order + 1>, k_shape_count> slots;
  if (dimension(shape) != 3 || order < 1 || order > k_max_tested_order) {
    throw std::invalid_argument("no energy of a " + std::string(name(shape)) + " of order " +
                                std::to_string(order));
  }
  Slot& slot = slots[static_cast<std::size_t>(shape)][static_cast<std::size_t>(order)];
  std::call_once(slot.once, [&] { slot.plan = std::make_unique<const EnergyPlan>(shape, order); });
  return *slot.plan;
}

}  // namespace camber::detail
