#pragma once
// Private: one CAD curve, ready for queries; shared by all projectors, lengths in the kernel's
// unit.
#include <camber/geom/curve_tree.hpp>

#include <memory>

#include <TopoDS_Edge.hxx>

namespace camber::occ {

struct CurveData {
  explicit CurveData(const TopoDS_Edge& edge);

  bool is_degenerate = false;  // then only `tip` and `tolerance` have a meaning
  Vec3 tip = Vec3::Zero();     // the vertex of a degenerate edge
  double first = 0.0, last = 1.0, period = 0.0;
  double tolerance = 0.0;
  std::unique_ptr<ParametricCurve> curve;
  std::unique_ptr<CurveTree> tree;
};

/// Nearest point of the curve, ends included. With a seed the local search is tried first.
[[nodiscard]] CurveFoot closest_on_curve(const CurveData& data, const Vec3& x, const double* seed);

}  // namespace camber::occ
