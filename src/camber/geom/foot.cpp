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
constexpr double k_smallest_step = 1e-14;
// A derivative this much shorter than the other one, per parameter range, is a pole.
constexpr double k_vanishing = 1e-12;
// Eigenvalues of the scaled Hessian (1 near the surface) below this part of the larger one are
// raised to it.
constexpr double k_least_curvature = 1e-3;
// Round-off of a point, relative to the coordinates that it was computed from.
constexpr double k_noise = 1e-15;

/// Growth of a squared distance that round-off of its points explains.
struct Noise {
  Noise(const Vec3& x, double size) : point(k_noise * (size + x.norm())) {}
  double operator()(double squared) const { return point * (std::sqrt(squared) + point); }
  double point;
};

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

/// Newton step with the Hessian's eigenvalues, taken in arc length units, replaced by their size: a
/// descent direction where the Hessian is indefinite.
Vec2 reflected_step(const Vec2& gradient, double Hu, double Hm, double Hv, double E, double G) {
  const Vec2 unit(1.0 / std::sqrt(E), 1.0 / std::sqrt(G));
  const double a = Hu * unit[0] * unit[0], b = Hm * unit[0] * unit[1], c = Hv * unit[1] * unit[1];
  const Vec2 g = gradient.cwiseProduct(unit);
  const double angle = 0.5 * std::atan2(2.0 * b, a - c);  // of the first eigenvector
  const Vec2 v(std::cos(angle), std::sin(angle)), w(-v[1], v[0]);
  const double lv = std::abs(a * v[0] * v[0] + 2.0 * b * v[0] * v[1] + c * v[1] * v[1]);
  const double lw = std::abs(a * w[0] * w[0] + 2.0 * b * w[0] * w[1] + c * w[1] * w[1]);
  const double floor = k_least_curvature * std::max({lv, lw, 1.0});
  const Vec2 step = -(g.dot(v) / std::max(lv, floor)) * v - (g.dot(w) / std::max(lw, floor)) * w;
  return step.cwiseProduct(unit);
}

/// Descent step of the quadratic model; a parameter pressed against its limit stays.
template <class Across>
Step model_step(const Local& l, const Across& across, const Vec2& uv, const UvBox& limits,
                const Vec2& periods) {
  const Vec3 a = across(l.jet.su), b = across(l.jet.sv);
  const Vec2 gradient(l.r.dot(a), l.r.dot(b));
  const Vec2 range = limits.upper - limits.lower;
  const double E = a.squaredNorm(), F = a.dot(b), G = b.squaredNorm();
  const double su = E * range[0] * range[0], sv = G * range[1] * range[1];
  bool is_free[2] = {su > k_vanishing * k_vanishing * sv, sv > k_vanishing * k_vanishing * su};
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
      step.uv = reflected_step(gradient, Hu, Hm, Hv, E, G);
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
  const Noise noise(x, size);
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
    const double before = local.f;
    for (; halvings <= k_max_halvings && !is_down; ++halvings) {
      const Vec2 trial = uv + move;
      const Local next = evaluate(surface, x, trial, across);
      if (next.f <= local.f + noise(local.f)) {
        is_down = true;
        uv = trial;
        local = next;
      } else {
        move *= 0.5;
      }
    }
    const bool is_short = length < k_quadratic_step * size;
    const bool is_noise = is_short && local.f >= before;
    if (!is_down || is_noise || (is_short && step.is_newton && halvings == 1)) {
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
  const Noise noise(x, size);
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
    const double before = f;
    for (; halvings <= k_max_halvings && !is_down; ++halvings) {
      const CurveJet next = curve.jet(t + move);
      const Vec3 next_r = next.c - x;
      if (next_r.squaredNorm() <= f + noise(f)) {
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
    const bool is_noise = is_short && f >= before;
    if (!is_down || is_noise || (is_short && is_newton && halvings == 1)) {
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
