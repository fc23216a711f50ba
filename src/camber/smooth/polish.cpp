#include <camber/base/sorted_set.hpp>
#include <camber/metric/element_quality.hpp>
#include <camber/smooth/detail/cell_groups.hpp>
#include <camber/smooth/detail/group_solver.hpp>
#include <camber/smooth/lbfgs.hpp>
#include <camber/smooth/polish.hpp>
#include <camber/validity/batch.hpp>

#include <algorithm>
#include <numeric>
#include <utility>

namespace camber {
namespace {

/// Rounds of putting back the nodes of cells that came out worse.
constexpr int k_put_back_rounds = 60;
/// A cell below the kept costs may pay this much for its neighbours.
constexpr double k_price = 0.02;
/// Strain of a patch at most, summed in squares over its cells.
constexpr double k_longest_step = 0.5;

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// The cell costs more than it may: it is below the lowest cost of the patch, out of the kept
/// costs, or much lower than it was.
bool is_costlier(double before, double after, double lowest, double kept) {
  if (after < before && (after < lowest || after < before - k_price)) return true;
  return before >= kept && after < kept;
}

/// Stores x, putting the nodes of cells that came out worse back to `start` until none did; returns
/// the costs, or nothing if it did not end.
std::vector<double> store_what_is_better(CurvedMesh& curved, const detail::CellEnergy& energy,
                                         const VecX& start, VecX x,
                                         const std::vector<double>& before, double kept) {
  const double lowest = *std::min_element(before.begin(), before.end());
  const std::vector<Index>& cells = energy.cells();
  std::vector<std::vector<Index>> own(cells.size());
  std::vector<std::vector<std::size_t>> users(energy.unknowns().size());
  for (std::size_t i = 0; i < cells.size(); ++i) {
    own[i] = energy.unknowns_of(i);
    for (Index u : own[i]) users[at(u)].push_back(i);
  }
  std::vector<double> after(before);
  std::vector<std::uint8_t> is_back(users.size(), 0), is_bad(cells.size(), 0);
  std::vector<std::size_t> changed(cells.size());
  std::iota(changed.begin(), changed.end(), std::size_t{0});
  for (int round = 0; round < k_put_back_rounds; ++round) {
    energy.store(x, curved);
    std::vector<Index> asked;
    for (std::size_t i : changed) asked.push_back(cells[i]);
    const std::vector<double> costs = cell_costs(curved, asked);
    std::vector<std::size_t> open;  // may stay if they are certified
    for (std::size_t k = 0; k < changed.size(); ++k) {
      const std::size_t i = changed[k];
      after[i] = costs[k];
      is_bad[i] = is_costlier(before[i], after[i], lowest, kept);
      if (!is_bad[i]) open.push_back(i);
    }
    const std::vector<Verdict> verdicts =
        quick_verdicts(open.size(), [&](std::size_t k, Points& nodes) {
          const Index c = cells[open[k]];
          curved.gather(c, curved.cell_order(c), nodes);
          return ElementKind{curved.linear().cell_shape[at(c)], curved.cell_order(c)};
        });
    for (std::size_t k = 0; k < open.size(); ++k) {
      is_bad[open[k]] = verdicts[k] != Verdict::valid;
    }
    std::vector<std::size_t> next;
    for (std::size_t i : changed) {
      if (!is_bad[i]) continue;
      for (Index u : own[i]) {
        if (is_back[at(u)]) continue;
        is_back[at(u)] = 1;
        x.segment<3>(3 * u) = start.segment<3>(3 * u);
        next.insert(next.end(), users[at(u)].begin(), users[at(u)].end());
      }
    }
    if (next.empty()) return after;
    make_sorted_set(next);
    changed = std::move(next);
  }
  return {};
}

SmoothRow row_of(const CurvedMesh& curved, const std::vector<double>& costs, int number,
                 std::size_t active) {
  SmoothRow row;
  row.stage = "volume";
  row.iteration = number;
  row.active_nodes = active;
  const auto worst = std::min_element(costs.begin(), costs.end());
  const Index c = static_cast<Index>(worst - costs.begin());
  const LinearMesh& mesh = curved.linear();
  for (double cost : costs) row.negative_elements += cost < 0.0;
  row.worst_cost = *worst;
  for (Index v : mesh.cell(c)) row.place += mesh.vertices[at(v)];
  row.place /= static_cast<double>(mesh.cell(c).size());
  row.element = mesh.cell_tags[at(c)];
  row.shape = mesh.cell_shape[at(c)];
  row.order = curved.cell_order(c);
  return row;
}

bool has_free_node(const CurvedMesh& curved, Index c, const std::vector<std::uint8_t>& is_free) {
  bool is_any = false;
  detail::for_each_node_range(curved, c, [&](std::size_t first, std::size_t count) {
    const auto begin = is_free.begin() + static_cast<std::ptrdiff_t>(first);
    const auto end = begin + static_cast<std::ptrdiff_t>(count);
    is_any = is_any || std::find(begin, end, 1) != end;
  });
  return is_any;
}

/// One patch; true if it was improved.
bool polish_patch(CurvedMesh& curved, const std::vector<Index>& core,
                  const std::vector<std::uint8_t>& is_free, std::vector<double>& costs,
                  const PolishOptions& options, PolishResult& result) {
  const std::vector<Index> cells = detail::curved_neighbours(curved, core);
  detail::CellEnergy energy(curved, cells, detail::nodes_of(curved, core, is_free));
  if (energy.size() == 0) return false;
  const detail::GroupSolver hessian = detail::GroupSolver::across_thin_cells(energy);
  const VecX start = energy.positions(curved);
  VecX x = start;
  int evaluations = 0;
  LbfgsOptions lbfgs;
  lbfgs.max_iterations = options.max_evaluations;
  lbfgs.gradient_tolerance = options.gradient_tolerance;
  lbfgs.longest_step = k_longest_step;
  minimise_lbfgs(
      [&](const VecX& y, VecX& gradient) {
        ++evaluations;
        return energy.evaluate(detail::EnergyKind::quality, y, 0.0, gradient);
      },
      x, hessian, lbfgs, [&](const VecX&) { return evaluations >= options.max_evaluations; });
  result.evaluations += static_cast<std::size_t>(evaluations) * cells.size();
  VecX unused;
  result.energy_at_start += energy.evaluate(detail::EnergyKind::quality, start, 0.0, unused);
  result.energy_at_end += energy.evaluate(detail::EnergyKind::quality, x, 0.0, unused);

  std::vector<double> before;
  for (Index c : cells) before.push_back(costs[at(c)]);
  const std::vector<double> after =
      store_what_is_better(curved, energy, start, x, before, options.kept_cost);
  if (after.empty() || !(mean(after) > mean(before))) {
    energy.store(start, curved);
    return false;
  }
  for (std::size_t i = 0; i < cells.size(); ++i) costs[at(cells[i])] = after[i];
  return true;
}

}  // namespace

std::vector<double> cell_costs(const CurvedMesh& curved, const std::vector<Index>& cells) {
  return lowest_costs(cells.size(), [&](std::size_t i, Points& nodes) {
    const int p = curved.cell_order(cells[i]);
    if (p > 1) curved.gather(cells[i], p, nodes);
    return std::pair(curved.linear().cell_shape[at(cells[i])], p);
  });
}

std::vector<double> cell_costs(const CurvedMesh& curved) {
  std::vector<Index> cells(curved.linear().cell_count());
  std::iota(cells.begin(), cells.end(), 0);
  return cell_costs(curved, cells);
}

PolishResult polish(CurvedMesh& curved, const std::vector<std::uint8_t>& is_free,
                    std::vector<double>& costs, const PolishOptions& options,
                    const SmoothListener& listener) {
  PolishResult result;
  std::vector<Index> grown;
  for (Index c = 0; at(c) < costs.size(); ++c) {
    if (costs[at(c)] < options.cost_target && has_free_node(curved, c, is_free)) {
      grown.push_back(c);
    }
  }
  result.seeds = grown.size();
  const auto report = [&](std::size_t active) {
    result.rows.push_back(row_of(curved, costs, static_cast<int>(result.patches), active));
    if (listener) listener(result.rows.back());
  };
  for (int ring = 1; ring < options.rings; ++ring) {
    grown = with_neighbours(curved.topology(), grown);
  }
  for (const std::vector<Index>& core : detail::connected_groups(curved.topology(), grown)) {
    if (core.size() > options.max_cells) continue;
    report(core.size());
    ++result.patches;
    result.improved += polish_patch(curved, core, is_free, costs, options, result);
  }
  if (result.patches > 0) report(0);
  return result;
}

}  // namespace camber
