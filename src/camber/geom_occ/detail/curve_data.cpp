#include <camber/geom_occ/detail/curve_data.hpp>
#include <camber/geom_occ/detail/kernel_shapes.hpp>

#include <limits>

#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopoDS_Vertex.hxx>

namespace camber::occ {
namespace {

/// A foot is orthogonal if the residual along the tangent is below this part of the curve's size.
constexpr double k_orthogonal = 1e-9;

}  // namespace

CurveData::CurveData(const TopoDS_Edge& edge) : tolerance(BRep_Tool::Tolerance(edge)) {
  const Handle(Geom_Curve) kernel = BRep_Tool::Curve(edge, first, last);
  TopoDS_Vertex v0, v1;
  TopExp::Vertices(edge, v0, v1);
  if (!v0.IsNull()) tip = to_vec(BRep_Tool::Pnt(v0).XYZ());
  is_degenerate = BRep_Tool::Degenerated(edge) || kernel.IsNull() || !(last > first);
  if (is_degenerate) return;
  const double gap = kernel->Value(first).Distance(kernel->Value(last));
  const bool is_closed =
      !v0.IsNull() && v0.IsSame(v1) && gap <= 2.0 * std::max(tolerance, BRep_Tool::Tolerance(v0));
  curve = make_curve(kernel, first, last, is_closed);
  period = curve->period();
  tree = std::make_unique<CurveTree>(*curve);
  // An edge shorter than the tolerance of its model is a point.
  is_degenerate = !(tree->length() > 1e-9 && tree->length() > 1e-2 * tolerance);
}

CurveFoot closest_on_curve(const CurveData& data, const Vec3& x, const double* seed) {
  CurveFoot foot;
  if (data.is_degenerate) {
    foot.t = data.first;
    foot.point = data.tip;
    foot.distance_squared = (x - data.tip).squaredNorm();
    foot.is_converged = true;
    return foot;
  }
  if (seed != nullptr)
    foot = find_foot(*data.curve, x, *seed, data.first, data.last, data.tree->size());
  if (!foot.is_converged || foot.tangential > k_orthogonal * data.tree->size()) {
    const auto found = data.tree->nearest(x, std::numeric_limits<double>::infinity());
    if (found) foot = *found;
  }
  foot.t = wrap_period(foot.t, data.first, data.period);
  if (seed != nullptr) foot.t = nearest_period(foot.t, *seed, data.period);
  return foot;
}

}  // namespace camber::occ
