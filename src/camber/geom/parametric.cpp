#include <camber/geom/parametric.hpp>

#include <algorithm>
#include <cmath>

namespace camber {
namespace {

/// A cross product shorter than this part of its factors' square has lost its direction.
constexpr double k_no_normal = 1e-9;
/// Step from a singular point into the surface, as a part of the parameter range.
constexpr double k_inwards = 1e-4;
/// Normals around a regular pole agree to the order of that step times the turning of the surface.
constexpr double k_same_direction = 0.999;

/// su x sv normalised; zero if there is no direction.
Vec3 regular_normal(const SurfaceJet& jet, const Vec2& range) {
  const Vec3 a = jet.su * range[0], b = jet.sv * range[1];
  const Vec3 n = a.cross(b);
  const double length = n.norm(), scale = std::max(a.squaredNorm(), b.squaredNorm());
  return length > k_no_normal * scale ? Vec3(n / length) : Vec3::Zero();
}

}  // namespace

Vec3 unit_normal(const ParametricSurface& surface, const UvBox& limits, const Vec2& uv,
                 const SurfaceJet& jet) {
  const Vec2 range = limits.upper - limits.lower;
  const Vec3 direct = regular_normal(jet, range);
  if (direct != Vec3::Zero()) return direct;
  // Around the pole: at four places along the collapsed direction, two nearby and their difference
  // gives the limit to second order.
  const int across = jet.su.norm() * range[0] < jet.sv.norm() * range[1] ? 1 : 0;
  const double middle = 0.5 * (limits.lower[across] + limits.upper[across]);
  const double step = (uv[across] < middle ? k_inwards : -k_inwards) * range[across];
  Vec3 sum = Vec3::Zero(), first = Vec3::Zero();
  for (int i = 0; i < 4; ++i) {
    Vec2 near = uv, far = uv;
    near[1 - across] = far[1 - across] =
        limits.lower[1 - across] + (0.125 + 0.25 * i) * range[1 - across];
    near[across] += step;
    far[across] += 2.0 * step;
    const Vec3 a = regular_normal(surface.jet(near), range),
               b = regular_normal(surface.jet(far), range);
    const Vec3 limit = (2.0 * a - b).normalized();
    if (a == Vec3::Zero() || b == Vec3::Zero()) return Vec3::Zero();
    if (i == 0) first = limit;
    if (limit.dot(first) < k_same_direction) return Vec3::Zero();
    sum += limit;
  }
  return sum.normalized();
}

double nearest_period(double value, double near, double period) {
  if (period <= 0.0) return value;
  return value - period * std::round((value - near) / period);
}

double wrap_period(double value, double first, double period) {
  if (period <= 0.0 || (value >= first && value < first + period)) return value;
  const double wrapped = value - period * std::floor((value - first) / period);
  return wrapped < first + period ? wrapped : first;  // floor's round-off
}

}  // namespace camber
