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

/// Smooths as the options say. The mesh may be replaced by one of higher orders; every cell that
/// was certified is so afterwards: where smoothing lost a certificate the state before is put back.
/// Deterministic for any number of threads.
/// @param first_cells  of the layers: the default smoothing leaves their nodes alone, so that the
///                     near-wall spacing stays
/// @return what was done, row by row; empty if nothing was asked for
/// @throws Cancelled through progress
std::vector<SmoothRow> smooth_stage(std::unique_ptr<CurvedMesh>& curved,
                                    const Association& association, const GeometryModel& geometry,
                                    const std::vector<Index>& first_cells,
                                    const CurveOptions& options, const Progress& progress);

}  // namespace camber
