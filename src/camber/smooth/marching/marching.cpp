#include <camber/base/assert.hpp>
#include <camber/mesh/raise_orders.hpp>
#include <camber/smooth/marching/marching.hpp>
#include <camber/validity/batch.hpp>

#include <algorithm>
#include <utility>

namespace camber {
namespace {

/// Gap between two sides of a face, over the size of the mesh, that is round-off of elevation.
[[maybe_unused]] constexpr double k_gap = 1e-12;

[[maybe_unused]] bool is_watertight(const CurvedMesh& curved) {
  return largest_gap(curved) <= k_gap * curved.linear().size();
}

/// Cells of order >= 2 that are not certified.
std::vector<Index> uncertified(const CurvedMesh& curved) {
  std::vector<Index> cells, bad;
  for (Index c = 0; at(c) < curved.linear().cell_count(); ++c) {
    if (curved.cell_order(c) > 1) cells.push_back(c);
  }
  const std::vector<Verdict> verdicts =
      quick_verdicts(cells.size(), [&](std::size_t i, Points& nodes) {
        const int p = curved.cell_order(cells[i]);
        curved.gather(cells[i], p, nodes);
        return ElementKind{curved.linear().cell_shape[at(cells[i])], p};
      });
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (verdicts[i] != Verdict::valid) bad.push_back(cells[i]);
  }
  return bad;
}

/// Faces on which the normal of the curved one turns against the straight one somewhere.
bool has_folded_face(const CurvedMesh& curved, const std::vector<Index>& faces) {
  Points nodes;
  return std::any_of(faces.begin(), faces.end(), [&](Index f) {
    const int p = curved.face_order(f);
    if (p < 2) return false;
    const Shape shape = curved.topology().face_shape[at(f)];
    nodes.resize(static_cast<std::size_t>(node_count(shape, p)));
    curved.face_lattice(f, p, nodes);
    return certify_face(shape, p, nodes).verdict != Verdict::valid;
  });
}

/// The best state of a pass, and when it was last bettered by more than a little.
class BestState {
 public:
  BestState(const MarchState& first, const Points& x, double least_gain)
      : least_gain_(least_gain), floor_(first.worst_cost), state_(first), landmark_(first), x_(x) {}

  void offer(const MarchState& state, const Points& x, int sweep) {
    if (!is_better(state)) return;
    state_ = state;
    x_ = x;
    if (state.negative_elements < landmark_.negative_elements ||
        state.mean_cost > landmark_.mean_cost + least_gain_ ||
        state.worst_cost > landmark_.worst_cost + least_gain_) {
      landmark_ = state;
      last_gain_ = sweep;
    }
  }
  [[nodiscard]] int last_gain() const { return last_gain_; }
  [[nodiscard]] const Points& x() const { return x_; }

 private:
  [[nodiscard]] bool is_better(const MarchState& state) const {
    if (state.negative_elements != state_.negative_elements) {
      return state.negative_elements < state_.negative_elements;
    }
    if (state.negative_elements > 0) return state.worst_cost > state_.worst_cost;
    return state.worst_cost >= std::max(0.0, floor_) && state.mean_cost > state_.mean_cost;
  }

  double least_gain_, floor_;
  MarchState state_, landmark_;
  Points x_;
  int last_gain_ = 0;
};

class Smoother {
 public:
  Smoother(CurvedMesh& curved, const MarchingBoundary& boundary, const MarchingOptions& options,
           const SmoothListener& listener)
      : curved_(curved),
        boundary_(boundary),
        options_(options),
        listener_(listener),
        volume_fixed_(boundary_entities(curved.topology())) {}

  MarchingResult run() {
    check_interfaces();
    for (int level = 0; level <= k_max_level; ++level) {
      surface_pass(level);
      if (!has_folded_face(curved_, boundary_.faces)) break;
    }
    check_interfaces();
    for (int level = 0; level <= k_max_level; ++level) {
      volume_pass(level);
      result_.uncertified = uncertified(curved_);
      if (result_.uncertified.empty()) break;
    }
    return std::move(result_);
  }

 private:
  void check_interfaces() const {
    CAMBER_ASSERT(is_watertight(curved_), "an entity has one shape for all its cells");
  }

  [[nodiscard]] MarcherOptions marcher_options(int level) const {
    return {level, options_.relaxation, options_.threshold};
  }

  void surface_pass(int level) {
    MarchProblem problem = surface_problem(curved_, boundary_.fixed, boundary_.faces);
    if (problem.x.empty()) return;
    int sweep = 0;
    march<2>(problem, level, "surface", level + 1, sweep, options_.max_sweeps, boundary_.onto);
    store(problem, curved_);
  }

  /// Marches in stretches; between two of them cells may be raised, and the problem is another one.
  void volume_pass(int level) {
    int sweep = 0;
    for (bool is_over = false; !is_over;) {
      MarchProblem problem = volume_problem(curved_, volume_fixed_);
      if (problem.x.empty()) return;
      const int end = std::min(options_.max_sweeps, sweep + options_.deviation_interval);
      is_over = march<3>(problem, level, "volume", level + 1, sweep, end, {});
      store(problem, curved_);
      check_interfaces();
      const bool is_raised = raise(level);
      is_over = sweep >= options_.max_sweeps || (is_over && !is_raised);
    }
  }

  /// Sweeps until `end`, or until nothing is active or gets better. The problem is left at its best
  /// state. @return true if it ended before `end`
  template <int d>
  bool march(MarchProblem& problem, int level, const char* stage, int pass, int& sweep, int end,
             const OntoBoundary& onto) {
    Marcher<d> marcher(problem, marcher_options(level));
    MarchState state = marcher.state();
    BestState best(state, problem.x, options_.least_gain);
    bool is_over = false;
    for (int start = sweep;; ++sweep) {
      report(problem, state, stage, pass, sweep);
      is_over = state.active_nodes == 0 || sweep - start - best.last_gain() >= options_.patience;
      if (is_over || sweep >= end) break;
      marcher.sweep(onto);
      state = marcher.state();
      best.offer(state, problem.x, sweep - start + 1);
    }
    problem.x = best.x();
    return is_over;
  }

  bool raise(int level) {
    ElevationOptions elevation{options_.max_order, options_.volume_deviation,
                               options_.release_sweeps, marcher_options(level)};
    const std::vector<Index> cells = cells_to_raise(curved_, volume_fixed_, elevation);
    if (cells.empty()) return false;
    std::vector<std::uint8_t> orders = raised_orders(curved_, cells);
    for (std::size_t c = 0; c < orders.size(); ++c) {
      result_.raised_cells += orders[c] > curved_.orders().cell[c];
    }
    curved_ = raise_orders(curved_, std::move(orders));
    check_interfaces();
    return true;
  }

  void report(const MarchProblem& problem, const MarchState& state, const char* stage, int pass,
              int sweep) {
    SmoothRow row{stage,
                  pass,
                  sweep,
                  state.active_nodes,
                  state.negative_elements,
                  result_.raised_cells,
                  state.worst_cost,
                  Vec3::Zero(),
                  0,
                  Shape::point,
                  0};
    if (!problem.elements.empty()) {
      const MarchElement& worst = problem.elements[state.worst_element];
      for (int corner : lattice_map(worst.shape, worst.order).corner) {
        row.place += worst.X[static_cast<std::size_t>(corner)] / corner_count(worst.shape);
      }
      const Index cell =
          problem.dimension == 3 ? worst.entity : curved_.topology().face2cell[at(worst.entity)][0];
      row.element = curved_.linear().cell_tags[at(cell)];
      row.shape = worst.shape;
      row.order = worst.order;
    }
    result_.rows.push_back(row);
    if (listener_) listener_(row);
  }

  CurvedMesh& curved_;
  const MarchingBoundary& boundary_;
  const MarchingOptions& options_;
  const SmoothListener& listener_;
  FixedEntities volume_fixed_;
  MarchingResult result_;
};

}  // namespace

MarchingResult smooth_by_marching(CurvedMesh& curved, const MarchingBoundary& boundary,
                                  const MarchingOptions& options, const SmoothListener& listener) {
  return Smoother(curved, boundary, options, listener).run();
}

}  // namespace camber
