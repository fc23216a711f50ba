#include <camber/base/parallel.hpp>
#include <camber/base/sorted_set.hpp>
#include <camber/smooth/marching/marcher.hpp>
#include <camber/smooth/marching/sub_simplices.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace camber {
namespace {

constexpr std::size_t k_elements_per_task = 8, k_nodes_per_task = 512;

std::vector<Index> counted(std::size_t n) {
  std::vector<Index> items(n);
  std::iota(items.begin(), items.end(), 0);
  return items;
}

/// Derivatives of one sub-simplex by the element's nodes, summed over its corners.
class CornerSums {
 public:
  explicit CornerSums(std::size_t nodes) : sum_(nodes), is_touched_(nodes, 0) {}

  void add(int place, const Vec3& slope) {
    if (!is_touched_[at(place)]) {
      is_touched_[at(place)] = 1;
      touched_.push_back(place);
      sum_[at(place)].setZero();
    }
    sum_[at(place)] += slope;
  }
  template <class Take>
  void take_all(const Take& take) {
    for (int place : touched_) {
      take(at(place), sum_[at(place)]);
      is_touched_[at(place)] = 0;
    }
    touched_.clear();
  }

 private:
  Points sum_;
  std::vector<std::uint8_t> is_touched_;
  std::vector<int> touched_;
};

}  // namespace

void NodalCost::add(double cost, const Vec3& slope) {
  if (cost < lowest) {
    lowest = cost;
    slope_at_lowest = slope;
  }
  sum += cost;
  slope_sum += slope;
  ++count;
}

void NodalCost::add(const NodalCost& other) {
  if (other.lowest < lowest) {
    lowest = other.lowest;
    slope_at_lowest = other.slope_at_lowest;
  }
  sum += other.sum;
  slope_sum += other.slope_sum;
  count += other.count;
}

double marching_step(double relaxation, double inscribed_radius, double cost) {
  return relaxation * inscribed_radius * std::min(1.0, std::abs(1.0 - cost));
}

template <int d>
Marcher<d>::Marcher(MarchProblem& problem, const MarcherOptions& options)
    : problem_(problem), options_(options) {
  connect();
  compute(counted(problem_.elements.size()));
  gather_at_nodes(counted(problem_.x.size()));
}

template <int d>
void Marcher<d>::connect() {
  const std::size_t elements = problem_.elements.size(), nodes = problem_.x.size();
  part_offset_.assign(elements + 1, 0);
  node_offset_.assign(nodes + 1, 0);
  for (std::size_t i = 0; i < elements; ++i) {
    part_offset_[i + 1] = part_offset_[i] + problem_.elements[i].nodes.size();
    for (Index node : problem_.elements[i].nodes) ++node_offset_[at(node) + 1];
  }
  std::partial_sum(node_offset_.begin(), node_offset_.end(), node_offset_.begin());
  parts_.resize(part_offset_.back());
  node_parts_.resize(parts_.size());
  node_elements_.resize(parts_.size());
  std::vector<std::size_t> next(node_offset_.begin(), node_offset_.end() - 1);
  for (std::size_t i = 0; i < elements; ++i) {
    for (std::size_t k = 0; k < problem_.elements[i].nodes.size(); ++k) {
      const std::size_t place = next[at(problem_.elements[i].nodes[k])]++;
      node_parts_[place] = part_offset_[i] + k;
      node_elements_[place] = static_cast<Index>(i);
    }
  }
  lowest_.assign(elements, 1.0);
  cost_.assign(nodes, 1.0);
  slope_.assign(nodes, Vec3::Zero());
  radius_.assign(nodes, std::numeric_limits<double>::infinity());
  std::vector<double> radii;
  for (const MarchElement& element : problem_.elements) {
    inscribed_radii<d>(element.shape, element.order, element.X, radii);
    const std::span<const SubSimplex> simplices = sub_simplices(element.shape, element.order);
    for (std::size_t s = 0; s < simplices.size(); ++s) {
      for (std::size_t corner = 0; corner <= at(d); ++corner) {
        const std::size_t n = at(simplices[s][corner]);
        for (int k = element.row[n]; k < element.row[n + 1]; ++k) {
          double& smallest = radius_[at(element.nodes[at(element.weights[at(k)].first)])];
          smallest = std::min(smallest, radii[s]);
        }
      }
    }
  }
}

template <int d>
void Marcher<d>::compute(const MarchElement& element, std::span<NodalCost> part,
                         double& lowest) const {
  Points x;
  std::vector<SubCost<d>> costs;
  element.gather(problem_.x, x);
  element_costs<d>(element.shape, element.order, x, element.X, options_.level, costs);
  std::fill(part.begin(), part.end(), NodalCost{});
  lowest = std::numeric_limits<double>::infinity();
  CornerSums sums(element.nodes.size());
  const std::span<const SubSimplex> simplices = sub_simplices(element.shape, element.order);
  for (std::size_t s = 0; s < simplices.size(); ++s) {
    for (std::size_t corner = 0; corner <= at(d); ++corner) {
      const std::size_t n = at(simplices[s][corner]);
      for (int k = element.row[n]; k < element.row[n + 1]; ++k) {
        const auto& [place, weight] = element.weights[at(k)];
        sums.add(place, weight * costs[s].slope[corner]);
      }
    }
    sums.take_all(
        [&](std::size_t place, const Vec3& slope) { part[place].add(costs[s].cost, slope); });
    lowest = std::min(lowest, costs[s].cost);
  }
}

template <int d>
void Marcher<d>::compute(const std::vector<Index>& elements) {
  parallel_for(elements.size(), k_elements_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t e = at(elements[i]);
      compute(problem_.elements[e], part_of(e), lowest_[e]);
    }
  });
}

template <int d>
void Marcher<d>::gather_at_nodes(const std::vector<Index>& nodes) {
  parallel_for(nodes.size(), k_nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      const std::size_t n = at(nodes[i]);
      NodalCost all;
      for (std::size_t k = node_offset_[n]; k < node_offset_[n + 1]; ++k) {
        all.add(parts_[node_parts_[k]]);
      }
      if (all.count == 0) continue;
      cost_[n] = all.cost();
      slope_[n] = all.slope();
    }
  });
}

template <int d>
MarchState Marcher<d>::state() const {
  MarchState state;
  for (double cost : cost_) state.active_nodes += cost < options_.threshold;
  for (std::size_t i = 0; i < lowest_.size(); ++i) {
    state.negative_elements += lowest_[i] <= 0.0;
    if (lowest_[i] < state.worst_cost) {
      state.worst_cost = lowest_[i];
      state.worst_element = i;
    }
  }
  if (!lowest_.empty()) {
    state.mean_cost = ordered_sum(lowest_.size(), [&](std::size_t i) { return lowest_[i]; }) /
                      static_cast<double>(lowest_.size());
  }
  return state;
}

template <int d>
void Marcher<d>::sweep(const OntoBoundary& onto) {
  std::vector<NodeMove> moves;
  std::vector<Index> moved;
  for (std::size_t n = 0; n < cost_.size(); ++n) {
    const double length = slope_[n].norm();
    if (!(cost_[n] < options_.threshold) || !(length > 0.0) || !std::isfinite(length)) continue;
    const double step = marching_step(options_.relaxation, radius_[n], cost_[n]);
    moves.push_back({problem_.stored[n], problem_.x[n], problem_.x[n] + step / length * slope_[n]});
    moved.push_back(static_cast<Index>(n));
  }
  if (onto) onto(moves);
  std::vector<Index> elements, nodes;
  for (std::size_t i = 0; i < moves.size(); ++i) {
    const std::size_t n = at(moved[i]);
    problem_.x[n] = moves[i].to;
    elements.insert(elements.end(),
                    node_elements_.begin() + static_cast<std::ptrdiff_t>(node_offset_[n]),
                    node_elements_.begin() + static_cast<std::ptrdiff_t>(node_offset_[n + 1]));
  }
  make_sorted_set(elements);
  for (Index e : elements) {
    const std::vector<Index>& own = problem_.elements[at(e)].nodes;
    nodes.insert(nodes.end(), own.begin(), own.end());
  }
  make_sorted_set(nodes);
  compute(elements);
  gather_at_nodes(nodes);
}

template class Marcher<2>;
template class Marcher<3>;

}  // namespace camber
