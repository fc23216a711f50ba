#pragma once
// The paper's perturbation smoothing: nodes march along the sensitivities of their cost.
#include <camber/metric/biased_average.hpp>
#include <camber/smooth/marching/element_costs.hpp>
#include <camber/smooth/marching/march_problem.hpp>

#include <functional>
#include <limits>
#include <span>
#include <vector>

namespace camber {

/// Costs around one node, gathered element by element.
struct NodalCost {
  double lowest = std::numeric_limits<double>::infinity();
  Vec3 slope_at_lowest = Vec3::Zero();
  double sum = 0.0;
  Vec3 slope_sum = Vec3::Zero();
  int count = 0;

  /// A sub-simplex with its cost and its derivative by the node.
  void add(double cost, const Vec3& slope);
  /// Those of another element. Of equal lowest costs the first counts.
  void add(const NodalCost& other);

  /// Biased average of the costs, eq. (5), C = F.
  [[nodiscard]] double cost() const { return biased_average(lowest, lowest, sum / count); }
  /// Biased average of the derivatives, eq. (5), F_min the derivative of the lowest cost.
  [[nodiscard]] Vec3 slope() const {
    return biased_average<double, Vec3>(lowest, slope_at_lowest, slope_sum / count);
  }
};

/// Length of a node's step: relaxation x smallest inscribed radius x min(1, |1 - cost|).
/// Source: [karman2022] "Marching Step Size".
[[nodiscard]] double marching_step(double relaxation, double inscribed_radius, double cost);

/// Where a node wants to go. `to` may be changed.
struct NodeMove {
  StoredNode node;
  Vec3 from, to;
};
/// Puts moved boundary nodes back on their curve or surface; a node without a foot goes back to
/// `from`.
using OntoBoundary = std::function<void(std::span<NodeMove> moves)>;

struct MarcherOptions {
  int level = 0;             // of the normalised Jacobian
  double relaxation = 0.05;  // the paper's
  double threshold = 0.95;   // nodes of a higher cost stay
};

/// How all elements of a problem stand.
struct MarchState {
  std::size_t active_nodes = 0, negative_elements = 0;
  double worst_cost = 1.0, mean_cost = 1.0;  // of the elements' lowest costs
  std::size_t worst_element = 0;
};

/// The sub-simplices around a node are those of all elements that have a lattice node which depends
/// on it (march_problem.hpp): at an interface of orders a node of the lower order counts what it
/// does to the elements of both sides, sum_n weight_n dC/dx_n over the corners n of a sub-simplex,
/// the transpose of the gather. d: dimension of the elements.
/// Only elements with a node that moved are computed again. Parallel inside: elements write their
/// own part, nodes gather it in order of elements; the same bits for any number of threads.
template <int d>
class Marcher {
 public:
  Marcher(MarchProblem& problem, const MarcherOptions& options);

  [[nodiscard]] MarchState state() const;
  /// Moves every active node by one step, and computes what depends on it.
  void sweep(const OntoBoundary& onto = {});

  [[nodiscard]] double node_cost(std::size_t i) const { return cost_[i]; }
  [[nodiscard]] double inscribed_radius(std::size_t i) const { return radius_[i]; }
  /// Lowest cost of a sub-simplex of the element.
  [[nodiscard]] double element_cost(std::size_t i) const { return lowest_[i]; }

 private:
  void connect();
  void compute(const std::vector<Index>& elements);
  void compute(const MarchElement& element, std::span<NodalCost> part, double& lowest) const;
  void gather_at_nodes(const std::vector<Index>& nodes);
  [[nodiscard]] std::span<NodalCost> part_of(std::size_t element) {
    return {parts_.data() + part_offset_[element],
            part_offset_[element + 1] - part_offset_[element]};
  }

  MarchProblem& problem_;
  MarcherOptions options_;
  // Parts of element i, one for each of its nodes: parts_[part_offset_[i] ...].
  std::vector<std::size_t> part_offset_;
  std::vector<NodalCost> parts_;
  // Parts of node i, in order of elements: node_parts_[node_offset_[i] ...], and whose they are.
  std::vector<std::size_t> node_offset_, node_parts_;
  std::vector<Index> node_elements_;
  std::vector<double> cost_, radius_, lowest_;
  Points slope_;
};

}  // namespace camber
