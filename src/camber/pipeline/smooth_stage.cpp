#include <camber/base/parallel.hpp>
#include <camber/base/sorted_set.hpp>
#include <camber/elevate/order_rules.hpp>
#include <camber/elevate/rescue.hpp>
#include <camber/mesh/raise_orders.hpp>
#include <camber/pipeline/marching_boundary.hpp>
#include <camber/pipeline/smooth_stage.hpp>
#include <camber/smooth/patch.hpp>
#include <camber/smooth/polish.hpp>

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

namespace camber {
namespace {

/// Gives the edges, faces and insides of cells the shapes of another state of the mesh.
class Restorer {
 public:
  Restorer(CurvedMesh& curved, const CurvedMesh& before) : curved_(curved), before_(before) {}

  /// @return the cells that touch anything that changed, sorted
  std::vector<Index> restore(const std::vector<Index>& cells) {
    const Topology& topology = curved_.topology();
    std::vector<Index> edges, faces, touched;
    for (Index c : cells) {
      for (Index e : topology.edges_of_cell(c)) edges.push_back(e);
      for (Index f : topology.faces_of_cell(c)) faces.push_back(f);
      if (copy(before_.cell_nodes(c), curved_.cell_nodes(c))) touched.push_back(c);
    }
    make_sorted_set(edges);
    make_sorted_set(faces);
    for (Index e : edges) {
      if (!copy(before_.edge_nodes(e), curved_.edge_nodes(e))) continue;
      for (Index c : topology.cells_of_edge(e)) touched.push_back(c);
    }
    for (Index f : faces) {
      if (!copy(before_.face_nodes(f), curved_.face_nodes(f))) continue;
      for (Index c : topology.face2cell[at(f)]) {
        if (c != k_none) touched.push_back(c);
      }
    }
    make_sorted_set(touched);
    return touched;
  }

 private:
  static bool copy(std::span<const Vec3> from, std::span<Vec3> to) {
    if (std::equal(from.begin(), from.end(), to.begin(), to.end())) return false;
    std::copy(from.begin(), from.end(), to.begin());
    return true;
  }

  CurvedMesh& curved_;
  const CurvedMesh& before_;
};

/// Cells of the columns that stand on the wall itself, sorted.
std::vector<Index> first_cells(const Topology& topology, const Wall& wall, const Columns& columns) {
  std::vector<Index> first;
  for (std::size_t slot = 0; slot < wall.face_count(); ++slot) {
    for (Index c : topology.face2cell[at(wall.faces[slot])]) {
      if (c != k_none && columns.cell_face_slot[at(c)] == static_cast<Index>(slot)) {
        first.push_back(c);
      }
    }
  }
  make_sorted_set(first);
  return first;
}

/// Cells under wall faces that smoothing moved and that miss their CAD by more than was asked, and
/// by more than before.
class DeviationGuard {
 public:
  DeviationGuard(const CurvedMesh& before, const GeometryModel& geometry, const FieldSource& field,
                 const OrderOptions& orders)
      : before_(before),
        geometry_(geometry),
        field_(field),
        orders_(orders),
        shortest_(shortest_edges(before.linear(), before.topology())) {}

  [[nodiscard]] std::vector<Index> missing(const CurvedMesh& curved,
                                           const std::vector<Index>& cells) const {
    std::vector<std::pair<Index, Index>> faces;  // slot, cell
    for (Index c : cells) {
      for (Index f : curved.topology().faces_of_cell(c)) {
        const Index slot = field_.wall.face_slot[at(f)];
        if (slot != k_none && lattice(curved, f) != lattice(before_, f))
          faces.emplace_back(slot, c);
      }
    }
    std::vector<std::uint8_t> is_missing(faces.size(), 0);
    parallel_for_with(
        faces.size(), k_grain, [&] { return geometry_.projector(); },
        [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
          for (std::size_t i = begin; i < end; ++i) {
            is_missing[i] = is_worse(*projector, curved, faces[i].first);
          }
        });
    std::vector<Index> found;
    for (std::size_t i = 0; i < faces.size(); ++i) {
      if (is_missing[i]) found.push_back(faces[i].second);
    }
    return found;
  }

 private:
  static constexpr std::size_t k_grain = 32;

  static Points lattice(const CurvedMesh& curved, Index f) {
    const int q = curved.face_order(f);
    Points nodes(static_cast<std::size_t>(node_count(curved.topology().face_shape[at(f)], q)));
    curved.face_lattice(f, q, nodes);
    return nodes;
  }
  [[nodiscard]] double distance(Projector& projector, const CurvedMesh& curved, Index slot) const {
    const Index f = field_.wall.faces[at(slot)];
    return measure_face(projector, field_.association.patch_of(f)->group,
                        curved.topology().face_shape[at(f)], curved.face_order(f),
                        lattice(curved, f),
                        &field_.wall.corners[at(field_.wall.face_corners[at(slot)][0])])
        .maximum;
  }
  [[nodiscard]] bool is_worse(Projector& projector, const CurvedMesh& curved, Index slot) const {
    const double now = distance(projector, curved, slot);
    return now > orders_.deviation * deviation_length(curved.linear(), curved.topology(),
                                                      field_.wall.faces[at(slot)], shortest_,
                                                      orders_) &&
           now > distance(projector, before_, slot);
  }

  const CurvedMesh& before_;
  const GeometryModel& geometry_;
  const FieldSource& field_;
  const OrderOptions& orders_;
  std::vector<double> shortest_;
};

/// Puts back cells that lost their certificate, are worse than any was before, or whose wall faces
/// smoothing moved out of the deviation; all if the mean cost fell. Ends: a pass restores something
/// that was not restored before, or tests nothing again.
/// @return cells that were put back
std::size_t keep_the_better(CurvedMesh& curved, const CurvedMesh& before,
                            const DeviationGuard& guard) {
  const std::vector<double> cost_before = cell_costs(before);
  const double lowest = *std::min_element(cost_before.begin(), cost_before.end());
  const auto mean = [](const std::vector<double>& costs) {
    return ordered_sum(costs.size(), [&](std::size_t i) { return costs[i]; }) /
           static_cast<double>(costs.size());
  };
  const auto find_bad = [&](const std::vector<Index>& cells) {
    std::vector<Index> bad = uncertified_cells(curved, cells);
    const std::vector<Index> missing = guard.missing(curved, cells);
    bad.insert(bad.end(), missing.begin(), missing.end());
    const std::vector<double> costs = cell_costs(curved, cells);
    for (std::size_t i = 0; i < cells.size(); ++i) {
      if (costs[i] < lowest) bad.push_back(cells[i]);
    }
    make_sorted_set(bad);
    return bad;
  };
  std::vector<Index> all(cost_before.size());
  std::iota(all.begin(), all.end(), 0);
  Restorer restorer(curved, before);
  std::vector<Index> restored;
  for (std::vector<Index> bad = find_bad(all); !bad.empty();) {
    restored.insert(restored.end(), bad.begin(), bad.end());
    bad = find_bad(restorer.restore(bad));
  }
  if (mean(cell_costs(curved)) < mean(cost_before)) {
    restorer.restore(all);
    restored = all;
  }
  make_sorted_set(restored);
  return restored.size();
}

SmoothOutcome march(CurvedMesh& curved, const GeometryModel& geometry, const FieldSource& field,
                    const CurveOptions& options, const Progress& progress) {
  MarchingOptions marching;
  marching.threshold = options.quality;
  marching.volume_deviation = options.orders.volume_deviation;
  marching.max_order = options.orders.max_order;
  const CurvedMesh start = curved;
  const MarchingResult result = smooth_by_marching(
      curved, marching_boundary(curved.linear(), curved.topology(), geometry, field), marching,
      [&](const SmoothRow& row) {
        progress("smooth " + row.stage, IterationState{row.iteration, row.active_nodes,
                                                       row.negative_elements, row.worst_cost});
      });
  const CurvedMesh before = raise_orders(start, curved.orders().cell);
  const DeviationGuard guard(before, geometry, field, options.orders);
  return {result.rows, keep_the_better(curved, before, guard)};
}

SmoothOutcome polish_patches(CurvedMesh& curved, const FieldSource& field,
                             const CurveOptions& options, const Progress& progress) {
  PolishOptions polishing;
  polishing.cost_target = options.polish_below;
  std::vector<double> costs = cell_costs(curved);
  const std::vector<Index> frozen = first_cells(curved.topology(), field.wall, field.columns);
  const PolishResult result =
      polish(curved, free_nodes(curved, frozen), costs, polishing, [&](const SmoothRow& row) {
        progress("smooth", IterationState{row.iteration, row.active_nodes, row.negative_elements,
                                          row.worst_cost});
      });
  return {result.rows, 0};
}

}  // namespace

SmoothOutcome smooth_stage(CurvedMesh& curved, const GeometryModel& geometry,
                           const FieldSource& field, const CurveOptions& options,
                           const Progress& progress) {
  switch (options.smoothing) {
    case Smoothing::marching:
      return march(curved, geometry, field, options, progress);
    case Smoothing::automatic:
      return polish_patches(curved, field, options, progress);
    case Smoothing::none:
      break;
  }
  return {};
}

}  // namespace camber
