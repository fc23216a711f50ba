#pragma once
// Local searches: the foot of a point on a surface or curve, the crossing of a line and a surface.
#include <camber/geom/parametric.hpp>

#include <limits>
#include <optional>

namespace camber {

/// End of a local search on a surface.
struct SurfaceFoot {
  Vec2 uv = Vec2::Zero();
  Vec3 point = Vec3::Zero();
  double distance_squared = std::numeric_limits<double>::infinity();
  /// |component of the residual in the tangent plane|: 0 at an orthogonal foot, > 0 where the
  /// limits stopped it.
  double tangential = 0.0;
  bool is_converged = false;
};

/// End of a local search on a curve.
struct CurveFoot {
  double t = 0.0;
  Vec3 point = Vec3::Zero();
  double distance_squared = std::numeric_limits<double>::infinity();
  double tangential = 0.0;
  bool is_converged = false;
};

/// Minimises |S(u,v) - x|^2 from `start` by Newton's method within `limits`, never going up; a
/// direction that is periodic has no limits. Where the Hessian is not positive its
/// eigenvalues are reflected; where a derivative vanishes (poles) its parameter rests.
/// @param size  length of the surface, unit of the stopping test: steps below 1e-12 size
/// Cost: 3 to 5 jets from a good start. Reentrant, no allocation.
[[nodiscard]] SurfaceFoot find_foot(const ParametricSurface& surface, const Vec3& x,
                                    const Vec2& start, const UvBox& limits, double size);

/// The same for the line x + s d (d unit): minimises the distance from S to the line; a crossing
/// has distance_squared ~ 0.
[[nodiscard]] SurfaceFoot find_line_foot(const ParametricSurface& surface, const Vec3& x,
                                         const Vec3& d, const Vec2& start, const UvBox& limits,
                                         double size);

/// The same for a curve on [first, last] (no limits if it is closed).
[[nodiscard]] CurveFoot find_foot(const ParametricCurve& curve, const Vec3& x, double start,
                                  double first, double last, double size);

}  // namespace camber
