#pragma once
#include <camber/reconstruct/detail/facet_model.hpp>

namespace camber::detail {

/// Stateless beyond its model: any number of them.
class FacetProjector final : public Projector {
 public:
  FacetProjector(std::shared_ptr<const FacetBody> body, double scale)
      : body_(std::move(body)), scale_(scale) {}

  Projection closest(GeomEntity entity, const Vec3& x, const std::optional<Vec2>& seed) override;
  std::optional<Projection> along_line(int face, const Vec3& x, const Vec3& direction,
                                       double max_distance,
                                       const std::optional<Vec2>& seed) override;
  SurfacePoint evaluate_face(int face, const Vec2& uv) override;
  CurvePoint evaluate_curve(int curve, double t) override;
  void divide_curve(int curve, double t0, double t1, std::span<const double> fractions,
                    std::span<Projection> result) override;
  double curve_length(int curve, double t0, double t1) override;

 private:
  Projection closest_on_curve(int curve, const Vec3& x, const std::optional<Vec2>& seed) const;
  Projection closest_on_face(int face, const Vec3& x, const std::optional<Vec2>& seed) const;

  std::shared_ptr<const FacetBody> body_;
  double scale_;
};

}  // namespace camber::detail
