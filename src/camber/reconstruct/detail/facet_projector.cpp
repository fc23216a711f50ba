#include <camber/base/error.hpp>
#include <camber/reconstruct/detail/facet_projector.hpp>

#include <cmath>
#include <limits>

namespace camber::detail {
namespace {

/// Parts of the facet's size: a foot this little off the normal is orthogonal.
constexpr double k_orthogonal = 1e-9;

Projection failed(GeomEntity entity, const Vec3& x) {
  Projection result;
  result.point = x;
  result.distance = std::numeric_limits<double>::infinity();
  result.entity = entity;
  return result;
}

std::optional<Vec2> finite(const std::optional<Vec2>& seed) {
  return seed && seed->allFinite() ? seed : std::nullopt;
}

}  // namespace

Projection FacetProjector::closest(GeomEntity entity, const Vec3& x,
                                   const std::optional<Vec2>& given_seed) {
  check_entity(*body_, entity);
  if (!x.allFinite()) return failed(entity, x);
  const std::optional<Vec2> seed = finite(given_seed);
  const Vec3 inner = x / scale_;
  if (entity.dim == 2) return closest_on_face(entity.tag, inner, seed);
  if (entity.dim == 1) return closest_on_curve(entity.tag, inner, seed);
  const Vec3& point = body_->corners[at(entity.tag - 1)];
  return {scale_ * point, Vec2::Zero(), scale_ * (inner - point).norm(), ProjectionStatus::inside,
          entity};
}

Projection FacetProjector::closest_on_face(int face, const Vec3& x,
                                           const std::optional<Vec2>& seed) const {
  const FacetFoot found = body_->facets.closest(face - 1, x, seed);
  if (found.facet == k_none) return failed({2, face}, Vec3(scale_ * x));
  const bool is_stopped =
      body_->facets.is_on_rim(found.facet, found.foot.uv) &&
      found.foot.tangential > k_orthogonal * body_->facets.patch(found.facet).size();
  return {scale_ * found.foot.point,
          packed(found.facet, found.foot.uv),
          scale_ * std::sqrt(found.foot.distance_squared),
          is_stopped ? ProjectionStatus::boundary : ProjectionStatus::inside,
          {2, face}};
}

Projection FacetProjector::closest_on_curve(int curve, const Vec3& x,
                                            const std::optional<Vec2>& seed) const {
  const ChainCurve& chain = body_->curves[at(curve - 1)];
  const std::optional<CurveFoot> foot =
      body_->trees[at(curve - 1)].nearest(x, std::numeric_limits<double>::infinity());
  if (!foot) return failed({1, curve}, Vec3(scale_ * x));
  const bool is_end = chain.period() == 0.0 && (foot->t <= 0.0 || foot->t >= chain.last());
  double t = wrap_period(foot->t, 0.0, chain.period());
  if (seed) t = nearest_period(t, seed->x(), chain.period());
  return {scale_ * foot->point,
          Vec2(t, 0.0),
          scale_ * std::sqrt(foot->distance_squared),
          is_end ? ProjectionStatus::boundary : ProjectionStatus::inside,
          {1, curve}};
}

std::optional<Projection> FacetProjector::along_line(int face, const Vec3& x, const Vec3& direction,
                                                     double max_distance,
                                                     const std::optional<Vec2>& seed) {
  check_entity(*body_, {2, face});
  const double length = direction.norm();
  if (!x.allFinite() || !(length > 0.0) || !std::isfinite(length) || !(max_distance >= 0.0)) {
    return {};
  }
  const Vec3 inner = x / scale_, d = direction / length;
  const FacetFoot found =
      body_->facets.crossing(face - 1, inner, d, max_distance / scale_, finite(seed));
  if (found.facet == k_none) return {};
  return Projection{scale_ * found.foot.point,
                    packed(found.facet, found.foot.uv),
                    scale_ * std::abs((found.foot.point - inner).dot(d)),
                    ProjectionStatus::inside,
                    {2, face}};
}

SurfacePoint FacetProjector::evaluate_face(int face, const Vec2& uv) {
  check_entity(*body_, {2, face});
  const auto [facet, local] = unpacked(uv);
  if (facet < 0 || at(facet) >= body_->facets.count()) {
    throw GeometryError("parameters outside of the surface", "face " + std::to_string(face),
                        "use the parameters that a projection gave");
  }
  const FacetPatch& patch = body_->facets.patch(facet);
  const SurfaceJet jet = patch.jet(local);
  return {scale_ * jet.s, scale_ * jet.su, scale_ * jet.sv, patch.normal(local)};
}

CurvePoint FacetProjector::evaluate_curve(int curve, double t) {
  check_entity(*body_, {1, curve});
  const CurveJet jet = body_->curves[at(curve - 1)].jet(t);
  return {scale_ * jet.c, scale_ * jet.ct};
}

void FacetProjector::divide_curve(int curve, double t0, double t1,
                                  std::span<const double> fractions, std::span<Projection> result) {
  check_entity(*body_, {1, curve});
  const CurveTree& tree = body_->trees[at(curve - 1)];
  const double l0 = tree.length_to(t0), l1 = tree.length_to(t1);
  for (std::size_t i = 0; i < fractions.size() && i < result.size(); ++i) {
    const double t = tree.parameter_at(std::lerp(l0, l1, fractions[i]));
    result[i] = {scale_ * body_->curves[at(curve - 1)].jet(t).c,
                 Vec2(t, 0.0),
                 0.0,
                 ProjectionStatus::inside,
                 {1, curve}};
  }
}

double FacetProjector::curve_length(int curve, double t0, double t1) {
  check_entity(*body_, {1, curve});
  const CurveTree& tree = body_->trees[at(curve - 1)];
  return scale_ * std::abs(tree.length_to(t1) - tree.length_to(t0));
}

}  // namespace camber::detail
