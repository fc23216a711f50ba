#pragma once
// Fills the report of a curve() run from its final state.
#include <camber/elevate/order_rules.hpp>
#include <camber/pipeline/curve.hpp>
#include <camber/pipeline/ladder.hpp>

namespace camber {

/// What the stages of curve() made, besides its result.
struct Made {
  const Wall& wall;
  const Placement& placement;
  const Columns& columns;
  const StartReport& start;
  const LadderResult& ladder;
};

/// Certificates, cost, surface error by group and order, wall spacing, gaps, rescue: everything
/// measured on the final nodes, nothing carried over from the stages that made them.
void summarise(CurveResult& result, const GeometryModel& geometry, const Made& made,
               const CurveOptions& options);

}  // namespace camber
