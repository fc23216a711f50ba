#include <camber/pipeline/detail/report_warnings.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace camber::detail {
namespace {

/// Of the mesh's size: what is moved by less has not been moved.
constexpr double k_rounding = 1e-14;

/// Cells that are not certified though nothing of them is curved: the linear mesh is at fault.
void warn_of_flat_cells(const CurveResult& result, Report& report) {
  std::size_t flat = 0;
  Index first = k_none;
  Points x, straight;
  for (Index c = 0; at(c) < result.linear->cell_count(); ++c) {
    if (result.cell_bound[at(c)] > 0.0) continue;
    const int p = result.curved->cell_order(c);
    result.curved->gather(c, p, x);
    result.curved->gather_straight(c, p, straight);
    double moved = 0.0;
    for (std::size_t i = 0; i < x.size(); ++i) moved = std::max(moved, (x[i] - straight[i]).norm());
    if (moved > k_rounding * result.linear->size()) continue;
    if (flat++ == 0) first = c;
  }
  if (flat == 0) return;
  report.warnings.push_back(fmt::format(
      "{} cells are straight and not certified all the same: they are so flat that "
      "rounding decides the sign of their volume. Repair the linear mesh there (cell {} "
      "and others)",
      flat, result.linear->cell_tags[at(first)]));
}

}  // namespace

void warn(const CurveResult& result, Report& report) {
  warn_of_flat_cells(result, report);
  const ElasticWork& elastic = report.start.elastic;
  if (elastic.unconverged > 0) {
    report.warnings.push_back(
        fmt::format("{} of {} elastic solves stopped before they converged (residual {:.1g}); what "
                    "they gave is certified all the same",
                    elastic.unconverged, elastic.solves, elastic.largest_residual));
  }
  if (result.linear->sewn_vertices > 0) {
    report.warnings.push_back(fmt::format(
        "{} vertices had a twin at the same place and were joined: the parts of the mesh did not "
        "share their nodes",
        result.linear->sewn_vertices));
  }
  std::size_t bare = 0;
  for (const Patch& patch : result.association.patches) {
    if (patch.entity == 0 && patch.group.empty()) bare += patch.faces;
  }
  if (bare > 0) {
    report.warnings.push_back(fmt::format(
        "{} boundary faces have no surface element and no CAD and stay straight", bare));
  }
}

}  // namespace camber::detail
