#include <camber/base/error.hpp>
#include <camber/base/ids.hpp>
#include <camber/geom/bspline.hpp>

#include <algorithm>

namespace camber {
namespace {

std::vector<Eigen::Vector4d> homogeneous(std::span<const Vec3> poles,
                                         std::span<const double> weights) {
  std::vector<Eigen::Vector4d> result(poles.size());
  for (std::size_t i = 0; i < poles.size(); ++i) {
    const double w = weights.empty() ? 1.0 : weights[i];
    result[i] << w * poles[i], w;
  }
  return result;
}

void check_poles(std::size_t poles, std::size_t weights, std::size_t expected) {
  if (poles != expected || (weights != 0 && weights != poles))
    throw GeometryError("B-spline with " + std::to_string(poles) + " poles and " +
                            std::to_string(weights) + " weights where its knots ask for " +
                            std::to_string(expected),
                        "B-spline", "check the CAD file");
}

}  // namespace

BsplineBasis::BsplineBasis(int degree, std::vector<double> knots)
    : degree_(degree), knots_(std::move(knots)) {
  const std::size_t p = degree > 0 ? at(degree) : 0;
  if (degree < 1 || degree > k_max_bspline_degree || knots_.size() < 2 * (p + 1) ||
      !std::is_sorted(knots_.begin(), knots_.end()) || !(first() < last()))
    throw GeometryError("degree and knots of a B-spline do not fit together", "B-spline",
                        "check the CAD file");
}

std::vector<double> BsplineBasis::breaks(double lower, double upper) const {
  std::vector<double> result{lower};
  for (const double t : knots_)
    if (t > result.back() && t < upper) result.push_back(t);
  result.push_back(upper);
  return result;
}

int BsplineBasis::first_pole(double t) const {
  const auto begin = knots_.begin() + degree_;
  const auto end = knots_.end() - degree_ - 1;  // last()
  // Spans start at the last of equal knots; beyond the ends the first and last true span serve.
  const double inside = t < last() ? std::max(t, first()) : last();
  const auto above = inside < last() ? std::upper_bound(begin, end + 1, inside)
                                     : std::lower_bound(begin, end + 1, inside);
  return static_cast<int>(above - begin) - 1;
}

void BsplineBasis::evaluate(int first_pole, double t, Values& values) const {
  double* n = values.n;
  double* dn = values.dn;
  double* ddn = values.ddn;
  const double* knot = knots_.data() + first_pole + degree_;  // the span is [knot[0], knot[1])
  n[0] = 1.0;
  dn[0] = ddn[0] = 0.0;
  for (int k = 1; k <= degree_; ++k) {
    double carried = 0.0, d_carried = 0.0, dd_carried = 0.0;
    for (int r = 0; r < k; ++r) {
      const double low = knot[1 - k + r], high = knot[1 + r];
      const double inverse = 1.0 / (high - low);
      const double a = n[r] * inverse, da = dn[r] * inverse, dda = ddn[r] * inverse;
      const double right = high - t, left = t - low;
      n[r] = carried + right * a;
      dn[r] = d_carried + right * da - a;
      ddn[r] = dd_carried + right * dda - 2.0 * da;
      carried = left * a;
      d_carried = left * da + a;
      dd_carried = left * dda + 2.0 * da;
    }
    n[k] = carried;
    dn[k] = d_carried;
    ddn[k] = dd_carried;
  }
}

BsplineCurve::BsplineCurve(BsplineBasis basis, std::span<const Vec3> poles,
                           std::span<const double> weights)
    : basis_(std::move(basis)),
      poles_(homogeneous(poles, weights)),
      is_rational_(!weights.empty()) {
  check_poles(poles.size(), weights.size(), at(basis_.pole_count()));
}

CurveJet BsplineCurve::jet(double t) const {
  BsplineBasis::Values values;
  const int start = basis_.first_pole(t);
  basis_.evaluate(start, t, values);
  Eigen::Vector4d c = Eigen::Vector4d::Zero(), ct = c, ctt = c;
  for (int i = 0; i <= basis_.degree(); ++i) {
    const Eigen::Vector4d& pole = poles_[at(start + i)];
    c += values.n[i] * pole;
    ct += values.dn[i] * pole;
    ctt += values.ddn[i] * pole;
  }
  CurveJet jet{c.head<3>(), ct.head<3>(), ctt.head<3>()};
  if (is_rational_) {  // quotient rule, (C w)' = C' w + C w'
    const double inverse = 1.0 / c[3];
    jet.c *= inverse;
    jet.ct = (jet.ct - ct[3] * jet.c) * inverse;
    jet.ctt = (jet.ctt - 2.0 * ct[3] * jet.ct - ctt[3] * jet.c) * inverse;
  }
  return jet;
}

BsplineSurface::BsplineSurface(BsplineBasis u_basis, BsplineBasis v_basis,
                               std::span<const Vec3> poles, std::span<const double> weights)
    : u_basis_(std::move(u_basis)),
      v_basis_(std::move(v_basis)),
      poles_(homogeneous(poles, weights)),
      is_rational_(!weights.empty()) {
  check_poles(poles.size(), weights.size(), at(u_basis_.pole_count()) * at(v_basis_.pole_count()));
}

SurfaceJet BsplineSurface::jet(const Vec2& uv) const {
  using Vec4 = Eigen::Vector4d;
  BsplineBasis::Values u, v;
  const int u_start = u_basis_.first_pole(uv[0]), v_start = v_basis_.first_pole(uv[1]);
  u_basis_.evaluate(u_start, uv[0], u);
  v_basis_.evaluate(v_start, uv[1], v);
  Vec4 s = Vec4::Zero(), su = s, sv = s, suu = s, suv = s, svv = s;
  for (int i = 0; i <= u_basis_.degree(); ++i) {
    const Vec4* row = poles_.data() + (u_start + i) * v_basis_.pole_count() + v_start;
    Vec4 c = Vec4::Zero(), cv = c, cvv = c;  // the curve of poles in v
    for (int j = 0; j <= v_basis_.degree(); ++j) {
      c += v.n[j] * row[j];
      cv += v.dn[j] * row[j];
      cvv += v.ddn[j] * row[j];
    }
    s += u.n[i] * c;
    su += u.dn[i] * c;
    sv += u.n[i] * cv;
    suu += u.ddn[i] * c;
    suv += u.dn[i] * cv;
    svv += u.n[i] * cvv;
  }
  SurfaceJet jet{s.head<3>(),   su.head<3>(),  sv.head<3>(),
                 suu.head<3>(), suv.head<3>(), svv.head<3>()};
  if (is_rational_) {
    const double inverse = 1.0 / s[3];
    jet.s *= inverse;
    jet.su = (jet.su - su[3] * jet.s) * inverse;
    jet.sv = (jet.sv - sv[3] * jet.s) * inverse;
    jet.suu = (jet.suu - 2.0 * su[3] * jet.su - suu[3] * jet.s) * inverse;
    jet.suv = (jet.suv - su[3] * jet.sv - sv[3] * jet.su - suv[3] * jet.s) * inverse;
    jet.svv = (jet.svv - 2.0 * sv[3] * jet.sv - svv[3] * jet.s) * inverse;
  }
  return jet;
}

UvBox BsplineSurface::domain() const {
  return {{u_basis_.first(), v_basis_.first()}, {u_basis_.last(), v_basis_.last()}};
}

std::vector<double> BsplineSurface::breaks(int direction) const {
  const BsplineBasis& b = basis(direction);
  return b.breaks(b.first(), b.last());
}

}  // namespace camber
