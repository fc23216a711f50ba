#pragma once
// The last stage before measuring: quality, once every cell is certified.
#include <camber/associate/association.hpp>
#include <camber/base/progress.hpp>
#include <camber/mesh/curved_mesh.hpp>
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
/// was certified is so afterwards: edges, faces and insides of cells that lost their certificate
/// get their shape from before, until all are certified again. Deterministic for any number of
/// threads.
/// @throws Cancelled through progress
SmoothOutcome smooth_stage(CurvedMesh& curved, const Association& association,
                           const GeometryModel& geometry, const CurveOptions& options,
                           const Progress& progress);

}  // namespace camber
