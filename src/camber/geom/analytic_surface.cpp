#include <camber/base/error.hpp>
#include <camber/base/ids.hpp>
#include <camber/geom/analytic_surface.hpp>
#include <camber/geom/surface_tree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

namespace camber {
namespace {

constexpr double k_pi = std::numbers::pi;
// A radial distance below this part of the radius is on the axis.
constexpr double k_on_axis = 1e-14;
// A coordinate below this part of the semi-axis is zero: its square would vanish in double
// precision.
constexpr double k_in_plane = 1e-100;

void require(bool condition, const char* what) {
  if (!condition) throw GeometryError(what, "analytic surface", "give positive, finite sizes");
}

/// Two unit vectors that make a right-handed frame with unit e3.
std::array<Vec3, 2> across(const Vec3& e3) {
  int k = 0;
  e3.cwiseAbs().minCoeff(&k);
  const Vec3 e1 = (Vec3::Unit(k) - e3[k] * e3).normalized();
  return {e1, e3.cross(e1)};
}

SurfaceFoot foot_at(const ParametricSurface& surface, const Vec3& x, const Vec2& uv,
                    double tangential) {
  SurfaceFoot foot;
  foot.uv = uv;
  foot.point = surface.jet(uv).s;
  foot.distance_squared = (x - foot.point).squaredNorm();
  foot.tangential = tangential;
  foot.is_converged = true;
  return foot;
}

class Plane final : public AnalyticSurface {
 public:
  Plane(const Vec3& origin, const Vec3& a, const Vec3& b) : origin_(origin), a_(a), b_(b) {
    require(a.norm() > 0.0 && b.norm() > 0.0, "a plane needs two edges");
    require(std::abs(a.dot(b)) <= 1e-12 * a.norm() * b.norm(),
            "the edges of a plane are not orthogonal");
  }
  SurfaceJet jet(const Vec2& uv) const override {
    const Vec3 zero = Vec3::Zero();
    return {origin_ + uv[0] * a_ + uv[1] * b_, a_, b_, zero, zero, zero};
  }
  UvBox domain() const override { return {}; }
  Vec2 periods() const override { return Vec2::Zero(); }
  bool is_planar() const override { return true; }
  SurfaceFoot closest(const Vec3& x, const std::optional<Vec2>&) const override {
    const Vec3 r = x - origin_;
    const Vec2 free(r.dot(a_) / a_.squaredNorm(), r.dot(b_) / b_.squaredNorm());
    const Vec2 uv = free.cwiseMax(0.0).cwiseMin(1.0);
    return foot_at(*this, x, uv, ((free - uv)[0] * a_ + (free - uv)[1] * b_).norm());
  }

 private:
  Vec3 origin_, a_, b_;
};

class Cylinder final : public AnalyticSurface {
 public:
  Cylinder(const Vec3& base, const Vec3& axis, double radius)
      : base_(base), axis_(axis), radius_(radius) {
    require(axis.norm() > 0.0 && radius > 0.0, "a cylinder needs an axis and a radius");
    std::tie(e1_, e2_) = std::tuple(across(axis.normalized())[0], across(axis.normalized())[1]);
  }
  SurfaceJet jet(const Vec2& uv) const override {
    const Vec3 out = std::cos(uv[0]) * e1_ + std::sin(uv[0]) * e2_;
    const Vec3 along = std::cos(uv[0]) * e2_ - std::sin(uv[0]) * e1_, zero = Vec3::Zero();
    return {
        base_ + radius_ * out + uv[1] * axis_, radius_ * along, axis_, -radius_ * out, zero, zero};
  }
  UvBox domain() const override { return {{0.0, 0.0}, {2.0 * k_pi, 1.0}}; }
  Vec2 periods() const override { return {2.0 * k_pi, 0.0}; }
  SurfaceFoot closest(const Vec3& x, const std::optional<Vec2>& near) const override {
    const Vec3 r = x - base_;
    const Vec2 radial(r.dot(e1_), r.dot(e2_));
    const double free = r.dot(axis_) / axis_.squaredNorm(), v = std::clamp(free, 0.0, 1.0);
    const double u = radial.norm() > k_on_axis * radius_ ? std::atan2(radial[1], radial[0])
                     : near                              ? (*near)[0]
                                                         : 0.0;
    return foot_at(*this, x, {wrap_period(u, 0.0, 2.0 * k_pi), v},
                   std::abs(free - v) * axis_.norm());
  }

 private:
  Vec3 base_, axis_, e1_, e2_;
  double radius_;
};

class Torus final : public AnalyticSurface {
 public:
  Torus(const Vec3& centre, const Vec3& axis, double major, double minor)
      : centre_(centre), e3_(axis.normalized()), major_(major), minor_(minor) {
    require(axis.norm() > 0.0 && minor > 0.0 && major > minor, "a torus needs major > minor > 0");
    std::tie(e1_, e2_) = std::tuple(across(e3_)[0], across(e3_)[1]);
  }
  SurfaceJet jet(const Vec2& uv) const override {
    const Vec3 out = std::cos(uv[0]) * e1_ + std::sin(uv[0]) * e2_;
    const Vec3 along = std::cos(uv[0]) * e2_ - std::sin(uv[0]) * e1_;
    const double c = minor_ * std::cos(uv[1]), s = minor_ * std::sin(uv[1]), w = major_ + c;
    return {centre_ + w * out + s * e3_, w * along, -s * out + c * e3_, -w * out, -s * along,
            -c * out - s * e3_};
  }
  UvBox domain() const override { return {{0.0, 0.0}, {2.0 * k_pi, 2.0 * k_pi}}; }
  Vec2 periods() const override { return {2.0 * k_pi, 2.0 * k_pi}; }
  SurfaceFoot closest(const Vec3& x, const std::optional<Vec2>& near) const override {
    const Vec3 r = x - centre_;
    const Vec2 radial(r.dot(e1_), r.dot(e2_));
    const double u = radial.norm() > k_on_axis * major_ ? std::atan2(radial[1], radial[0])
                     : near                             ? (*near)[0]
                                                        : 0.0;
    const Vec2 tube(radial.norm() - major_, r.dot(e3_));  // from the tube's centre
    const double v = tube.norm() > k_on_axis * minor_ ? std::atan2(tube[1], tube[0])
                     : near                           ? (*near)[1]
                                                      : 0.0;
    return foot_at(*this, x, {wrap_period(u, 0.0, 2.0 * k_pi), wrap_period(v, 0.0, 2.0 * k_pi)},
                   0.0);
  }

 private:
  Vec3 centre_, e1_, e2_, e3_;
  double major_, minor_;
};

/// Nearest point of sum (y_k/e_k)^2 = 1, e descending, to z >= 0. y_k = e_k^2 z_k / (e_k^2 + t), t
/// the largest root of sum (e_k z_k/(e_k^2 + t))^2 = 1, above -e_2^2; on the smallest axis' plane
/// inside the evolute y_2 is free instead.
Vec3 nearest_in_octant(const Vec3& e, const Vec3& z) {
  const Vec3 ratio = (e / e[2]).array().square();  // e_k^2 / e_2^2 >= 1
  const auto on_surface = [&](double s) {          // t = s e_2^2 - e_2^2 ... with s > 0
    double sum = -1.0;
    for (int k = 0; k < 3; ++k) {
      if (z[k] == 0.0) continue;
      const double q = ratio[k] * z[k] / (e[k] * (ratio[k] - 1.0 + s));
      sum += q * q;
    }
    return sum;
  };
  const auto point = [&](double s) {
    Vec3 y;
    for (int k = 0; k < 3; ++k) y[k] = z[k] == 0.0 ? 0.0 : ratio[k] * z[k] / (ratio[k] - 1.0 + s);
    return y;
  };
  // The bracket [low, high]: at s = z_2/e_2 the last term alone is 1.
  double low = z[2] / e[2];
  if (low == 0.0) {
    double at_zero = -1.0;
    bool is_pole = false;
    for (int k = 0; k < 2; ++k) {
      if (z[k] == 0.0) continue;
      if (ratio[k] == 1.0)
        is_pole = true;  // as short as the last axis: a root above 0
      else
        at_zero += std::pow(ratio[k] * z[k] / (e[k] * (ratio[k] - 1.0)), 2);
    }
    if (!is_pole && at_zero <= 0.0) {
      Vec3 y;
      for (int k = 0; k < 2; ++k) y[k] = z[k] == 0.0 ? 0.0 : ratio[k] * z[k] / (ratio[k] - 1.0);
      const double rest = 1.0 - std::pow(y[0] / e[0], 2) - std::pow(y[1] / e[1], 2);
      y[2] = e[2] * std::sqrt(std::max(0.0, rest));
      return y;
    }
  }
  double high = (ratio.array() * z.array() / e.array()).matrix().norm();
  for (int iteration = 0; iteration < 1100;
       ++iteration) {  // down to neighbouring numbers, denormals included
    const double middle = 0.5 * (low + high);
    if (middle <= low || middle >= high) break;
    (on_surface(middle) > 0.0 ? low : high) = middle;
  }
  return point(high);
}

class Ellipsoid final : public AnalyticSurface {
 public:
  Ellipsoid(const Vec3& centre, const Vec3& axes) : centre_(centre), axes_(axes) {
    require(axes.allFinite() && axes.minCoeff() > 0.0, "an ellipsoid needs three semi-axes");
    std::iota(order_.begin(), order_.end(), 0);
    std::sort(order_.begin(), order_.end(), [&](int i, int j) { return axes[i] > axes[j]; });
  }
  SurfaceJet jet(const Vec2& uv) const override {
    const double cu = std::cos(uv[0]), su = std::sin(uv[0]), cv = std::cos(uv[1]),
                 sv = std::sin(uv[1]);
    const auto on = [&](double x, double y, double z) -> Vec3 {
      return axes_.cwiseProduct(Vec3(x, y, z));
    };
    return {centre_ + on(cu * cv, su * cv, sv), on(-su * cv, cu * cv, 0.0),
            on(-cu * sv, -su * sv, cv),         on(-cu * cv, -su * cv, 0.0),
            on(su * sv, -cu * sv, 0.0),         on(-cu * cv, -su * cv, -sv)};
  }
  UvBox domain() const override { return {{0.0, -0.5 * k_pi}, {2.0 * k_pi, 0.5 * k_pi}}; }
  Vec2 periods() const override { return {2.0 * k_pi, 0.0}; }
  SurfaceFoot closest(const Vec3& x, const std::optional<Vec2>& near) const override {
    const Vec3 r = x - centre_;
    Vec3 point;
    if (axes_.minCoeff() == axes_.maxCoeff()) {
      point = r.norm() > k_on_axis * axes_[0] ? Vec3(axes_[0] * r.normalized())
                                              : Vec3(jet(near.value_or(Vec2::Zero())).s - centre_);
    } else {
      Vec3 e, z, y;
      for (int k = 0; k < 3; ++k) {
        e[k] = axes_[order_[at(k)]];
        const double z_k = std::abs(r[order_[at(k)]]);
        z[k] = z_k > k_in_plane * e[k] ? z_k : 0.0;
      }
      y = nearest_in_octant(e, z);
      for (int k = 0; k < 3; ++k) point[order_[at(k)]] = std::copysign(y[k], r[order_[at(k)]]);
    }
    const Vec3 unit = point.cwiseQuotient(axes_);
    const double radial = std::hypot(unit[0], unit[1]);
    const double u = radial > k_on_axis ? std::atan2(unit[1], unit[0]) : near ? (*near)[0] : 0.0;
    SurfaceFoot foot =
        foot_at(*this, x, {wrap_period(u, 0.0, 2.0 * k_pi), std::atan2(unit[2], radial)}, 0.0);
    foot.point = centre_ + point;
    foot.distance_squared = (x - foot.point).squaredNorm();
    return foot;
  }

 private:
  Vec3 centre_, axes_;
  std::array<int, 3> order_{};
};

class SplinePatch final : public AnalyticSurface {
 public:
  explicit SplinePatch(BsplineSurface patch)
      : patch_(std::move(patch)), tree_(patch_, patch_.domain()) {}
  SurfaceJet jet(const Vec2& uv) const override { return patch_.jet(uv); }
  UvBox domain() const override { return patch_.domain(); }
  Vec2 periods() const override { return Vec2::Zero(); }
  std::vector<double> breaks(int direction) const override { return patch_.breaks(direction); }
  SurfaceFoot closest(const Vec3& x, const std::optional<Vec2>&) const override {
    SurfaceFoot best;
    tree_.feet(
        x, [&] { return best.distance_squared; },
        [&](const SurfaceFoot& foot) {
          if (foot.distance_squared < best.distance_squared) best = foot;
        });
    return best;
  }

 private:
  BsplineSurface patch_;
  SurfaceTree tree_;
};

}  // namespace

std::unique_ptr<AnalyticSurface> plane_surface(const Vec3& origin, const Vec3& a, const Vec3& b) {
  return std::make_unique<Plane>(origin, a, b);
}

std::unique_ptr<AnalyticSurface> cylinder_surface(const Vec3& base, const Vec3& axis,
                                                  double radius) {
  return std::make_unique<Cylinder>(base, axis, radius);
}

std::unique_ptr<AnalyticSurface> torus_surface(const Vec3& centre, const Vec3& axis, double major,
                                               double minor) {
  return std::make_unique<Torus>(centre, axis, major, minor);
}

std::unique_ptr<AnalyticSurface> ellipsoid_surface(const Vec3& centre, const Vec3& semi_axes) {
  return std::make_unique<Ellipsoid>(centre, semi_axes);
}

std::unique_ptr<AnalyticSurface> bspline_surface(BsplineSurface patch) {
  return std::make_unique<SplinePatch>(std::move(patch));
}

}  // namespace camber
