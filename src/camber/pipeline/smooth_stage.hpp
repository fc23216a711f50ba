#pragma once
// The last stage before measuring: quality, once every cell is certified.
#include <camber/base/progress.hpp>
#include <camber/mesh/curved_mesh.hpp>
#include <camber/pipeline/carry_wall.hpp>
#include <camber/pipeline/options.hpp>
#include <camber/smooth/smooth_row.hpp>

#include <memory>
#include <vector>

namespace camber {

struct SmoothOutcome {
  std::vector<SmoothRow> rows;  // as smoothing went
  std::size_t put_back = 0;     // cells that got their state before smoothing back
};

/// Smooths as the options say. The mesh may be replaced by one of higher orders. Every cell that
/// was certified is so afterwards, and the lowest cost of all cells is not lower: edges, faces and
/// insides of cells that lost their certificate, fell below the lowest cost from before, or whose
/// wall faces left the deviation asked, get their shape from before, until none is left; all do if
/// the mean cost would be lower. Deterministic for any number of threads.
/// `auto` leaves the nodes of the first cells of the layers alone, so that the near-wall spacing
/// stays.
/// @throws Cancelled through progress
SmoothOutcome smooth_stage(CurvedMesh& curved, const GeometryModel& geometry,
                           const FieldSource& field, const CurveOptions& options,
                           const Progress& progress);

}  // namespace camber
