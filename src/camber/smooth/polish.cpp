#include <camber/base/parallel.hpp>
#include <camber/base/sorted_set.hpp>
#include <camber/metric/element_quality.hpp>
#include <camber/smooth/detail/cell_groups.hpp>
#include <camber/smooth/detail/group_solver.hpp>
#include <camber/smooth/lbfgs.hpp>
#include <camber/smooth/polish.hpp>
#include <camber/validity/batch.hpp>

#include <algorithm>
#include <numeric>
#include <span>
#include <unordered_map>
#include <utility>

namespace camber {
namespace {

/// Rounds of putting back the nodes of cells that came out worse.
constexpr int k_put_back_rounds = 60;
/// A cell below the kept costs may pay this much for its neighbours.
constexpr double k_price = 0.02;
/// Patches between two looks of the listener.
constexpr std::size_t k_patches_at_once = 64;
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

/// A patch and what came of it.
struct PatchWork {
  std::vector<Index> core, cells;  // cells whose nodes may move; all that depend on them
  std::size_t turn = 0;            // patches of one turn have no cell in common
  std::vector<double> costs;       // of `cells` afterwards; empty if it was put back
  std::size_t evaluations = 0;     // of one cell
  double energy_at_start = 0.0, energy_at_end = 0.0;
};

/// Optimises one patch. Writes nodes of its core and reads those of its cells, no others: patches
/// without a common cell may run at the same time.
void polish_patch(CurvedMesh& curved, const std::vector<std::uint8_t>& is_free,
                  const std::vector<double>& costs, const PolishOptions& options, PatchWork& work) {
  const std::vector<Index>& cells = work.cells;
  detail::CellEnergy energy(curved, cells, detail::nodes_of(curved, work.core, is_free));
  if (energy.size() == 0) return;
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
        const double value = energy.evaluate(detail::EnergyKind::quality, y, 0.0, gradient);
        if (++evaluations == 1) work.energy_at_start = work.energy_at_end = value;
        work.energy_at_end = std::min(work.energy_at_end, value);
        return value;
      },
      x, hessian, lbfgs, [&](const VecX&) { return evaluations >= options.max_evaluations; });
  work.evaluations = static_cast<std::size_t>(evaluations) * cells.size();

  std::vector<double> before;
  for (Index c : cells) before.push_back(costs[at(c)]);
  std::vector<double> after =
      store_what_is_better(curved, energy, start, x, before, options.kept_cost);
  if (after.empty() || !(mean(after) > mean(before))) {
    energy.store(start, curved);
    return;
  }
  work.costs = std::move(after);
}

/// Gives every patch the first turn after those of all patches before it that share a cell with it:
/// the outcome is that of one after the other. @return number of turns
std::size_t take_turns(std::span<PatchWork> patches) {
  std::unordered_map<Index, std::size_t> next;  // by cell
  std::size_t turns = 0;
  for (PatchWork& patch : patches) {
    for (Index c : patch.cells) {
      const auto held = next.find(c);
      if (held != next.end()) patch.turn = std::max(patch.turn, held->second);
    }
    for (Index c : patch.cells) next[c] = patch.turn + 1;
    turns = std::max(turns, patch.turn + 1);
  }
  return turns;
}

void store_costs(const PatchWork& patch, std::vector<double>& costs) {
  for (std::size_t i = 0; i < patch.costs.size(); ++i) costs[at(patch.cells[i])] = patch.costs[i];
}

/// Optimises patches, those of one turn at the same time; `costs` is what was before all of them.
void polish_patches(CurvedMesh& curved, const std::vector<std::uint8_t>& is_free,
                    std::vector<double> costs, const PolishOptions& options,
                    std::span<PatchWork> patches) {
  const std::size_t turns = take_turns(patches);
  for (std::size_t turn = 0; turn < turns; ++turn) {
    std::vector<PatchWork*> now;
    for (PatchWork& patch : patches) {
      if (patch.turn == turn) now.push_back(&patch);
    }
    // The longest first, so that no thread is left alone with one at the end.
    std::stable_sort(now.begin(), now.end(), [](const PatchWork* a, const PatchWork* b) {
      return a->cells.size() > b->cells.size();
    });
    parallel_for(now.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        polish_patch(curved, is_free, costs, options, *now[i]);
      }
    });
    for (const PatchWork* patch : now) store_costs(*patch, costs);
  }
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
  std::vector<PatchWork> patches;
  for (std::vector<Index>& core : detail::connected_groups(curved.topology(), grown)) {
    if (core.size() > options.max_cells) continue;
    std::vector<Index> cells = detail::curved_neighbours(curved, core);
    patches.push_back({std::move(core), std::move(cells), 0, {}, 0});
  }
  for (std::size_t first = 0; first < patches.size(); first += k_patches_at_once) {
    const std::span<PatchWork> some =
        std::span(patches).subspan(first, std::min(k_patches_at_once, patches.size() - first));
    polish_patches(curved, is_free, costs, options, some);
    // Told as if they had run one after the other.
    for (const PatchWork& patch : some) {
      report(patch.core.size());
      ++result.patches;
      result.improved += !patch.costs.empty();
      result.evaluations += patch.evaluations;
      result.energy_at_start += patch.energy_at_start;
      result.energy_at_end += patch.energy_at_end;
      store_costs(patch, costs);
    }
  }
  if (result.patches > 0) report(0);
  return result;
}

}  // namespace camber
