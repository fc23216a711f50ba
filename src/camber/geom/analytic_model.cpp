#include <camber/base/error.hpp>
#include <camber/geom/analytic_model.hpp>
#include <camber/geom/surface_tree.hpp>

#include <cmath>
#include <limits>

namespace camber {
namespace {

// Parts of the surface's size: a line that passes this near has met it; a foot this little off the
// normal is orthogonal.
constexpr double k_crossing = 1e-10;
constexpr double k_orthogonal = 1e-9;

[[noreturn]] void no_such(const char* kind, int tag) {
  throw GeometryError("the analytic model has no such entity", kind + (" " + std::to_string(tag)),
                      "its only entity is face 1");
}

void check_face(int tag) {
  if (tag != 1) no_such("face", tag);
}

/// A seed that is no number is none.
std::optional<Vec2> finite(const std::optional<Vec2>& seed) {
  return seed && seed->allFinite() ? seed : std::nullopt;
}

struct Shared {
  explicit Shared(std::unique_ptr<AnalyticSurface> s)
      : surface(std::move(s)), tree(*surface, surface->domain()) {}
  std::unique_ptr<AnalyticSurface> surface;
  SurfaceTree tree;
};

class AnalyticProjector final : public Projector {
 public:
  AnalyticProjector(std::shared_ptr<const Shared> shared, double scale)
      : shared_(std::move(shared)), scale_(scale) {}

  Projection closest(GeomEntity entity, const Vec3& x,
                     const std::optional<Vec2>& given_seed) override {
    if (entity != GeomEntity{2, 1}) no_such("entity", entity.tag);
    if (!x.allFinite()) {
      Projection failed;
      failed.point = x;
      failed.distance = std::numeric_limits<double>::infinity();
      failed.entity = entity;
      return failed;
    }
    const std::optional<Vec2> seed = finite(given_seed);
    const SurfaceFoot foot = shared_->surface->closest(x / scale_, seed);
    const bool is_inside = foot.tangential <= k_orthogonal * shared_->tree.size();
    return finished(foot, std::sqrt(foot.distance_squared),
                    is_inside ? ProjectionStatus::inside : ProjectionStatus::boundary, seed);
  }

  std::optional<Projection> along_line(int face, const Vec3& x, const Vec3& direction,
                                       double max_distance,
                                       const std::optional<Vec2>& given_seed) override {
    check_face(face);
    const double length = direction.norm();
    if (!x.allFinite() || !(length > 0.0) || !std::isfinite(length) || !(max_distance >= 0.0))
      return {};
    const std::optional<Vec2> seed = finite(given_seed);
    const Vec3 inner = x / scale_, d = direction / length;
    const double close = k_crossing * shared_->tree.size();
    double bound = max_distance / scale_;
    SurfaceFoot best;
    const auto take = [&](const SurfaceFoot& foot) {
      const double s = std::abs((foot.point - inner).dot(d));
      if (foot.distance_squared > close * close || s > bound) return;
      bound = s;
      best = foot;
    };
    if (seed)
      take(find_line_foot(*shared_->surface, inner, d, *seed, shared_->surface->domain(),
                          shared_->tree.size()));
    if (!std::isfinite(best.distance_squared))
      shared_->tree.crossings(
          inner, d, [&] { return bound; }, take);
    if (!std::isfinite(best.distance_squared)) return {};
    return finished(best, bound, ProjectionStatus::inside, seed);
  }

  SurfacePoint evaluate_face(int face, const Vec2& uv) override {
    check_face(face);
    const SurfaceJet jet = shared_->surface->jet(uv);
    return {scale_ * jet.s, scale_ * jet.su, scale_ * jet.sv,
            unit_normal(*shared_->surface, shared_->surface->domain(), uv, jet)};
  }
  CurvePoint evaluate_curve(int curve, double) override { no_such("curve", curve); }
  void divide_curve(int curve, double, double, std::span<const double>,
                    std::span<Projection>) override {
    no_such("curve", curve);
  }
  double curve_length(int curve, double, double) override { no_such("curve", curve); }

 private:
  Projection finished(const SurfaceFoot& foot, double distance, ProjectionStatus status,
                      const std::optional<Vec2>& seed) const {
    const Vec2 periods = shared_->surface->periods();
    const UvBox domain = shared_->surface->domain();
    Vec2 uv;
    for (int k = 0; k < 2; ++k)
      uv[k] = seed ? nearest_period(foot.uv[k], (*seed)[k], periods[k])
                   : wrap_period(foot.uv[k], domain.lower[k], periods[k]);
    return {scale_ * foot.point, uv, scale_ * distance, status, {2, 1}};
  }

  std::shared_ptr<const Shared> shared_;
  double scale_;
};

class AnalyticModel final : public GeometryModel {
 public:
  AnalyticModel(std::unique_ptr<AnalyticSurface> surface, std::string name)
      : shared_(std::make_shared<const Shared>(std::move(surface))), name_(std::move(name)) {}

  int count(int dim) const override { return dim == 2 ? 1 : 0; }
  std::string name(GeomEntity entity) const override {
    check(entity);
    return name_;
  }
  Box box() const override {
    Box result;
    result.add(Vec3(scale_ * shared_->tree.box().lower));
    result.add(Vec3(scale_ * shared_->tree.box().upper));
    return result;
  }
  Box box(GeomEntity entity) const override {
    check(entity);
    return box();
  }
  double tolerance(GeomEntity entity) const override {
    check(entity);
    return 0.0;
  }
  bool is_degenerate(int curve) const override { no_such("curve", curve); }
  bool is_seam(int curve, int) const override { no_such("curve", curve); }
  bool is_planar(int face) const override {
    check_face(face);
    return shared_->surface->is_planar();
  }
  bool is_straight(int curve) const override { no_such("curve", curve); }
  std::vector<int> faces_of_curve(int curve) const override { no_such("curve", curve); }
  std::vector<int> curves_of_face(int face) const override {
    check_face(face);
    return {};
  }
  std::vector<int> vertices_of_curve(int curve) const override { no_such("curve", curve); }
  CurveRange range(int curve) const override { no_such("curve", curve); }
  Vec2 periods(int face) const override {
    check_face(face);
    return shared_->surface->periods();
  }
  Vec2 curve_on_face(int curve, int, double, const std::optional<Vec2>&) const override {
    no_such("curve", curve);
  }
  std::unique_ptr<Projector> projector() const override {
    return std::make_unique<AnalyticProjector>(shared_, scale_);
  }
  void set_scale(double scale) override {
    if (!(scale > 0.0) || !std::isfinite(scale))
      throw GeometryError("the scale of a model must be positive", std::to_string(scale),
                          "give a unit such as m, mm or in");
    scale_ = scale;
  }
  double scale() const override { return scale_; }

 private:
  static void check(GeomEntity entity) {
    if (entity != GeomEntity{2, 1}) no_such("entity", entity.tag);
  }
  std::shared_ptr<const Shared> shared_;
  std::string name_;
  double scale_ = 1.0;
};

}  // namespace

std::unique_ptr<GeometryModel> make_analytic_model(std::unique_ptr<AnalyticSurface> surface,
                                                   std::string name) {
  return std::make_unique<AnalyticModel>(std::move(surface), std::move(name));
}

std::unique_ptr<GeometryModel> make_plane(const Vec3& origin, const Vec3& a, const Vec3& b) {
  return make_analytic_model(plane_surface(origin, a, b));
}

std::unique_ptr<GeometryModel> make_sphere(const Vec3& centre, double radius) {
  return make_analytic_model(ellipsoid_surface(centre, Vec3::Constant(radius)));
}

std::unique_ptr<GeometryModel> make_cylinder(const Vec3& base, const Vec3& axis, double radius) {
  return make_analytic_model(cylinder_surface(base, axis, radius));
}

std::unique_ptr<GeometryModel> make_torus(const Vec3& centre, const Vec3& axis, double major,
                                          double minor) {
  return make_analytic_model(torus_surface(centre, axis, major, minor));
}

std::unique_ptr<GeometryModel> make_ellipsoid(const Vec3& centre, const Vec3& semi_axes) {
  return make_analytic_model(ellipsoid_surface(centre, semi_axes));
}

std::unique_ptr<GeometryModel> make_bspline_patch(BsplineSurface patch) {
  return make_analytic_model(bspline_surface(std::move(patch)));
}

}  // namespace camber
