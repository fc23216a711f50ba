#include <camber/geom/geometry_model.hpp>

#include "layer_meshes.hpp"

namespace camber::testing {
namespace {

class JoinedProjector final : public Projector {
 public:
  explicit JoinedProjector(std::vector<std::unique_ptr<Projector>> parts)
      : parts_(std::move(parts)) {}
  Projection closest(GeomEntity entity, const Vec3& x, const std::optional<Vec2>& seed) override {
    return named(part(entity.tag).closest({2, 1}, x, seed), entity.tag);
  }
  std::optional<Projection> along_line(int face, const Vec3& x, const Vec3& direction,
                                       double max_distance,
                                       const std::optional<Vec2>& seed) override {
    const auto hit = part(face).along_line(1, x, direction, max_distance, seed);
    if (!hit) return {};
    return named(*hit, face);
  }
  SurfacePoint evaluate_face(int face, const Vec2& uv) override {
    return part(face).evaluate_face(1, uv);
  }
  CurvePoint evaluate_curve(int curve, double t) override {
    return part(1).evaluate_curve(curve, t);
  }
  void divide_curve(int curve, double t0, double t1, std::span<const double> fractions,
                    std::span<Projection> result) override {
    part(1).divide_curve(curve, t0, t1, fractions, result);
  }
  double curve_length(int curve, double t0, double t1) override {
    return part(1).curve_length(curve, t0, t1);
  }

 private:
  Projector& part(int face) { return *parts_.at(static_cast<std::size_t>(face - 1)); }
  static Projection named(Projection foot, int face) {
    foot.entity = {2, face};
    return foot;
  }
  std::vector<std::unique_ptr<Projector>> parts_;
};

class JoinedModel final : public GeometryModel {
 public:
  explicit JoinedModel(std::vector<std::unique_ptr<GeometryModel>> parts)
      : parts_(std::move(parts)) {}
  int count(int dim) const override { return dim == 2 ? static_cast<int>(parts_.size()) : 0; }
  std::string name(GeomEntity entity) const override { return part(entity.tag).name({2, 1}); }
  Box box() const override {
    Box all;
    for (const auto& p : parts_) all.add(p->box());
    return all;
  }
  Box box(GeomEntity entity) const override { return part(entity.tag).box(); }
  double tolerance(GeomEntity entity) const override { return part(entity.tag).tolerance({2, 1}); }
  bool is_degenerate(int curve) const override { return part(1).is_degenerate(curve); }
  bool is_seam(int curve, int face) const override { return part(face).is_seam(curve, 1); }
  bool is_planar(int face) const override { return part(face).is_planar(1); }
  bool is_straight(int curve) const override { return part(1).is_straight(curve); }
  std::vector<int> faces_of_curve(int curve) const override {
    return part(1).faces_of_curve(curve);
  }
  std::vector<int> curves_of_face(int face) const override { return part(face).curves_of_face(1); }
  std::vector<int> vertices_of_curve(int curve) const override {
    return part(1).vertices_of_curve(curve);
  }
  CurveRange range(int curve) const override { return part(1).range(curve); }
  Vec2 periods(int face) const override { return part(face).periods(1); }
  Vec2 curve_on_face(int curve, int face, double t,
                     const std::optional<Vec2>& near) const override {
    return part(face).curve_on_face(curve, 1, t, near);
  }
  std::unique_ptr<Projector> projector() const override {
    std::vector<std::unique_ptr<Projector>> projectors;
    for (const auto& p : parts_) projectors.push_back(p->projector());
    return std::make_unique<JoinedProjector>(std::move(projectors));
  }
  void set_scale(double scale) override {
    for (const auto& p : parts_) p->set_scale(scale);
  }
  double scale() const override { return parts_.front()->scale(); }

 private:
  const GeometryModel& part(int face) const {
    return *parts_.at(static_cast<std::size_t>(face - 1));
  }
  std::vector<std::unique_ptr<GeometryModel>> parts_;
};

}  // namespace

std::unique_ptr<GeometryModel> joined(std::vector<std::unique_ptr<GeometryModel>> parts) {
  return std::make_unique<JoinedModel>(std::move(parts));
}

}  // namespace camber::testing
