#include <camber/geom/curve_tree.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace camber {
namespace {

constexpr int k_curve_depth = 16;
constexpr double k_straight_cosine = 0.9;
// Halving a piece must not change its length by more than this part of the curve.
constexpr double k_length_error = 2e-15;
// Pieces shorter than this part of the curve may turn as they like.
constexpr double k_short_piece = 1e-4;
constexpr double k_length_round_off = 2e-16;
constexpr std::size_t k_points = 8;

struct GaussRule {
  std::array<double, k_points> x, w;  // on [-1, 1]
};

/// Gauss-Legendre rule: roots of P_n by Newton's method, w = 2 / ((1 - x^2) P_n'(x)^2).
GaussRule make_rule() {
  GaussRule rule{};
  constexpr double n = static_cast<double>(k_points);
  for (std::size_t i = 0; i < k_points; ++i) {
    double x = std::cos(std::numbers::pi * (static_cast<double>(i) + 0.75) / (n + 0.5));
    double slope = 1.0;
    for (int iteration = 0; iteration < 10; ++iteration) {
      double p0 = 1.0, p1 = x;
      for (std::size_t k = 2; k <= k_points; ++k) {
        const double m = static_cast<double>(k);
        const double p2 = ((2.0 * m - 1.0) * x * p1 - (m - 1.0) * p0) / m;
        p0 = p1;
        p1 = p2;
      }
      slope = n * (x * p1 - p0) / (x * x - 1.0);
      x -= p1 / slope;
    }
    rule.x[i] = x;
    rule.w[i] = 2.0 / ((1.0 - x * x) * slope * slope);
  }
  return rule;
}

const GaussRule& rule() {
  static const GaussRule result = make_rule();
  return result;
}

}  // namespace

CurveTree::CurveTree(const ParametricCurve& curve) : curve_(curve) {
  const std::vector<double> breaks = curve.breaks();
  double rough = 0.0;
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) rough += stretch(breaks[i], breaks[i + 1]);
  for (std::size_t i = 0; i + 1 < breaks.size(); ++i) split(breaks[i], breaks[i + 1], rough, 0);
  std::vector<Box> boxes;
  double before = 0.0;
  for (Piece& piece : pieces_) {
    piece.length_before = before;
    before += piece.length;
    const Vec3 a = curve.jet(piece.t0).c, b = curve.jet(0.5 * (piece.t0 + piece.t1)).c;
    const Vec3 c = curve.jet(piece.t1).c;
    Box box;
    box.add(a);
    box.add(b);
    box.add(c);
    const double bulge = 0.5 * (a - 2.0 * b + c).norm();  // four times the sagitta of a half piece
    box.lower.array() -= bulge;
    box.upper.array() += bulge;
    boxes.push_back(box);
    box_.add(box);
  }
  size_ = box_.diagonal();
  tree_ = BoxTree(std::move(boxes));
}

void CurveTree::split(double t0, double t1, double rough, int depth) {
  const double middle = 0.5 * (t0 + t1);
  const CurveJet a = curve_.jet(t0), m = curve_.jet(middle), b = curve_.jet(t1);
  const auto cosine = [](const Vec3& p, const Vec3& q) {
    const double l = p.norm() * q.norm();
    return l > 0.0 ? p.dot(q) / l : 1.0;
  };
  const double whole = stretch(t0, t1), halves = stretch(t0, middle) + stretch(middle, t1);
  const bool is_straight =
      cosine(a.ct, m.ct) > k_straight_cosine && cosine(m.ct, b.ct) > k_straight_cosine;
  const bool is_exact = std::abs(whole - halves) <= k_length_error * rough;
  if ((!is_exact || (!is_straight && halves > k_short_piece * rough)) && depth < k_curve_depth) {
    split(t0, middle, rough, depth + 1);
    split(middle, t1, rough, depth + 1);
    return;
  }
  pieces_.push_back({t0, t1, 0.0, halves});
}

double CurveTree::stretch(double t0, double t1) const {
  const double half = 0.5 * (t1 - t0), middle = 0.5 * (t0 + t1);
  double sum = 0.0;
  for (std::size_t i = 0; i < k_points; ++i)
    sum += rule().w[i] * curve_.jet(middle + half * rule().x[i]).ct.norm();
  return half * sum;
}

std::optional<CurveFoot> CurveTree::nearest(const Vec3& x, double bound) const {
  std::optional<CurveFoot> best;
  double best_squared = bound;
  const auto take = [&](const CurveFoot& foot) {
    if (!(foot.distance_squared < best_squared)) return;
    best_squared = foot.distance_squared;
    best = foot;
  };
  tree_.nearest(
      x, [&] { return best_squared; },
      [&](int i) {
        const Piece& piece = pieces_[at(i)];
        const Vec3 a = curve_.jet(piece.t0).c, chord = curve_.jet(piece.t1).c - a;
        const double squared = chord.squaredNorm();
        const double s = squared > 0.0 ? std::clamp((x - a).dot(chord) / squared, 0.0, 1.0) : 0.5;
        take(find_foot(curve_, x, piece.t0 + s * (piece.t1 - piece.t0), curve_.first(),
                       curve_.last(), size_));
      });
  return best;
}

double CurveTree::length_to(double t) const {
  double turns = 0.0;
  if (curve_.period() > 0.0) {
    const double wrapped = wrap_period(t, curve_.first(), curve_.period());
    turns = std::round((t - wrapped) / curve_.period());
    t = wrapped;
  }
  auto piece = std::upper_bound(pieces_.begin(), pieces_.end(), t,
                                [](double value, const Piece& p) { return value < p.t1; });
  if (piece == pieces_.end()) --piece;
  // The shorter of the two parts is integrated.
  const bool is_early = t - piece->t0 < piece->t1 - t;
  const double inside = is_early ? stretch(piece->t0, t) : piece->length - stretch(t, piece->t1);
  return turns * length() + piece->length_before + inside;
}

double CurveTree::parameter_at(double target) const {
  double turns = 0.0;
  const double whole = length();
  if (curve_.period() > 0.0) {
    turns = std::floor(target / whole);
    target -= turns * whole;
  }
  auto piece = std::upper_bound(
      pieces_.begin(), pieces_.end(), target,
      [](double value, const Piece& p) { return value < p.length_before + p.length; });
  if (piece == pieces_.end()) --piece;
  const double wanted = target - piece->length_before;
  double low = piece->t0, high = piece->t1;
  double t =
      low + (high - low) * std::clamp(piece->length > 0.0 ? wanted / piece->length : 0.5, 0.0, 1.0);
  for (int iteration = 0; iteration < 60; ++iteration) {
    const double error = stretch(piece->t0, t) - wanted;
    if (std::abs(error) <= k_length_round_off * whole) break;
    (error > 0.0 ? high : low) = t;
    const double speed = curve_.jet(t).ct.norm();
    const double newton = speed > 0.0 ? t - error / speed : low;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (next == t) break;
    t = next;
  }
  return t + turns * curve_.period();
}

}  // namespace camber
