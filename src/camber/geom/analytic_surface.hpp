#pragma once
// Surfaces with a closed-form closest point.
#include <camber/geom/bspline.hpp>
#include <camber/geom/foot.hpp>
#include <camber/geom/parametric.hpp>

#include <memory>
#include <optional>

namespace camber {

/// A surface that knows its nearest point to any x exactly (to round-off), also where it is not
/// unique: then the one at the parameters of `near` is taken, or at the start of the period.
class AnalyticSurface : public ParametricSurface {
 public:
  /// tangential is 0 for an orthogonal foot and > 0 if the nearest point is on the surface's
  /// border.
  [[nodiscard]] virtual SurfaceFoot closest(const Vec3& x,
                                            const std::optional<Vec2>& near) const = 0;
  [[nodiscard]] virtual bool is_planar() const { return false; }
  /// One whole span a direction unless the surface says otherwise.
  [[nodiscard]] std::vector<double> breaks(int direction) const override {
    return {domain().lower[direction], domain().upper[direction]};
  }
};

/// S = origin + u a + v b, 0 <= u, v <= 1; a and b at right angles.
[[nodiscard]] std::unique_ptr<AnalyticSurface> plane_surface(const Vec3& origin, const Vec3& a,
                                                             const Vec3& b);

/// S = base + radius (cos u e1 + sin u e2) + v axis, 0 <= v <= 1; e1, e2 orthonormal across the
/// axis.
[[nodiscard]] std::unique_ptr<AnalyticSurface> cylinder_surface(const Vec3& base, const Vec3& axis,
                                                                double radius);

/// S = centre + (major + minor cos v)(cos u e1 + sin u e2) + minor sin v e3, e3 = axis/|axis|,
/// major > minor.
[[nodiscard]] std::unique_ptr<AnalyticSurface> torus_surface(const Vec3& centre, const Vec3& axis,
                                                             double major, double minor);

/// S = centre + (a cos u cos v, b sin u cos v, c sin v), -pi/2 <= v <= pi/2. A sphere if a = b = c.
/// closest: the root of the secular equation by bisection. Source: [eberly2013].
[[nodiscard]] std::unique_ptr<AnalyticSurface> ellipsoid_surface(const Vec3& centre,
                                                                 const Vec3& semi_axes);

/// closest by a global search over nearly flat patches.
[[nodiscard]] std::unique_ptr<AnalyticSurface> bspline_surface(BsplineSurface patch);

}  // namespace camber
