#include <camber/base/sorted_set.hpp>
#include <camber/elevate/rescue.hpp>
#include <camber/mesh/raise_orders.hpp>
#include <camber/pipeline/marching_boundary.hpp>
#include <camber/pipeline/smooth_stage.hpp>

#include <algorithm>

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

/// Puts back what lost its certificate. Ends: a pass restores something that was not restored
/// before, or nothing is tested again.
/// @return cells that were put back
std::size_t keep_certified(CurvedMesh& curved, const CurvedMesh& before, std::vector<Index> bad) {
  Restorer restorer(curved, before);
  std::vector<Index> all;
  while (!bad.empty()) {
    all.insert(all.end(), bad.begin(), bad.end());
    bad = uncertified_cells(curved, restorer.restore(bad));
  }
  make_sorted_set(all);
  return all.size();
}

SmoothOutcome march(CurvedMesh& curved, const Association& association,
                    const GeometryModel& geometry, const CurveOptions& options,
                    const Progress& progress) {
  MarchingOptions marching;
  marching.threshold = options.quality;
  marching.volume_deviation = options.orders.volume_deviation;
  marching.max_order = options.orders.max_order;
  const CurvedMesh start = curved;
  const MarchingResult result = smooth_by_marching(
      curved, marching_boundary(curved.linear(), curved.topology(), association, geometry),
      marching, [&](const SmoothRow& row) {
        progress("smooth " + row.stage, IterationState{row.iteration, row.active_nodes,
                                                       row.negative_elements, row.worst_cost});
      });
  const CurvedMesh before = raise_orders(start, curved.orders().cell);
  SmoothOutcome outcome{result.rows, 0};
  outcome.put_back = keep_certified(curved, before, result.uncertified);
  return outcome;
}

}  // namespace

SmoothOutcome smooth_stage(CurvedMesh& curved, const Association& association,
                           const GeometryModel& geometry, const CurveOptions& options,
                           const Progress& progress) {
  switch (options.smoothing) {
    case Smoothing::marching:
      return march(curved, association, geometry, options, progress);
    case Smoothing::automatic:
    case Smoothing::none:
      break;
  }
  return {};
}

}  // namespace camber
