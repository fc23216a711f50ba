#include <camber/basis/lagrange.hpp>
#include <camber/basis/lattice.hpp>
#include <camber/reconstruct/detail/facet_patch.hpp>

#include <algorithm>
#include <cmath>

namespace camber::detail {
namespace {

/// A line meets the facet if it passes this near, in parts of the facet's size, and if the
/// parameters are inside up to this.
constexpr double k_crossing = 1e-9;

std::size_t place(int i, int j) { return static_cast<std::size_t>(5 * j + i); }

/// Monomial coefficients of the polynomial with the given lattice nodes: inverse Vandermonde
/// matrix, in the order of the lattice.
const MatX& monomials_from_lattice(Shape shape) {
  const auto invert = [](Shape s) {
    const std::span<const LatticePoint> points = lattice(s, k_patch_order);
    const std::span<const Vec3> xi = lattice_xi(s, k_patch_order);
    const Eigen::Index n = static_cast<Eigen::Index>(points.size());
    MatX V(n, n);
    for (Eigen::Index r = 0; r < n; ++r) {
      for (Eigen::Index c = 0; c < n; ++c) {
        const LatticePoint& power = points[static_cast<std::size_t>(c)];
        const Vec3& x = xi[static_cast<std::size_t>(r)];
        V(r, c) = std::pow(x.x(), power[0]) * std::pow(x.y(), power[1]);
      }
    }
    return MatX(V.fullPivLu().inverse());
  };
  static const MatX triangle = invert(Shape::triangle), quad = invert(Shape::quadrilateral);
  return shape == Shape::triangle ? triangle : quad;
}

constexpr std::array<double, 5> k_factorial{1.0, 1.0, 2.0, 6.0, 24.0};
static_assert(k_factorial.size() == k_patch_order + 1);

double choose(int n, int k) {
  const auto factorial = [](int i) { return k_factorial[static_cast<std::size_t>(i)]; };
  return factorial(n) / (factorial(k) * factorial(n - k));
}

/// Bezier point (i, j) from monomial coefficients c_kl: sum over k <= i, l <= j of
///   triangle  C(i,k) C(j,l) / (n! / (k! l! (n-k-l)!)) c_kl
///   quad      C(i,k) / C(n,k)  C(j,l) / C(n,l)  c_kl,     n = 4
Vec3 bezier_point(Shape shape, const std::array<Vec3, 25>& c, int i, int j) {
  const int n = k_patch_order;
  Vec3 point = Vec3::Zero();
  for (int l = 0; l <= j; ++l) {
    for (int k = 0; k <= i; ++k) {
      const double over =
          shape == Shape::triangle ? choose(n, k) * choose(n - k, l) : choose(n, k) * choose(n, l);
      point += choose(i, k) * choose(j, l) / over * c[place(k, l)];
    }
  }
  return point;
}

/// The long side u + v = 1 of a triangle.
class LongSide final : public ParametricCurve {
 public:
  explicit LongSide(const FacetPatch& patch) : patch_(patch) {}
  [[nodiscard]] CurveJet jet(double t) const override {
    const SurfaceJet s = patch_.jet({1.0 - t, t});
    return {s.s, s.sv - s.su, s.suu - 2.0 * s.suv + s.svv};
  }
  [[nodiscard]] double first() const override { return 0.0; }
  [[nodiscard]] double last() const override { return 1.0; }
  [[nodiscard]] double period() const override { return 0.0; }
  [[nodiscard]] std::vector<double> breaks() const override { return {0.0, 1.0}; }

 private:
  const FacetPatch& patch_;
};

}  // namespace

FacetPatch::FacetPatch(Shape shape, std::span<const Vec3> nodes) : shape_(shape) {
  c_.fill(Vec3::Zero());
  const MatX& M = monomials_from_lattice(shape);
  const std::span<const LatticePoint> points = lattice(shape, k_patch_order);
  // The straight facet apart: what round-off makes of its size would be a gap between facets.
  const LatticeMap& map = lattice_map(shape, k_patch_order);
  Points corner;
  for (const std::vector<int>& edge : map.edge) {
    corner.push_back(nodes[static_cast<std::size_t>(edge.front())]);
  }
  const Points straight = straight_nodes(shape, k_patch_order, corner);
  for (std::size_t r = 0; r < nodes.size(); ++r) {
    Vec3 c = Vec3::Zero();
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      c += M(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(k)) * (nodes[k] - straight[k]);
    }
    c_[place(points[r][0], points[r][1])] = c;
  }
  c_[place(0, 0)] += corner[0];
  c_[place(1, 0)] += corner[1] - corner[0];
  c_[place(0, 1)] += corner.back() - corner[0];
  if (!is_triangle()) c_[place(1, 1)] += corner[0] - corner[1] + corner[2] - corner[3];
  for (const LatticePoint& p : points) box_.add(bezier_point(shape, c_, p[0], p[1]));
  size_ = box_.diagonal();
}

SurfaceJet FacetPatch::jet(const Vec2& uv) const {
  // Horner in u for every power of v, then in v.
  SurfaceJet s;
  s.s = s.su = s.sv = s.suu = s.suv = s.svv = Vec3::Zero();
  for (int j = k_patch_order; j >= 0; --j) {
    Vec3 row = Vec3::Zero(), row_u = row, row_uu = row;
    for (int i = is_triangle() ? k_patch_order - j : k_patch_order; i >= 0; --i) {
      row_uu = row_uu * uv.x() + 2.0 * row_u;
      row_u = row_u * uv.x() + row;
      row = row * uv.x() + c_[place(i, j)];
    }
    s.svv = s.svv * uv.y() + 2.0 * s.sv;
    s.suv = s.suv * uv.y() + s.su;
    s.sv = s.sv * uv.y() + s.s;
    s.s = s.s * uv.y() + row;
    s.su = s.su * uv.y() + row_u;
    s.suu = s.suu * uv.y() + row_uu;
  }
  return s;
}

Vec2 FacetPatch::guess(const Vec3& x) const {
  const Vec2 centre = is_triangle() ? Vec2(1.0 / 3.0, 1.0 / 3.0) : Vec2(0.5, 0.5);
  const SurfaceJet s = jet(centre);
  const double a = s.su.squaredNorm(), b = s.su.dot(s.sv), c = s.sv.squaredNorm();
  const double det = a * c - b * b;
  if (!(det > 1e-12 * a * c)) return centre;
  const double p = s.su.dot(x - s.s), q = s.sv.dot(x - s.s);
  const Vec2 uv = centre + Vec2(c * p - b * q, a * q - b * p) / det;
  return uv.cwiseMax(0.0).cwiseMin(1.0);
}

SurfaceFoot FacetPatch::closest(const Vec3& x, const std::optional<Vec2>& start) const {
  SurfaceFoot foot = find_foot(*this, x, start ? *start : guess(x), {}, size_);
  if (!is_triangle() || foot.uv.sum() <= 1.0) return foot;
  const LongSide side(*this);
  const CurveFoot on_side = find_foot(side, x, foot.uv.y() / foot.uv.sum(), 0.0, 1.0, size_);
  foot.uv = {1.0 - on_side.t, on_side.t};
  foot.point = on_side.point;
  foot.distance_squared = on_side.distance_squared;
  foot.is_converged = on_side.is_converged;
  const Vec3 r = x - foot.point, n = normal(foot.uv);
  foot.tangential = (r - r.dot(n) * n).norm();
  return foot;
}

std::optional<SurfaceFoot> FacetPatch::crossing(const Vec3& x, const Vec3& d,
                                                const std::optional<Vec2>& start) const {
  Vec2 from;
  if (start) {
    from = *start;
  } else {
    // Where the line meets the tangent plane at the centre.
    const SurfaceJet s = jet(is_triangle() ? Vec2(1.0 / 3.0, 1.0 / 3.0) : Vec2(0.5, 0.5));
    const Vec3 n = s.su.cross(s.sv);
    const double along = n.dot(d);
    const double t = std::abs(along) > 1e-6 * n.norm() ? n.dot(s.s - x) / along : d.dot(s.s - x);
    from = guess(x + t * d);
  }
  const SurfaceFoot foot = find_line_foot(*this, x, d, from, {}, size_);
  const double close = k_crossing * size_;
  if (foot.distance_squared > close * close) return {};
  if (is_triangle() && foot.uv.sum() > 1.0 + k_crossing) return {};
  return foot;
}

Vec3 FacetPatch::normal(const Vec2& uv) const {
  const SurfaceJet s = jet(uv);
  const Vec3 n = s.su.cross(s.sv);
  const double length = n.norm();
  return length > 0.0 ? Vec3(n / length) : Vec3::Zero();
}

unsigned FacetPatch::edges_at(const Vec2& uv, double tolerance) const {
  const double u = uv.x(), v = uv.y();
  const auto bit = [](bool is_on, unsigned edge) { return is_on ? 1U << edge : 0U; };
  if (is_triangle()) {
    return bit(v <= tolerance, 0) | bit(u + v >= 1.0 - tolerance, 1) | bit(u <= tolerance, 2);
  }
  return bit(v <= tolerance, 0) | bit(u >= 1.0 - tolerance, 1) | bit(v >= 1.0 - tolerance, 2) |
         bit(u <= tolerance, 3);
}

}  // namespace camber::detail
