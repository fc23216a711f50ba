#pragma once
// What the searches of this module need to know of a surface or curve: values and derivatives.
#include <camber/base/vec.hpp>

#include <vector>

namespace camber {

/// Point of a surface with its first and second derivatives.
struct SurfaceJet {
  Vec3 s, su, sv, suu, suv, svv;
};

/// Point of a curve with its first and second derivatives.
struct CurveJet {
  Vec3 c, ct, ctt;
};

/// Rectangle of surface parameters.
struct UvBox {
  Vec2 lower = Vec2::Zero();
  Vec2 upper = Vec2::Ones();
};

/// A parametrised surface over a rectangle, at least C1 inside each cell of its breaks.
/// Const calls are safe from many threads at once and depend on nothing but their arguments.
class ParametricSurface {
 public:
  virtual ~ParametricSurface() = default;
  /// S and its derivatives at uv; any u (v) is allowed in a periodic direction.
  [[nodiscard]] virtual SurfaceJet jet(const Vec2& uv) const = 0;
  [[nodiscard]] virtual UvBox domain() const = 0;
  /// Period in u and v; 0: not periodic.
  [[nodiscard]] virtual Vec2 periods() const = 0;
  /// Sorted parameters of direction 0 (u) or 1 (v) from end to end of the domain between which the
  /// surface is smooth (knots); at least the two ends.
  [[nodiscard]] virtual std::vector<double> breaks(int direction) const = 0;
};

/// A parametrised curve over a range; the same promises as ParametricSurface.
class ParametricCurve {
 public:
  virtual ~ParametricCurve() = default;
  [[nodiscard]] virtual CurveJet jet(double t) const = 0;
  [[nodiscard]] virtual double first() const = 0;
  [[nodiscard]] virtual double last() const = 0;
  /// last - first if the curve is closed (then any t is allowed), else 0.
  [[nodiscard]] virtual double period() const = 0;
  /// Sorted parameters from first to last between which the curve is smooth.
  [[nodiscard]] virtual std::vector<double> breaks() const = 0;
};

/// `value` moved by whole periods into the period centred at `near`; unchanged if period is 0.
[[nodiscard]] double nearest_period(double value, double near, double period);

/// `value` moved by whole periods into [first, first + period); unchanged if period is 0.
[[nodiscard]] double wrap_period(double value, double first, double period);

/// Unit normal su x sv at uv; at a singular point (pole) its limit from inside the limits, zero if
/// that depends on the direction (the tip of a cone).
[[nodiscard]] Vec3 unit_normal(const ParametricSurface& surface, const UvBox& limits,
                               const Vec2& uv, const SurfaceJet& jet);

}  // namespace camber
