#include <camber/basis/detail/cache.hpp>
#include <camber/basis/detail/jacobi.hpp>
#include <camber/basis/quadrature.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <stdexcept>
#include <string>

namespace camber {
namespace {

/// Points in [0,1] and weights, rising.
struct Rule1D {
  std::vector<double> x, w;
};

/// n-point Gauss rule on [0,1] for the weight (1-x)^alpha: roots t of P_n^(alpha,0) by Newton, the
/// roots already found divided out, in long double; x = (1+t)/2 and w = 1/((1-t^2) P_n'(t)^2)
/// (DLMF 18.9 and 3.5(v), beta = 0, mapped to [0,1]).
Rule1D gauss_jacobi(int n, int alpha) {
  if (n < 1 || n > k_max_lattice_order) {
    throw std::invalid_argument("no Gauss rule of " + std::to_string(n) + " points");
  }
  constexpr int k_newton_limit = 100;          // quadratic: about 6 are needed
  constexpr long double k_converged = 1e-18L;  // of |t| <= 1, a few long double roundings
  const auto last = static_cast<std::size_t>(n);
  Rule1D rule;
  std::vector<long double> roots;
  for (int r = 0; r < n; ++r) {
    long double t = -std::cos(std::numbers::pi_v<long double> * (2 * r + 1) / (2 * n));
    if (r > 0) t = (t + roots.back()) / 2;
    for (int iteration = 0; iteration < k_newton_limit; ++iteration) {
      const auto P = detail::jacobi_values<long double>(n, alpha, t);
      long double deflation = 0;
      for (long double root : roots) deflation += 1 / (t - root);
      const long double step = P.value[last] / (P.slope[last] - deflation * P.value[last]);
      t -= step;
      if (std::abs(step) < k_converged) break;
    }
    roots.push_back(t);
    const long double slope = detail::jacobi_values<long double>(n, alpha, t).slope[last];
    rule.x.push_back(static_cast<double>((1 + t) / 2));
    rule.w.push_back(static_cast<double>(1 / ((1 - t) * (1 + t) * slope * slope)));
  }
  return rule;
}

/// Calls point(x, weight) over the product of rules, the first direction fastest.
template <class Point>
void for_each_product(const Rule1D& a, const Rule1D& b, const Rule1D& c, const Point& point) {
  for (std::size_t k = 0; k < c.x.size(); ++k) {
    for (std::size_t j = 0; j < b.x.size(); ++j) {
      for (std::size_t i = 0; i < a.x.size(); ++i) {
        point(a.x[i], b.x[j], c.x[k], a.w[i] * b.w[j] * c.w[k]);
      }
    }
  }
}

Quadrature make_gauss(Shape shape, int degree) {
  const int n = degree / 2 + 1;
  const Rule1D one{{0.0}, {1.0}};
  const auto along = [&](int d) { return d < dimension(shape) ? gauss_jacobi(n, 0) : one; };
  Quadrature rule;
  const auto add = [&](double x, double y, double z, double w) {
    rule.points.emplace_back(x, y, z);
    rule.weights.push_back(w);
  };
  switch (shape) {
    case Shape::point:
    case Shape::line:
    case Shape::quadrilateral:
    case Shape::hexahedron:
      for_each_product(along(0), along(1), along(2), add);
      break;
    case Shape::triangle:
    case Shape::prism:  // the triangle is the square collapsed by x = a (1-y)
      for_each_product(along(0), gauss_jacobi(n, 1), along(2),
                       [&](double a, double y, double z, double w) { add(a * (1 - y), y, z, w); });
      break;
    case Shape::tetrahedron:  // x = a (1-b) (1-z), y = b (1-z)
      for_each_product(along(0), gauss_jacobi(n, 1), gauss_jacobi(n, 2),
                       [&](double a, double b, double z, double w) {
                         add(a * (1 - b) * (1 - z), b * (1 - z), z, w);
                       });
      break;
    case Shape::pyramid:  // x = a (1-z), y = b (1-z)
      for_each_product(
          along(0), along(1), gauss_jacobi(n, 2),
          [&](double a, double b, double z, double w) { add(a * (1 - z), b * (1 - z), z, w); });
      break;
  }
  return rule;
}

/// Dunavant 1985 (doi 10.1002/nme.1620210612), degree 6, 12 points; digits by
/// tools/triangle_rule_degree6.py.
Quadrature dunavant_degree6() {
  constexpr double u = 0.1167862757263793660253, b = 0.2492867451709104212916;
  constexpr double v = 0.0508449063702068169209, c = 0.0630890144915022283403;
  constexpr double w = 0.0828510756183735751936, d = 0.0531450498448169473532,
                   e = 0.3103524510337844054166;
  Quadrature rule;
  const auto add = [&](double x, double y, double weight) {
    rule.points.emplace_back(x, y, 0.0);
    rule.weights.push_back(0.5 * weight);
  };
  const auto add_orbit = [&](double s, double weight) {
    add(s, s, weight);
    add(1 - 2 * s, s, weight);
    add(s, 1 - 2 * s, weight);
  };
  add_orbit(b, u);
  add_orbit(c, v);
  constexpr double f = 1 - d - e;
  for (const auto& [x, y] : {std::pair{d, e}, {e, d}, {e, f}, {f, e}, {f, d}, {d, f}}) add(x, y, w);
  return rule;
}

}  // namespace

const Quadrature& gauss(Shape shape, int degree) {
  static detail::Cache<Quadrature, static_cast<std::size_t>(k_shape_count) * 64> cache;
  if (degree < 0) throw std::invalid_argument("quadrature of negative degree");
  return cache.get(detail::cache_key(shape, degree), [&] { return make_gauss(shape, degree); });
}

const Quadrature& sixth_order(Shape shape) {
  static const Quadrature triangle = dunavant_degree6();
  constexpr int k_degree_of_4_points = 7;
  switch (shape) {
    case Shape::triangle:
      return triangle;
    case Shape::line:
    case Shape::quadrilateral:
      return gauss(shape, k_degree_of_4_points);
    default:
      throw std::invalid_argument("the sixth-order rule is one of edges and faces");
  }
}

Quadrature gauss_legendre(int n) {
  const Rule1D rule = gauss_jacobi(n, 0);
  Quadrature quadrature;
  for (double x : rule.x) quadrature.points.emplace_back(x, 0.0, 0.0);
  quadrature.weights = rule.w;
  return quadrature;
}

}  // namespace camber
