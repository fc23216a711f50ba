#pragma once
// Private: Projector on OpenCASCADE; seeded and global searches within the trim.
#include <camber/geom_occ/detail/occ_model.hpp>
#include <camber/geom_occ/detail/trim.hpp>

#include <memory>
#include <vector>

namespace camber::occ {

/// One per thread. Everything but the trim classifiers is shared and immutable.
class OccProjector final : public Projector {
 public:
  OccProjector(std::shared_ptr<const Body> body, double scale);

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
  /// Nearest point of the face's border: a curve, or the tip of a degenerate one.
  struct BorderPoint {
    const FaceEdge* edge = nullptr;
    double t = 0.0;
    Vec3 point = Vec3::Zero();
    double distance_squared = 0.0;
  };
  [[nodiscard]] Projection closest_on_vertex(int vertex, const Vec3& x) const;
  [[nodiscard]] Projection closest_on_curve(int curve, const Vec3& x,
                                            const std::optional<Vec2>& seed) const;
  [[nodiscard]] Projection closest_on_face(int face, const Vec3& x,
                                           const std::optional<Vec2>& seed);
  [[nodiscard]] BorderPoint closest_on_border(const FaceData& data, const Vec3& x,
                                              double bound) const;
  [[nodiscard]] bool is_in_trim(int face, const FaceData& data, const SurfaceFoot& foot);
  /// To the caller's unit, with the uv that the caller expects.
  [[nodiscard]] Projection finished(int face, const FaceData& data, const Vec3& point,
                                    const Vec2& uv, double distance, ProjectionStatus status,
                                    const std::optional<Vec2>& seed) const;

  std::shared_ptr<const Body> body_;
  double scale_;
  std::vector<std::unique_ptr<Trim>> trims_;
};

}  // namespace camber::occ
