#include <camber/base/assert.hpp>
#include <camber/mesh/raise_orders.hpp>
#include <camber/smooth/marching/marching.hpp>
#include <camber/validity/batch.hpp>

#include <algorithm>
#include <optional>
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

/// How good a state is: fewer negative elements first; then, while there are some, the mean cost;
/// then the biased average, eq. (5), of the elements' costs.
struct Merit {
  std::size_t negative_elements = 0;
  double value = 0.0;

  explicit Merit(const MarchState& s)
      : negative_elements(s.negative_elements),
        value(s.negative_elements > 0 ? s.mean_cost
                                      : biased_average(s.worst_cost, s.worst_cost, s.mean_cost)) {}
  [[nodiscard]] bool betters(const Merit& other, double gain) const {
    if (negative_elements != other.negative_elements) {
      return negative_elements < other.negative_elements;
    }
    return value > other.value + gain;
  }
};

/// The best state of a stretch. One without negative elements must have its worst cost at `floor`
/// or above.
class BestState {
 public:
  BestState(const MarchState& first, const Points& x, double floor, double least_gain)
      : least_gain_(least_gain),
        floor_(floor),
        state_(first),
        best_(first),
        landmark_(first),
        x_(x) {}

  /// @return true if it betters the last state that was a clear gain by one more
  bool offer(const MarchState& state, const Points& x) {
    const Merit merit(state);
    const bool is_allowed = state.negative_elements > 0 || state.worst_cost >= floor_;
    if (!is_allowed || !merit.betters(best_, 0.0)) return false;
    best_ = merit;
    state_ = state;
    x_ = x;
    if (!merit.betters(landmark_, least_gain_)) return false;
    landmark_ = merit;
    return true;
  }
  [[nodiscard]] const MarchState& state() const { return state_; }
  [[nodiscard]] const Points& x() const { return x_; }

 private:
  double least_gain_, floor_;
  MarchState state_;
  Merit best_, landmark_;
  Points x_;
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
    for (const MarchingSurface& surface : boundary_.surfaces) {
      const CurvedMesh before = curved_;
      for (int level = 0; level <= k_max_level; ++level) {
        surface_pass(surface, level);
        if (!has_folded_face(curved_, surface.faces)) break;
      }
      if (boundary_.carry) boundary_.carry(before, curved_);
      check_interfaces();
    }
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

  void surface_pass(const MarchingSurface& surface, int level) {
    MarchProblem problem = surface_problem(curved_, surface.fixed, surface.faces);
    if (problem.x.empty()) return;
    Stretch stretch{"surface", level, 0, options_.max_sweeps, {}, 0};
    const MarchState end = march<2>(problem, stretch, boundary_.onto);
    report(problem, end, stretch);
    store(problem, curved_);
  }

  /// Marches in stretches; between two of them cells may be raised, and the problem is another one.
  void volume_pass(int level) {
    Stretch stretch{"volume", level, 0, 0, {}, 0};
    int interval = options_.deviation_interval;
    for (;;) {
      MarchProblem problem = volume_problem(curved_, volume_fixed_);
      if (problem.x.empty()) return;
      stretch.end = std::min(options_.max_sweeps, stretch.sweep + interval);
      const MarchState end = march<3>(problem, stretch, {});
      store(problem, curved_);
      check_interfaces();
      const bool has_time = stretch.sweep < options_.max_sweeps;
      if (has_time && raise(level)) {
        stretch.floor.reset();
        stretch.idle = 0;
        interval = options_.deviation_interval;
      } else if (stretch.sweep < stretch.end || !has_time) {
        report(problem, end, stretch);
        return;
      } else {
        interval *= 2;  // what is at rest need not be asked so often
      }
    }
  }

  /// A run of sweeps without a change of orders.
  struct Stretch {
    const char* stage;
    int level;
    int sweep;  // of the pass, done
    int end;
    // Since the pass began or cells were raised:
    std::optional<double> floor;  // worst cost at first, 0 if it was negative
    int idle = 0;                 // sweeps since the best state was bettered
  };

  /// Sweeps until `end`, or until nothing is active or gets better (then stretch.sweep < end). The
  /// problem is left at its best state, which is returned.
  template <int d>
  MarchState march(MarchProblem& problem, Stretch& stretch, const OntoBoundary& onto) {
    Marcher<d> marcher(problem, marcher_options(stretch.level));
    MarchState state = marcher.state();
    if (!stretch.floor) stretch.floor = state.negative_elements > 0 ? 0.0 : state.worst_cost;
    BestState best(state, problem.x, *stretch.floor, options_.least_gain);
    for (; stretch.sweep < stretch.end; ++stretch.sweep) {
      if (state.active_nodes == 0 || stretch.idle >= options_.patience) break;
      report(problem, state, stretch);
      marcher.sweep(onto);
      state = marcher.state();
      stretch.idle = best.offer(state, problem.x) ? 0 : stretch.idle + 1;
    }
    problem.x = best.x();
    return best.state();
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

  void report(const MarchProblem& problem, const MarchState& state, const Stretch& stretch) {
    SmoothRow row;
    row.stage = stretch.stage;
    row.pass = stretch.level + 1;
    row.iteration = stretch.sweep;
    row.active_nodes = state.active_nodes;
    row.negative_elements = state.negative_elements;
    row.elevated_elements = result_.raised_cells;
    row.worst_cost = state.worst_cost;
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
