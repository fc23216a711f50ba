#include <camber/reconstruct/detail/local_fit.hpp>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace camber::detail {
namespace {

/// Equations for every coefficient; with fewer the fit swings between its points.
constexpr double k_overdetermined = 1.25;
/// Smallest singular value, in parts of the largest, by degree: below it the points lie nearly on a
/// curve of that degree, and the fit is free to swing between. Half of what a square grid gives at
/// its corner: 0.1, 0.016, 0.0019.
constexpr std::array<double, k_fit_degree + 1> k_least_singular{0.0, 0.0, 0.05, 8e-3, 1e-3};
/// Points whose height is more than this share of their distance are on a flank, not near.
constexpr double k_steepest = 0.9;

/// Share of the first ring's largest height by which a fit misses one of its points: good enough to
/// look no further; too much for any fit, better flat.
constexpr double k_good_miss = 0.1, k_tolerated_miss = 0.25;

/// Of curves: points that are not nearly the same.
constexpr double k_least_singular_curve = 1e-5;

int coefficient_count(int degree) { return (degree + 1) * (degree + 2) / 2 - 1; }

/// Monomials a^j b^k, 1 <= j + k <= degree, by rising j + k.
template <class Out>
void monomials(int degree, double a, double b, Out&& out) {
  int i = 0;
  std::array<double, k_fit_degree + 1> pa, pb;
  pa[0] = pb[0] = 1.0;
  for (std::size_t k = 1; k < pa.size(); ++k) {
    pa[k] = pa[k - 1] * a;
    pb[k] = pb[k - 1] * b;
  }
  for (int sum = 1; sum <= degree; ++sum) {
    for (int k = 0; k <= sum; ++k) {
      out(i++, pa[static_cast<std::size_t>(sum - k)] * pb[static_cast<std::size_t>(k)]);
    }
  }
}

double weight_of(double distance_squared, double mean_squared) {
  return 1.0 / (0.1 + distance_squared / mean_squared);
}

/// Least squares solution, or nothing if the columns are not independent enough.
std::optional<MatX> solve(const MatX& A, const MatX& b, double least_singular) {
  VecX scale = A.colwise().norm();
  for (Eigen::Index c = 0; c < scale.size(); ++c) {
    if (!(scale[c] > 0.0)) return {};
  }
  const MatX scaled = A * scale.cwiseInverse().asDiagonal();
  const Eigen::SelfAdjointEigenSolver<MatX> gram(scaled.transpose() * scaled,
                                                 Eigen::EigenvaluesOnly);
  const VecX& squares = gram.eigenvalues();  // ascending
  if (squares[0] < least_singular * least_singular * squares[squares.size() - 1]) return {};
  MatX x = scaled.householderQr().solve(b);
  for (Eigen::Index c = 0; c < scale.size(); ++c) x.row(c) /= scale[c];
  return x;
}

/// A neighbour in the plane of a fit, scaled.
struct Row {
  double a, b, height, weight;
  bool is_nearest;
};

std::optional<VecX> fit_heights(int degree, std::span<const Row> rows) {
  MatX A(static_cast<Eigen::Index>(rows.size()), coefficient_count(degree)), b(A.rows(), 1);
  for (Eigen::Index r = 0; r < A.rows(); ++r) {
    const Row& row = rows[static_cast<std::size_t>(r)];
    monomials(degree, row.a, row.b, [&](int i, double value) { A(r, i) = row.weight * value; });
    b(r, 0) = row.weight * row.height;
  }
  const std::optional<MatX> c = solve(A, b, k_least_singular[static_cast<std::size_t>(degree)]);
  if (!c) return {};
  return VecX(c->col(0));
}

/// How far the fit passes from a neighbour of the first ring, at most.
double missed(int degree, std::span<const Row> rows, const VecX& c) {
  double worst = 0.0;
  for (const Row& row : rows) {
    if (!row.is_nearest) continue;
    double height = 0.0;
    monomials(degree, row.a, row.b, [&](int i, double value) { height += c[i] * value; });
    worst = std::max(worst, std::abs(height - row.height));
  }
  return worst;
}

}  // namespace

Vec3 SurfaceFit::above(const Vec3& x) const {
  if (degree == 0) return x;
  const Vec3 d = x - origin;
  const double a = d.dot(e1), b = d.dot(e2);
  double height = 0.0;
  monomials(degree, a / s1, b / s2, [&](int i, double value) {
    height += coefficient[static_cast<std::size_t>(i)] * value;
  });
  return origin + a * e1 + b * e2 + height * normal;
}

SurfaceFit fit_surface_at(const Vec3& origin, const Vec3& normal, std::span<const Vec3> neighbours,
                          std::size_t nearest) {
  SurfaceFit fit;
  fit.origin = origin;
  fit.normal = normal;
  // Axes along and across the cloud of points: layers of thin facets are scaled to be as wide as
  // long.
  Eigen::Matrix2d spread = Eigen::Matrix2d::Zero();
  const Vec3 any = std::abs(normal.x()) < 0.6 ? Vec3::UnitX() : Vec3::UnitY();
  const Vec3 u = normal.cross(any).normalized(), v = normal.cross(u);
  for (const Vec3& p : neighbours) {
    const Vec2 d((p - origin).dot(u), (p - origin).dot(v));
    spread += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> axes(spread);
  const Vec2 long_axis = axes.eigenvectors().col(1);
  fit.e1 = long_axis.x() * u + long_axis.y() * v;
  fit.e2 = normal.cross(fit.e1);
  const double n = std::max<double>(1.0, static_cast<double>(neighbours.size()));
  fit.s1 = std::sqrt(std::max(axes.eigenvalues()[1], 0.0) / n);
  fit.s2 = std::sqrt(std::max(axes.eigenvalues()[0], 0.0) / n);
  if (!(fit.s1 > 0.0) || !(fit.s2 > 1e-9 * fit.s1)) {
    fit.s1 = fit.s2 = 1.0;
    return fit;
  }
  std::vector<Row> rows;
  for (std::size_t k = 0; k < neighbours.size(); ++k) {
    const Vec3 d = neighbours[k] - origin;
    const double a = d.dot(fit.e1) / fit.s1, b = d.dot(fit.e2) / fit.s2, h = d.dot(normal);
    if (std::abs(h) > k_steepest * d.norm()) continue;
    rows.push_back({a, b, h, std::sqrt(weight_of(a * a + b * b, 2.0)), k < nearest});
  }
  double bending = 0.0;  // of the first ring
  for (const Row& row : rows) {
    if (row.is_nearest) bending = std::max(bending, std::abs(row.height));
  }
  std::size_t count = rows.size();
  double least = k_tolerated_miss * bending;
  for (int degree = k_fit_degree; degree >= 2; --degree) {
    const double wanted = k_overdetermined * coefficient_count(degree);
    if (static_cast<double>(count) < wanted) continue;
    const std::optional<VecX> c = fit_heights(degree, {rows.data(), count});
    const double miss = c ? missed(degree, {rows.data(), count}, *c) : least;
    if (c && miss <= least) {
      least = miss;
      fit.degree = degree;
      fit.coefficient.fill(0.0);
      for (Eigen::Index i = 0; i < c->size(); ++i) {
        fit.coefficient[static_cast<std::size_t>(i)] = (*c)[i];
      }
    }
    if (fit.degree > 0 && least <= k_good_miss * bending) break;
    // Nearer points only, for the next degree.
    const double next = k_overdetermined * coefficient_count(degree - 1);
    count = std::min(count, static_cast<std::size_t>(std::ceil(1.2 * next)));
  }
  return fit;
}

Vec3 CurveFit::beside(const Vec3& x) const {
  const double a = (x - origin).dot(tangent);
  Vec3 point = origin + a * tangent;
  double power = 1.0;
  for (int j = 1; j <= degree; ++j) {
    power *= a / s;
    point += power * coefficient[static_cast<std::size_t>(j)];
  }
  return point;
}

CurveFit fit_curve_at(const Vec3& origin, std::span<const Vec3> before,
                      std::span<const Vec3> after) {
  CurveFit fit;
  fit.origin = origin;
  fit.coefficient.fill(Vec3::Zero());
  Vec3 direction = Vec3::Zero();
  if (!after.empty()) direction += (after.front() - origin).normalized();
  if (!before.empty()) direction -= (before.front() - origin).normalized();
  fit.tangent = direction.normalized();
  std::vector<Vec3> points;
  double mean = 0.0;
  for (const auto& [side, sign] : {std::pair{before, -1.0}, std::pair{after, 1.0}}) {
    Vec3 last = origin;
    for (const Vec3& p : side) {
      const Vec3 step = p - last;
      if (sign * step.dot(fit.tangent) < 0.5 * step.norm()) break;  // turned by over 60 degrees
      points.push_back(p - origin);
      mean += std::pow((p - origin).dot(fit.tangent), 2);
      last = p;
    }
  }
  if (points.empty()) return fit;
  fit.s = std::sqrt(mean / static_cast<double>(points.size()));
  for (int degree = std::min(k_fit_degree, static_cast<int>(points.size())); degree >= 1;
       --degree) {
    MatX A(static_cast<Eigen::Index>(points.size()), degree), b(A.rows(), 3);
    for (Eigen::Index r = 0; r < A.rows(); ++r) {
      const Vec3& p = points[static_cast<std::size_t>(r)];
      const double a = p.dot(fit.tangent) / fit.s, w = std::sqrt(weight_of(a * a, 1.0));
      for (int j = 0; j < degree; ++j) A(r, j) = w * std::pow(a, j + 1);
      b.row(r) = w * (p - p.dot(fit.tangent) * fit.tangent).transpose();
    }
    const std::optional<MatX> x = solve(A, b, k_least_singular_curve);
    if (!x) continue;
    fit.degree = degree;
    for (int j = 0; j < degree; ++j) {
      fit.coefficient[static_cast<std::size_t>(j) + 1] = x->row(j).transpose();
    }
    return fit;
  }
  return fit;
}

}  // namespace camber::detail
