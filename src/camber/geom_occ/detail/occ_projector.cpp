#include <camber/geom_occ/detail/kernel_errors.hpp>
#include <camber/geom_occ/detail/kernel_shapes.hpp>
#include <camber/geom_occ/detail/occ_projector.hpp>

#include <cmath>
#include <limits>

#include <BRep_Tool.hxx>
#include <Precision.hxx>
#include <TopoDS_Vertex.hxx>

namespace camber::occ {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();
/// A line has met the surface if it passes within this part of the face's size.
constexpr double k_crossing = 1e-10;

/// A seed that is no number is none.
std::optional<Vec2> finite(const std::optional<Vec2>& seed) {
  return seed && seed->allFinite() ? seed : std::nullopt;
}

Projection failed(GeomEntity entity, const Vec3& x) {
  Projection result;
  result.point = x;
  result.distance = k_infinity;
  result.entity = entity;
  return result;
}

}  // namespace

OccProjector::OccProjector(std::shared_ptr<const Body> body, double scale)
    : body_(std::move(body)), scale_(scale), trims_(at(body_->topology().count(2))) {}

Projection OccProjector::closest(GeomEntity entity, const Vec3& x,
                                 const std::optional<Vec2>& given_seed) {
  body_->check(entity);
  const std::optional<Vec2> seed = finite(given_seed);
  if (!x.allFinite()) return failed(entity, x);
  try {
    const Vec3 inner = x / scale_;
    Projection result = entity.dim == 2   ? closest_on_face(entity.tag, inner, seed)
                        : entity.dim == 1 ? closest_on_curve(entity.tag, inner, seed)
                                          : closest_on_vertex(entity.tag, inner);
    return std::isfinite(result.distance) ? result : failed(entity, x);
  } catch (const Standard_Failure&) {
    return failed(entity, x);
  }
}

Projection OccProjector::closest_on_vertex(int vertex, const Vec3& x) const {
  const Vec3 point = to_vec(BRep_Tool::Pnt(body_->topology().vertex(vertex)).XYZ());
  return {scale_ * point,
          Vec2::Zero(),
          scale_ * (x - point).norm(),
          ProjectionStatus::inside,
          {0, vertex}};
}

Projection OccProjector::closest_on_curve(int curve, const Vec3& x,
                                          const std::optional<Vec2>& seed) const {
  const CurveData& data = body_->curve(curve);
  const CurveFoot foot = occ::closest_on_curve(data, x, seed ? &(*seed)[0] : nullptr);
  const bool is_end =
      data.is_degenerate || (data.period == 0.0 && (foot.t <= data.first || foot.t >= data.last));
  return {scale_ * foot.point,
          Vec2(foot.t, 0.0),
          scale_ * std::sqrt(foot.distance_squared),
          is_end ? ProjectionStatus::boundary : ProjectionStatus::inside,
          {1, curve}};
}

OccProjector::BorderPoint OccProjector::closest_on_border(const FaceData& data, const Vec3& x,
                                                          double bound) const {
  BorderPoint best;
  best.distance_squared = bound;
  for (const FaceEdge& edge : data.edges) {
    const CurveData& curve = body_->curve(edge.tag);
    if (curve.is_degenerate) {
      const double squared = (x - curve.tip).squaredNorm();
      if (squared < best.distance_squared)
        best = {&edge, 0.5 * (curve.first + curve.last), curve.tip, squared};
    } else if (!(edge.is_seam() && data.periods.maxCoeff() > 0.0) &&
               distance_squared(curve.tree->box(), x) < best.distance_squared) {
      if (const auto foot = curve.tree->nearest(x, best.distance_squared))
        best = {&edge, wrap_period(foot->t, curve.first, curve.period), foot->point,
                foot->distance_squared};
    }
  }
  return best;
}

bool OccProjector::is_in_trim(int face, const FaceData& data, const SurfaceFoot& foot) {
  std::unique_ptr<Trim>& trim = trims_[at(face - 1)];
  if (!trim) trim = std::make_unique<Trim>(data);
  if (trim->contains(foot.uv)) return true;
  // Outside by no more than the tolerance of the edge that it is at: still the face.
  for (const FaceEdge& edge : data.edges) {
    const CurveData& curve = body_->curve(edge.tag);
    const double gap = std::max(curve.tolerance, Precision::Confusion());
    if (curve.is_degenerate ? (foot.point - curve.tip).norm() <= gap
                            : distance_squared(curve.tree->box(), foot.point) <= gap * gap &&
                                  curve.tree->nearest(foot.point, gap * gap).has_value())
      return true;
  }
  return false;
}

Projection OccProjector::finished(int face, const FaceData& data, const Vec3& point, const Vec2& uv,
                                  double distance, ProjectionStatus status,
                                  const std::optional<Vec2>& seed) const {
  return {scale_ * point,
          seed ? data.beside(uv, *seed) : data.wrapped(uv),
          scale_ * distance,
          status,
          {2, face}};
}

Projection OccProjector::closest_on_face(int face, const Vec3& x, const std::optional<Vec2>& seed) {
  const FaceData& data = body_->face(face);
  const auto is_foot = [&](const SurfaceFoot& foot) {
    return foot.is_converged && foot.tangential <= data.gap && is_in_trim(face, data, foot);
  };
  if (seed) {
    const SurfaceFoot foot = find_foot(*data.surface, x, *seed, data.limits, data.tree->size());
    if (is_foot(foot))
      return finished(face, data, foot.point, foot.uv, std::sqrt(foot.distance_squared),
                      ProjectionStatus::inside, seed);
  }
  SurfaceFoot best, any;  // `any`: wherever a search ended, for faces without border curves
  data.tree->feet(
      x, [&] { return best.distance_squared; },
      [&](const SurfaceFoot& foot) {
        if (foot.distance_squared < any.distance_squared) any = foot;
        if (foot.distance_squared < best.distance_squared && is_foot(foot)) best = foot;
      });
  const double distance = std::sqrt(best.distance_squared);
  const BorderPoint border = closest_on_border(data, x, best.distance_squared);
  const double on_border = std::sqrt(border.distance_squared);
  // The border wins only if it is nearer by more than the gap between its curve and the face.
  if (border.edge != nullptr &&
      distance - on_border >
          std::max(body_->curve(border.edge->tag).tolerance, Precision::Confusion())) {
    Vec2 uv = edge_uv(data, *border.edge, border.t, seed);
    if ((data.surface->jet(uv).s - border.point).norm() > data.gap) {  // the two curves run apart
      const SurfaceFoot foot =
          find_foot(*data.surface, border.point, uv, data.limits, data.tree->size());
      uv = foot.uv;
    }
    return finished(face, data, border.point, uv, on_border, ProjectionStatus::boundary, seed);
  }
  if (std::isfinite(distance))
    return finished(face, data, best.point, best.uv, distance, ProjectionStatus::inside, seed);
  return finished(face, data, any.point, any.uv, std::sqrt(any.distance_squared),
                  ProjectionStatus::boundary, seed);
}

std::optional<Projection> OccProjector::along_line(int face, const Vec3& x, const Vec3& direction,
                                                   double max_distance,
                                                   const std::optional<Vec2>& given_seed) {
  body_->check({2, face});
  const std::optional<Vec2> seed = finite(given_seed);
  const double length = direction.norm();
  if (!x.allFinite() || !(length > 0.0) || !std::isfinite(length) || !(max_distance >= 0.0))
    return {};
  try {
    const FaceData& data = body_->face(face);
    const Vec3 inner = x / scale_, d = direction / length;
    const double close = k_crossing * data.tree->size();
    double bound = max_distance / scale_;
    SurfaceFoot best;
    const auto take = [&](const SurfaceFoot& foot) {
      const double s = std::abs((foot.point - inner).dot(d));
      if (foot.distance_squared > close * close || s > bound || !is_in_trim(face, data, foot))
        return;
      bound = s;
      best = foot;
    };
    const auto found = [&] {
      return finished(face, data, best.point, best.uv, bound, ProjectionStatus::inside, seed);
    };
    if (seed) {
      take(find_line_foot(*data.surface, inner, d, *seed, data.limits, data.tree->size()));
      if (std::isfinite(best.distance_squared)) return found();
    }
    data.tree->crossings(
        inner, d, [&] { return bound; }, take);
    if (std::isfinite(best.distance_squared)) return found();
  } catch (const Standard_Failure&) {
    return {};
  }
  return {};
}

SurfacePoint OccProjector::evaluate_face(int face, const Vec2& uv) {
  const FaceData& data = body_->face(face);
  return guarded("CAD face " + std::to_string(face), [&] {
    const SurfaceJet jet = data.surface->jet(uv);
    const Vec3 normal = unit_normal(*data.surface, data.limits, uv, jet);
    return SurfacePoint{scale_ * jet.s, scale_ * jet.su, scale_ * jet.sv,
                        data.is_reversed ? Vec3(-normal) : normal};
  });
}

CurvePoint OccProjector::evaluate_curve(int curve, double t) {
  const CurveData& data = body_->curve(curve);
  if (data.is_degenerate) return {scale_ * data.tip, Vec3::Zero()};
  return guarded("CAD curve " + std::to_string(curve), [&] {
    const CurveJet jet = data.curve->jet(t);
    return CurvePoint{scale_ * jet.c, scale_ * jet.ct};
  });
}

void OccProjector::divide_curve(int curve, double t0, double t1, std::span<const double> fractions,
                                std::span<Projection> result) {
  const CurveData& data = body_->curve(curve);
  guarded("CAD curve " + std::to_string(curve), [&] {
    const double l0 = data.is_degenerate ? 0.0 : data.tree->length_to(t0);
    const double l1 = data.is_degenerate ? 0.0 : data.tree->length_to(t1);
    for (std::size_t i = 0; i < fractions.size() && i < result.size(); ++i) {
      const double t = data.is_degenerate
                           ? std::lerp(t0, t1, fractions[i])
                           : data.tree->parameter_at(std::lerp(l0, l1, fractions[i]));
      const Vec3 point = data.is_degenerate ? data.tip : data.curve->jet(t).c;
      result[i] = {scale_ * point, Vec2(t, 0.0), 0.0, ProjectionStatus::inside, {1, curve}};
    }
  });
}

double OccProjector::curve_length(int curve, double t0, double t1) {
  const CurveData& data = body_->curve(curve);
  if (data.is_degenerate) return 0.0;
  return guarded("CAD curve " + std::to_string(curve), [&] {
    return scale_ * std::abs(data.tree->length_to(t1) - data.tree->length_to(t0));
  });
}

}  // namespace camber::occ
