#include <camber/basis/bernstein.hpp>
#include <camber/basis/detail/cache.hpp>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <vector>

namespace camber {
namespace {

using Barycentric = std::array<int, 4>;  // exponents or lattice coordinates; corner 0 first

void require_simplex(Shape shape, int n) {
  const bool simplex =
      shape == Shape::line || shape == Shape::triangle || shape == Shape::tetrahedron;
  if (!simplex || n < 0 || n > k_max_lattice_order) {
    throw std::invalid_argument("no Bernstein form of degree " + std::to_string(n) + " on a " +
                                std::string(name(shape)));
  }
}

Barycentric barycentric(int n, const LatticePoint& at) {
  return {n - at[0] - at[1] - at[2], at[0], at[1], at[2]};
}

/// A homogeneous polynomial in the barycentric coordinates: the coefficients of the monomials
/// l0^a0 l1^a1 .. with |a| = degree, in the order of lattice (shape, degree). long double holds
/// every whole number below 2^64, so the products here are exact or next to it.
struct Form {
  int degree = 0;
  std::vector<long double> c{1.0L};
};

using Linear = std::array<long double, 4>;

/// [n][d]: place in lattice (shape, degree + 1) of point n of (shape, degree) with its exponent of
/// l_d raised by one.
const std::vector<std::array<int, 4>>& raised_places(Shape shape, int degree) {
  static detail::Cache<std::vector<std::array<int, 4>>, detail::k_fast_keys> cache;
  return cache.get(detail::cache_key(shape, degree), [&] {
    std::vector<std::array<int, 4>> places;
    for (const LatticePoint& point : lattice(shape, degree)) {
      std::array<int, 4> place{};
      for (std::size_t d = 0; d <= static_cast<std::size_t>(dimension(shape)); ++d) {
        LatticePoint raised = point;  // the exponent of l0 is implied
        if (d > 0) ++raised[d - 1];
        place[d] = lattice_index(shape, degree + 1, raised);
      }
      places.push_back(place);
    }
    return places;
  });
}

Form times(Shape shape, const Form& f, const Linear& l) {
  const auto& places = raised_places(shape, f.degree);
  const auto terms = static_cast<std::size_t>(dimension(shape)) + 1;
  const auto count = static_cast<std::size_t>(node_count(shape, f.degree + 1));
  Form product{f.degree + 1, std::vector<long double>(count, 0.0L)};
  for (std::size_t n = 0; n < places.size(); ++n) {
    for (std::size_t d = 0; d < terms; ++d) {
      product.c[static_cast<std::size_t>(places[n][d])] += f.c[n] * l[d];
    }
  }
  return product;
}

/// a0! a1! a2! a3!
long double factorial_product(const Barycentric& a) {
  long double product = 1;
  for (int exponent : a) {
    for (int i = 2; i <= exponent; ++i) product *= i;
  }
  return product;
}

/// Column a holds the Bernstein coefficients of the Lagrange function of lattice point a, which is
///   N_a = prod_d prod_{r < a_d} (n l_d - r)/(r + 1)
/// (Silvester), made homogeneous by 1 = sum l: a product of linear forms with whole coefficients.
/// The coefficient of B_b is that of l^b times b!/n!. No system is solved, nothing is lost.
MatX make_from_lattice(Shape shape, int n) {
  const auto points = lattice(shape, n);
  const auto count = static_cast<Eigen::Index>(points.size());
  MatX M(count, count);
  for (Eigen::Index column = 0; column < count; ++column) {
    const Barycentric a = barycentric(n, points[static_cast<std::size_t>(column)]);
    Form N;
    for (std::size_t d = 0; d < a.size(); ++d) {
      for (int r = 0; r < a[d]; ++r) {
        Linear l;
        l.fill(-r);
        l[d] += n;
        N = times(shape, N, l);
      }
    }
    const long double scale = 1 / (factorial_product(a) * factorial_product({n, 0, 0, 0}));
    for (Eigen::Index row = 0; row < count; ++row) {
      const auto b = static_cast<std::size_t>(row);
      M(row, column) =
          static_cast<double>(N.c[b] * scale * factorial_product(barycentric(n, points[b])));
    }
  }
  return M;
}

/// Coefficient a on the child with corners u_0, u_1, .. is the blossom with u_d taken a_d times:
/// the product of the linear forms u_d . l, whose coefficients are the weights of the parent's
/// (Farin, Triangular Bernstein-Bezier patches, 1986, doi 10.1016/0167-8396(86)90016-6). The u are
/// multiples of 1/2: exact.
MatX make_subdivision(Shape shape, int n, const std::array<Vec3, 4>& child) {
  std::array<Linear, 4> u{};
  for (std::size_t d = 0; d < u.size(); ++d) {
    const Vec3& x = child[d];
    u[d] = {1 - x[0] - x[1] - x[2], x[0], x[1], x[2]};
  }
  const auto points = lattice(shape, n);
  const auto count = static_cast<Eigen::Index>(points.size());
  MatX S(count, count);
  for (Eigen::Index row = 0; row < count; ++row) {
    const Barycentric a = barycentric(n, points[static_cast<std::size_t>(row)]);
    Form weights;
    for (std::size_t d = 0; d < a.size(); ++d) {
      for (int r = 0; r < a[d]; ++r) weights = times(shape, weights, u[d]);
    }
    for (Eigen::Index column = 0; column < count; ++column) {
      S(row, column) = static_cast<double>(weights.c[static_cast<std::size_t>(column)]);
    }
  }
  return S;
}

std::vector<std::array<Vec3, 4>> make_children(Shape shape) {
  const auto corner = corners(shape);
  const auto middle = [&](std::size_t a, std::size_t b) -> Vec3 {
    return 0.5 * (corner[a] + corner[b]);
  };
  std::vector<std::array<Vec3, 4>> children;
  for (std::size_t c = 0; c < corner.size(); ++c) {  // the parent, halved towards corner c
    std::array<Vec3, 4> child;
    child.fill(Vec3::Zero());
    for (std::size_t d = 0; d < corner.size(); ++d) child[d] = middle(c, d);
    children.push_back(child);
  }
  if (shape == Shape::triangle) {
    children.push_back({middle(1, 2), middle(2, 0), middle(0, 1), Vec3::Zero()});
  }
  if (shape == Shape::tetrahedron) {  // the octahedron, cut along the diagonal 02-13
    const std::array<Vec3, 4> around{middle(0, 1), middle(0, 3), middle(2, 3), middle(1, 2)};
    for (std::size_t i = 0; i < 4; ++i) {
      children.push_back({middle(0, 2), middle(1, 3), around[(i + 1) % 4], around[i]});
    }
  }
  return children;
}

}  // namespace

const MatX& bernstein_from_lattice(Shape shape, int n) {
  static detail::Cache<MatX, detail::k_fast_keys> cache;
  require_simplex(shape, n);
  return cache.get(detail::cache_key(shape, n), [&] { return make_from_lattice(shape, n); });
}

void bernstein_values(Shape shape, int n, const Vec3& xi, std::span<double> B) {
  require_simplex(shape, n);
  // B_a = n! prod_d l_d^a_d / a_d!
  const std::array<double, 4> l{1 - xi[0] - xi[1] - xi[2], xi[0], xi[1], xi[2]};
  std::array<std::array<double, k_max_lattice_order + 1>, 4> power_over_factorial;
  double n_factorial = 1;
  for (std::size_t d = 0; d < l.size(); ++d) power_over_factorial[d][0] = 1;
  for (int m = 1; m <= n; ++m) {
    const auto at = static_cast<std::size_t>(m);
    n_factorial *= m;
    for (std::size_t d = 0; d < l.size(); ++d) {
      power_over_factorial[d][at] = power_over_factorial[d][at - 1] * l[d] / m;
    }
  }
  std::size_t place = 0;
  for (const LatticePoint& point : lattice(shape, n)) {
    const Barycentric a = barycentric(n, point);
    double value = n_factorial;
    for (std::size_t d = 0; d < l.size(); ++d) {
      value *= power_over_factorial[d][static_cast<std::size_t>(a[d])];
    }
    B[place++] = value;
  }
}

std::span<const std::array<Vec3, 4>> bernstein_children(Shape shape) {
  static detail::Cache<std::vector<std::array<Vec3, 4>>, k_shape_count> cache;
  require_simplex(shape, 0);
  return cache.get(detail::cache_key(shape, 0), [&] { return make_children(shape); });
}

std::span<const MatX> bernstein_subdivision(Shape shape, int n) {
  static detail::Cache<std::vector<MatX>, detail::k_fast_keys> cache;
  require_simplex(shape, n);
  return cache.get(detail::cache_key(shape, n), [&] {
    std::vector<MatX> matrices;
    for (const auto& child : bernstein_children(shape)) {
      matrices.push_back(make_subdivision(shape, n, child));
    }
    return matrices;
  });
}

}  // namespace camber
