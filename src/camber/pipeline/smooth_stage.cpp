#include <camber/pipeline/smooth_stage.hpp>
#include <camber/smooth/patch.hpp>
#include <camber/smooth/polish.hpp>

namespace camber {

std::vector<SmoothRow> smooth_stage(std::unique_ptr<CurvedMesh>& curved,
                                    const Association& association, const GeometryModel& geometry,
                                    const std::vector<Index>& first_cells,
                                    const CurveOptions& options, const Progress& progress) {
  static_cast<void>(association);
  static_cast<void>(geometry);
  if (options.smoothing != Smoothing::automatic) return {};
  PolishOptions polishing;
  polishing.cost_target = options.polish_below;
  std::vector<double> costs = cell_costs(*curved);
  return polish(*curved, free_nodes(*curved, first_cells), costs, polishing,
                [&](const SmoothRow& row) {
                  progress("smooth", IterationState{row.iteration, row.active_nodes,
                                                    row.negative_elements, row.worst_cost});
                })
      .rows;
}

}  // namespace camber
