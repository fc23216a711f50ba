#include <camber/base/sorted_set.hpp>
#include <camber/smooth/detail/cell_groups.hpp>
#include <camber/smooth/detail/group_solver.hpp>
#include <camber/smooth/lbfgs.hpp>
#include <camber/smooth/patch.hpp>
#include <camber/validity/element_validity.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace camber {
namespace {

/// A repaired cell should keep at least this share of its straight Jacobian at every sample before
/// the group is tested.
constexpr double k_wanted_ratio = 0.05;

/// Regularisation of barely inverted groups, and its factor from round to round.
constexpr double k_least_delta = 0.03;
constexpr double k_delta_shrink = 0.6;

/// Longest step of the optimiser: strain of the whole group, summed in squares.
constexpr double k_longest_step = 0.5;

/// Rounds without progress before a group is given up.
constexpr int k_patience = 3;

/// Cells of the patch that are not certified, with where.
std::vector<std::pair<std::size_t, Vec3>> failing_cells(const CurvedMesh& curved,
                                                        const std::vector<Index>& cells) {
  std::vector<std::pair<std::size_t, Vec3>> failing;
  Points nodes;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Shape shape = curved.linear().cell_shape[at(cells[i])];
    const int p = curved.cell_order(cells[i]);
    curved.gather(cells[i], p, nodes);
    if (quick_verdict(shape, p, nodes) == Verdict::valid) continue;
    failing.emplace_back(i, certify(shape, p, nodes).worst_xi);
  }
  return failing;
}

/// One evaluation of the cells, in evaluations of a cell of order 2: higher orders have more
/// samples and more nodes, and what cannot be mended must not cost minutes.
std::size_t work_of(const CurvedMesh& curved, std::span<const Index> cells) {
  std::size_t work = 0;
  for (Index c : cells) work += std::size_t{1} << std::max(curved.cell_order(c) - 2, 0);
  return work;
}

/// Optimises from the nodes as they are; true if all cells came out certified, else the nodes are
/// put back.
/// @param allowance  evaluations of one cell that may still be spent; reduced by those made
bool repair(CurvedMesh& curved, detail::CellEnergy& patch, const detail::GroupSolver& scale,
            const UntangleOptions& options, std::size_t& allowance) {
  const VecX start = patch.positions(curved);
  const std::size_t work = work_of(curved, patch.cells());
  VecX x = start, unused;
  const auto least_ratio = [&](const VecX& y) {
    double smallest = 0.0;
    patch.evaluate(detail::EnergyKind::shape, y, 1.0, unused, &smallest);
    return smallest;
  };
  LbfgsOptions lbfgs;
  lbfgs.max_iterations = options.iterations_per_round;
  lbfgs.longest_step = k_longest_step;
  double least = least_ratio(x), best = least;
  int since_best = 0;
  for (int round = 0; round < options.max_rounds && since_best < k_patience && allowance > 0;
       ++round) {
    // Wide at first, so that inverted samples see a slope; narrower each round, to push them
    // through zero.
    const double delta = least > 0.0 ? 0.0
                                     : std::max(k_least_delta, 0.3 * std::abs(least)) *
                                           std::pow(k_delta_shrink, round);
    const auto energy = [&](const VecX& y, VecX& g) {
      allowance -= std::min(allowance, work);
      return patch.evaluate(detail::EnergyKind::shape, y, delta, g);
    };
    minimise_lbfgs(energy, x, scale, lbfgs, [&](const VecX&) { return allowance == 0; });
    least = least_ratio(x);
    since_best = least > best + 0.05 * std::abs(best) ? 0 : since_best + 1;
    best = std::max(best, least);
    if (least <= 0.0 || (least < k_wanted_ratio && round == 0)) continue;
    patch.store(x, curved);
    const auto failing = failing_cells(curved, patch.cells());
    if (failing.empty()) return true;
    for (const auto& [i, xi] : failing) patch.add_sample(i, xi);
  }
  patch.store(start, curved);
  return false;
}

/// Takes the displacement off the free nodes of some cells.
void straighten(CurvedMesh& curved, const CurvedMesh& straight, const std::vector<Index>& cells,
                const std::vector<std::uint8_t>& is_free) {
  for (Index c : cells) {
    detail::for_each_node_range(curved, c, [&](std::size_t first, std::size_t count) {
      for (std::size_t i = first; i < first + count; ++i) {
        if (is_free[i]) curved.high_order_nodes()[i] = straight.high_order_nodes()[i];
      }
    });
  }
}

/// Share of the displacement at which each load step ends.
constexpr std::array<double, 4> k_load_steps{0.25, 0.5, 0.75, 1.0};

/// Brings all nodes of a patch from near the straight copy to their places in steps, fixed ones
/// exactly, and optimises the free ones after each; true if the last step is certified, else all
/// nodes are as they were.
/// @param steps  those made are added
bool repair_in_steps(CurvedMesh& curved, const CurvedMesh& straight,
                     const std::vector<Index>& around, const std::vector<std::uint8_t>& is_own,
                     const UntangleOptions& options, std::size_t& allowance, std::size_t& steps) {
  const std::span<Vec3> x = curved.high_order_nodes();
  std::vector<std::size_t> loaded;
  for (Index c : around) {
    detail::for_each_node_range(curved, c, [&](std::size_t first, std::size_t count) {
      for (std::size_t i = first; i < first + count; ++i) loaded.push_back(i);
    });
  }
  make_sorted_set(loaded);
  Points target;
  for (std::size_t i : loaded) target.push_back(x[i]);
  bool is_certified = false;
  double before = 0.0;
  for (double load : k_load_steps) {
    for (std::size_t k = 0; k < loaded.size(); ++k) {
      const Vec3& X = straight.high_order_nodes()[loaded[k]];
      Vec3& place = x[loaded[k]];
      if (before == 0.0) {
        place = X + load * (target[k] - X);
      } else if (is_own[loaded[k]]) {
        place += (load - before) * (target[k] - X);
      } else {
        place = load == 1.0 ? target[k] : Vec3(X + load * (target[k] - X));
      }
    }
    before = load;
    detail::CellEnergy patch(curved, around, is_own);
    is_certified =
        repair(curved, patch, detail::GroupSolver::across_thin_cells(patch), options, allowance);
    ++steps;
    if (!is_certified) break;
  }
  if (is_certified) return true;
  for (std::size_t k = 0; k < loaded.size(); ++k) x[loaded[k]] = target[k];
  return false;
}

}  // namespace

FixedEntities boundary_entities(const Topology& topology) {
  FixedEntities fixed;
  fixed.edge.assign(topology.edge_count(), 0);
  fixed.face.assign(topology.face_count(), 0);
  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    if (!topology.is_boundary(f) && topology.face2patch_face[at(f)] == k_none) continue;
    fixed.face[at(f)] = 1;
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      fixed.edge[at(topology.face2edge[at(f)][static_cast<std::size_t>(i)])] = 1;
    }
  }
  return fixed;
}

std::vector<std::uint8_t> free_nodes(const CurvedMesh& curved,
                                     const std::vector<Index>& frozen_cells) {
  const FixedEntities fixed = boundary_entities(curved.topology());
  std::vector<std::uint8_t> is_free(curved.high_order_node_count(), 1);
  const auto fix = [&](std::size_t first, std::size_t count) {
    std::fill_n(is_free.begin() + static_cast<std::ptrdiff_t>(first), count, std::uint8_t{0});
  };
  for (Index e = 0; at(e) < fixed.edge.size(); ++e) {
    if (fixed.edge[at(e)]) fix(at(curved.first_edge_node(e)), curved.edge_nodes(e).size());
  }
  for (Index f = 0; at(f) < fixed.face.size(); ++f) {
    if (fixed.face[at(f)]) fix(at(curved.first_face_node(f)), curved.face_nodes(f).size());
  }
  for (Index c : frozen_cells) detail::for_each_node_range(curved, c, fix);
  return is_free;
}

UntangleResult untangle(CurvedMesh& curved, const std::vector<Index>& uncertified,
                        const UntangleOptions& options) {
  UntangleResult result;
  const std::vector<std::uint8_t> is_free = free_nodes(curved);
  std::optional<CurvedMesh> straight;
  for (const std::vector<Index>& group : detail::connected_groups(curved.topology(), uncertified)) {
    ++result.patches;
    bool is_repaired = false;
    std::vector<Index> core = group;
    const std::size_t granted =
        std::min(options.evaluations_per_group,
                 options.evaluations - std::min(options.evaluations, result.evaluations));
    std::size_t allowance = granted;
    std::vector<Index> around;
    std::vector<std::uint8_t> is_own;
    for (int ring = 0; ring < options.rings && !is_repaired && allowance > 0; ++ring) {
      core = with_neighbours(curved.topology(), core);
      std::vector<Index> touched = detail::curved_neighbours(curved, core);
      if (touched.size() > options.max_cells) break;
      around = std::move(touched);
      is_own = detail::nodes_of(curved, core, is_free);
      detail::CellEnergy patch(curved, around, is_own);
      if (patch.size() == 0) break;
      const detail::GroupSolver scale = detail::GroupSolver::across_thin_cells(patch);
      is_repaired = repair(curved, patch, scale, options, allowance);
      if (is_repaired) break;
      // A second start: the bad cells themselves straight. Flat cells tolerate little else.
      const VecX carried = patch.positions(curved);
      if (!straight) straight.emplace(curved.linear(), curved.topology(), curved.orders());
      straighten(curved, *straight, group, is_free);
      is_repaired = repair(curved, patch, scale, options, allowance);
      if (!is_repaired) patch.store(carried, curved);
    }
    if (!is_repaired && straight && !around.empty() && allowance > 0) {
      std::size_t steps = 0;
      is_repaired = repair_in_steps(curved, *straight, around, is_own, options, allowance, steps);
      if (is_repaired) result.load_steps += steps;
    }
    result.evaluations += granted - allowance;
    if (is_repaired) {
      ++result.repaired;
      result.mended.push_back(group.front());
    } else {
      result.still_bad.insert(result.still_bad.end(), group.begin(), group.end());
    }
  }
  std::sort(result.still_bad.begin(), result.still_bad.end());
  return result;
}

}  // namespace camber
