#include <camber/geom/foot.hpp>

#include <algorithm>
#include <cmath>

namespace camber {
namespace {

constexpr int k_max_steps = 40;
constexpr int k_max_halvings = 12;
// A full Newton step shorter than this (of the size) leaves an error of its square.
constexpr double k_quadratic_step = 1e-8;
// Steps below this (of the size) are round-off of the evaluation.
constexpr double k_smallest_step = 1e-13;
// A derivative this much shorter than the other one, per parameter range, is a pole.
constexpr double k_singular = 1e-12;
// Growth of the squared distance that round-off explains.
constexpr double k_round_off = 1e-15;

/// Residual and derivatives as the search sees them: whole, or projected across a direction.
struct Local {
  SurfaceJet jet;
  Vec3 r;
  double f;  // |r|^2
};

template <class Across>
Local evaluate(const ParametricSurface& surface, const Vec3& x, const Vec2& uv,
               const Across& across) {
  Local local;
  local.jet = surface.jet(uv);
  local.r = across(Vec3(local.jet.s - x));
  local.f = local.r.squaredNorm();
  return local;
}

struct Step {
  Vec2 uv = Vec2::Zero();
  double tangential = 0.0;
  bool is_newton = false;
};

/// Descent step of the quadratic model; a parameter pressed against its limit stays.
template <class Across>
Step model_step(const Local& l, const Across& across, const Vec2& uv, const UvBox& limits,
                const Vec2& periods) {
  const Vec3 a = across(l.jet.su), b = across(l.jet.sv);
  const Vec2 gradient(l.r.dot(a), l.r.dot(b));
  const Vec2 range = limits.upper - limits.lower;
  double E = a.squaredNorm(), F = a.dot(b), G = b.squaredNorm();
  const double su = E * range[0] * range[0], sv = G * range[1] * range[1];
  bool is_free[2] = {su > k_singular * k_singular * sv, sv > k_singular * k_singular * su};
  for (int k = 0; k < 2; ++k) {
    if (periods[k] > 0.0) continue;
    if ((uv[k] <= limits.lower[k] && gradient[k] >= 0.0) ||
        (uv[k] >= limits.upper[k] && gradient[k] <= 0.0))
      is_free[k] = false;
  }
  const double Hu = E + l.r.dot(l.jet.suu), Hm = F + l.r.dot(l.jet.suv),
               Hv = G + l.r.dot(l.jet.svv);
  Step step;
  const double tu = E > 0.0 ? gradient[0] / std::sqrt(E) : 0.0;
  const double tv = G > 0.0 ? gradient[1] / std::sqrt(G) : 0.0;
  step.tangential = std::max(std::abs(tu), std::abs(tv));
  if (is_free[0] && is_free[1]) {
    const double det = Hu * Hv - Hm * Hm;
    if (Hu > 0.0 && Hv > 0.0 && det > 1e-6 * Hu * Hv) {
      step.uv =
          -Vec2(Hv * gradient[0] - Hm * gradient[1], Hu * gradient[1] - Hm * gradient[0]) / det;
      step.is_newton = true;
    } else {
      const double damping = 1e-3;  // of Levenberg and Marquardt, relative to the diagonal
      E *= 1.0 + damping;
      G *= 1.0 + damping;
      step.uv = -Vec2(G * gradient[0] - F * gradient[1], E * gradient[1] - F * gradient[0]) /
                (E * G - F * F);
    }
  } else {
    for (int k = 0; k < 2; ++k) {
      if (!is_free[k]) continue;
      const double h = k == 0 ? Hu : Hv, metric = k == 0 ? E : G;
      step.is_newton = h > 1e-3 * metric;
      step.uv[k] = -gradient[k] / (step.is_newton ? h : metric);
    }
  }
  return step;
}

template <class Across>
SurfaceFoot descend(const ParametricSurface& surface, const Vec3& x, const Vec2& start,
                    const UvBox& limits, double size, const Across& across) {
  const Vec2 periods = surface.periods();
  const auto inside = [&](Vec2 uv) {
    for (int k = 0; k < 2; ++k)
      if (periods[k] <= 0.0) uv[k] = std::clamp(uv[k], limits.lower[k], limits.upper[k]);
    return uv;
  };
  Vec2 uv = inside(start);
  Local local = evaluate(surface, x, uv, across);
  SurfaceFoot foot;
  for (int iteration = 0; iteration < k_max_steps; ++iteration) {
    const Step step = model_step(local, across, uv, limits, periods);
    foot.tangential = step.tangential;
    Vec2 move = inside(uv + step.uv) - uv;
    const double length = across(Vec3(local.jet.su * move[0] + local.jet.sv * move[1])).norm();
    if (!(length > k_smallest_step * size)) {
      foot.is_converged = std::isfinite(length);
      break;
    }
    bool is_down = false;
    int halvings = 0;
    for (; halvings <= k_max_halvings && !is_down; ++halvings) {
      const Vec2 trial = uv + move;
      const Local next = evaluate(surface, x, trial, across);
      if (next.f <= local.f * (1.0 + k_round_off) + k_round_off * k_round_off * size * size) {
        is_down = true;
        uv = trial;
        local = next;
      } else {
        move *= 0.5;
      }
    }
    const bool is_short = length < k_quadratic_step * size;
    if (!is_down || (is_short && step.is_newton && halvings == 1)) {
      foot.is_converged = is_short;  // short and not down: at the round-off of the distance
      foot.tangential = model_step(local, across, uv, limits, periods).tangential;
      break;
    }
  }
  foot.uv = uv;
  foot.point = local.jet.s;
  foot.distance_squared = local.f;
  return foot;
}

}  // namespace

SurfaceFoot find_foot(const ParametricSurface& surface, const Vec3& x, const Vec2& start,
                      const UvBox& limits, double size) {
  return descend(surface, x, start, limits, size, [](const Vec3& v) { return v; });
}

SurfaceFoot find_line_foot(const ParametricSurface& surface, const Vec3& x, const Vec3& d,
                           const Vec2& start, const UvBox& limits, double size) {
  return descend(surface, x, start, limits, size,
                 [&](const Vec3& v) -> Vec3 { return v - v.dot(d) * d; });
}

CurveFoot find_foot(const ParametricCurve& curve, const Vec3& x, double start, double first,
                    double last, double size) {
  const bool is_closed = curve.period() > 0.0;
  const auto inside = [&](double t) { return is_closed ? t : std::clamp(t, first, last); };
  double t = inside(start);
  CurveJet jet = curve.jet(t);
  Vec3 r = jet.c - x;
  double f = r.squaredNorm();
  CurveFoot foot;
  for (int iteration = 0; iteration < k_max_steps; ++iteration) {
    const double gradient = r.dot(jet.ct), metric = jet.ct.squaredNorm();
    const double hessian = metric + r.dot(jet.ctt);
    foot.tangential = metric > 0.0 ? std::abs(gradient) / std::sqrt(metric) : 0.0;
    const bool is_newton = hessian > 1e-3 * metric;
    const double step = metric > 0.0 ? -gradient / (is_newton ? hessian : metric) : 0.0;
    double move = inside(t + step) - t;
    const double length = std::abs(move) * std::sqrt(metric);
    if (!(length > k_smallest_step * size)) {
      foot.is_converged = std::isfinite(length);
      break;
    }
    bool is_down = false;
    int halvings = 0;
    for (; halvings <= k_max_halvings && !is_down; ++halvings) {
      const CurveJet next = curve.jet(t + move);
      const Vec3 next_r = next.c - x;
      if (next_r.squaredNorm() <=
          f * (1.0 + k_round_off) + k_round_off * k_round_off * size * size) {
        is_down = true;
        t += move;
        jet = next;
        r = next_r;
        f = r.squaredNorm();
      } else {
        move *= 0.5;
      }
    }
    const bool is_short = length < k_quadratic_step * size;
    if (!is_down || (is_short && is_newton && halvings == 1)) {
      foot.is_converged = is_short;
      const double speed = jet.ct.norm();
      foot.tangential = speed > 0.0 ? std::abs(r.dot(jet.ct)) / speed : 0.0;
      break;
    }
  }
  foot.t = t;
  foot.point = jet.c;
  foot.distance_squared = f;
  return foot;
}

}  // namespace camber
