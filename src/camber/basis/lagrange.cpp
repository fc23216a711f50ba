#include <camber/base/assert.hpp>
#include <camber/basis/detail/cache.hpp>
#include <camber/basis/detail/pyramid_basis.hpp>
#include <camber/basis/lagrange.hpp>

#include <cstddef>
#include <stdexcept>

namespace camber {
namespace {

/// Functions 0..p of one coordinate and their derivatives.
struct Factor {
  std::array<double, k_max_lattice_order + 1> value;
  std::array<double, k_max_lattice_order + 1> slope;
};

/// Silvester's S_m(t) = prod_{r<m} (p t - r)/(r + 1), m <= p, at t = numerator/denominator: exact
/// at lattice points if both are whole. Slopes are with respect to t. Silvester 1969,
/// doi 10.1017/S0305004100044376 uses them for simplices.
Factor silvester(int p, double numerator, double denominator) {
  Factor S;
  S.value[0] = 1.0;
  S.slope[0] = 0.0;
  for (int m = 1; m <= p; ++m) {
    const auto at = static_cast<std::size_t>(m);
    const double factor = (p * numerator - (m - 1) * denominator) / (m * denominator);
    S.value[at] = S.value[at - 1] * factor;
    S.slope[at] = S.slope[at - 1] * factor + S.value[at - 1] * p / m;
  }
  return S;
}

/// The Lagrange basis of the line: N_i = S_i(t) S_{p-i}(1-t).
Factor line_basis(int p, double numerator, double denominator) {
  const Factor S = silvester(p, numerator, denominator);
  const Factor R = silvester(p, denominator - numerator, denominator);
  Factor N;
  for (int m = 0; m <= p; ++m) {
    const auto i = static_cast<std::size_t>(m);
    const auto l = static_cast<std::size_t>(p - m);
    N.value[i] = S.value[i] * R.value[l];
    N.slope[i] = S.slope[i] * R.value[l] - S.value[i] * R.slope[l];
  }
  return N;
}

/// N_(i,j,k) = x_i y_j z_k rest_(p - what rest is the remainder of), all shapes but the pyramid.
struct Product {
  std::array<Factor, 3> along;
  Factor rest;                // of the last barycentric coordinate
  std::array<int, 3> uses{};  // 1: the last barycentric coordinate is 1 - this one - ...
};

/// At xi = numerator/denominator.
Product factors(Shape shape, int p, const Vec3& numerator, double denominator) {
  Product f;
  const auto set = [&](std::size_t d, bool in_simplex) {
    const double t = numerator[static_cast<Eigen::Index>(d)];
    f.uses[d] = in_simplex ? 1 : 0;
    f.along[d] = in_simplex ? silvester(p, t, denominator) : line_basis(p, t, denominator);
  };
  const bool tensor = shape == Shape::quadrilateral || shape == Shape::hexahedron;
  set(0, !tensor);
  set(1, !tensor);
  set(2, !tensor && shape != Shape::prism);
  double rest = denominator;
  for (std::size_t d = 0; d < 3; ++d) {
    if (f.uses[d] == 1) rest -= numerator[static_cast<Eigen::Index>(d)];
  }
  if (!tensor) f.rest = silvester(p, rest, denominator);
  return f;
}

/// Calls node(n, x_i, y_j, z_k, rest) with places in the factors; rest is -1 if there is none.
template <class Node>
void for_each_node(Shape shape, int p, const Product& f, const Node& node) {
  const bool tensor = f.uses[0] == 0;
  std::size_t n = 0;
  for (const LatticePoint& at : lattice(shape, p)) {
    const int used = f.uses[0] * at[0] + f.uses[1] * at[1] + f.uses[2] * at[2];
    const auto rest = static_cast<std::size_t>(p - used);
    node(n++, static_cast<std::size_t>(at[0]), static_cast<std::size_t>(at[1]),
         static_cast<std::size_t>(at[2]), tensor ? 1.0 : f.rest.value[rest],
         tensor ? 0.0 : f.rest.slope[rest]);
  }
}

/// The values of silvester() and of line_basis() alone: the same operations, no slopes.
using Values = std::array<double, k_max_lattice_order + 1>;

void silvester_values(int p, double numerator, double denominator, Values& S) {
  S[0] = 1.0;
  for (int m = 1; m <= p; ++m) {
    const auto at = static_cast<std::size_t>(m);
    S[at] = S[at - 1] * ((p * numerator - (m - 1) * denominator) / (m * denominator));
  }
}

void line_values(int p, double numerator, double denominator, Values& N) {
  Values S, R;
  silvester_values(p, numerator, denominator, S);
  silvester_values(p, denominator - numerator, denominator, R);
  for (int m = 0; m <= p; ++m) {
    N[static_cast<std::size_t>(m)] =
        S[static_cast<std::size_t>(m)] * R[static_cast<std::size_t>(p - m)];
  }
}

/// What for_each_node gives with factors(), at less cost: this runs at every point of
/// the displacement field.
void product_values(Shape shape, int p, const Vec3& numerator, double denominator,
                    std::span<double> N) {
  const int dim = dimension(shape);
  const bool tensor = shape == Shape::quadrilateral || shape == Shape::hexahedron;
  std::array<Values, 3> along;
  Values remainder;
  double rest = denominator;
  std::array<int, 3> uses{};
  for (int d = 0; d < 3; ++d) {
    const auto at = static_cast<std::size_t>(d);
    const bool in_simplex = !tensor && (d < 2 || shape != Shape::prism);
    uses[at] = in_simplex ? 1 : 0;
    if (in_simplex) rest -= numerator[d];
    if (in_simplex && d >= dim) {
      along[at][0] = 1.0;  // S_0: all that a coordinate the shape does not have is asked for
    } else if (in_simplex) {
      silvester_values(p, numerator[d], denominator, along[at]);
    } else {
      line_values(p, numerator[d], denominator, along[at]);
    }
  }
  if (!tensor) silvester_values(p, rest, denominator, remainder);
  std::size_t n = 0;
  for (const LatticePoint& at : lattice(shape, p)) {
    const int used = uses[0] * at[0] + uses[1] * at[1] + uses[2] * at[2];
    const double R = tensor ? 1.0 : remainder[static_cast<std::size_t>(p - used)];
    N[n++] = along[0][static_cast<std::size_t>(at[0])] * along[1][static_cast<std::size_t>(at[1])] *
             along[2][static_cast<std::size_t>(at[2])] * R;
  }
}

void require_size([[maybe_unused]] Shape shape, [[maybe_unused]] int p,
                  [[maybe_unused]] std::size_t size) {
  CAMBER_ASSERT(static_cast<int>(size) == node_count(shape, p), "one entry per node");
}

MatX sample_matrix(Shape shape, int p, int q) {
  const auto points = lattice(shape, q);
  const auto xi = lattice_xi(shape, q);
  MatX E(static_cast<Eigen::Index>(points.size()), node_count(shape, p));
  std::vector<double> N(static_cast<std::size_t>(E.cols()));
  for (std::size_t n = 0; n < points.size(); ++n) {
    const auto [i, j, k] = points[n];
    if (shape == Shape::pyramid || q == 0) {
      lagrange_values(shape, p, xi[n], N);
    } else {
      product_values(shape, p, Vec3(i, j, k), q, N);
    }
    for (std::size_t m = 0; m < N.size(); ++m) {
      E(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(m)) = N[m];
    }
  }
  return E;
}

/// Rows of points on faces are those of the faces, so that they see the face's nodes and no other.
void take_faces(Shape shape, int p, int q, MatX& E) {
  const LatticeMap& from = lattice_map(shape, p);
  const LatticeMap& to = lattice_map(shape, q);
  for (std::size_t f = 0; f < faces(shape).size(); ++f) {
    const MatX& face = elevation_matrix(faces(shape)[f].shape, p, q);
    for (Eigen::Index n = 0; n < face.rows(); ++n) {
      const int row = to.face[f][static_cast<std::size_t>(n)];
      E.row(row).setZero();
      for (Eigen::Index m = 0; m < face.cols(); ++m) {
        E(row, from.face[f][static_cast<std::size_t>(m)]) = face(n, m);
      }
    }
  }
}

}  // namespace

void lagrange_values(Shape shape, int p, const Vec3& xi, std::span<double> N) {
  require_size(shape, p, N.size());
  if (shape == Shape::point) {
    N[0] = 1.0;
  } else if (shape == Shape::pyramid) {
    detail::pyramid_values(p, xi, N);
  } else {
    product_values(shape, p, xi, 1.0, N);
  }
}

void lagrange_gradients(Shape shape, int p, const Vec3& xi, std::span<Vec3> dN) {
  require_size(shape, p, dN.size());
  if (shape == Shape::point) {
    dN[0].setZero();
    return;
  }
  if (shape == Shape::pyramid) return detail::pyramid_gradients(p, xi, dN);
  const Product f = factors(shape, p, xi, 1.0);
  // By name: clang before 16 captures no structured bindings.
  const Factor &X = f.along[0], &Y = f.along[1], &Z = f.along[2];
  const int dim = dimension(shape);
  for_each_node(
      shape, p, f,
      [&](std::size_t n, std::size_t i, std::size_t j, std::size_t k, double R, double dR) {
        const double x = X.value[i], y = Y.value[j], z = Z.value[k];
        const double through_rest = x * y * z * dR;
        dN[n] = Vec3(X.slope[i] * y * z * R - f.uses[0] * through_rest,
                     x * Y.slope[j] * z * R - f.uses[1] * through_rest,
                     x * y * Z.slope[k] * R - f.uses[2] * through_rest);
        for (Eigen::Index d = dim; d < 3; ++d) dN[n][d] = 0.0;
      });
}

Tabulation tabulate(Shape shape, int p, std::span<const Vec3> xi) {
  const auto rows = static_cast<Eigen::Index>(xi.size());
  const Eigen::Index nodes = node_count(shape, p);
  std::vector<double> N(static_cast<std::size_t>(nodes));
  std::vector<Vec3> dN(static_cast<std::size_t>(nodes));
  Tabulation t;
  t.values.resize(rows, nodes);
  const auto dim = static_cast<std::size_t>(dimension(shape));
  for (std::size_t d = 0; d < dim; ++d) t.gradient[d].resize(rows, nodes);
  for (Eigen::Index r = 0; r < rows; ++r) {
    lagrange_values(shape, p, xi[static_cast<std::size_t>(r)], N);
    lagrange_gradients(shape, p, xi[static_cast<std::size_t>(r)], dN);
    for (std::size_t n = 0; n < N.size(); ++n) {
      const auto column = static_cast<Eigen::Index>(n);
      t.values(r, column) = N[n];
      for (std::size_t d = 0; d < dim; ++d) {
        t.gradient[d](r, column) = dN[n][static_cast<Eigen::Index>(d)];
      }
    }
  }
  return t;
}

const MatX& elevation_matrix(Shape shape, int p, int q) {
  static detail::Cache<MatX, static_cast<std::size_t>(k_shape_count) * 256> cache;
  if (p < 1 || q < 1) throw std::invalid_argument("elevation is between orders of 1 and more");
  return cache.get(detail::cache_key(shape, p, q), [&] {
    if (p == q) return MatX(MatX::Identity(node_count(shape, p), node_count(shape, p)));
    MatX E = sample_matrix(shape, p, q);
    if (dimension(shape) == 3) take_faces(shape, p, q, E);
    return E;
  });
}

Vec3 evaluate(Shape shape, int p, std::span<const Vec3> nodes, const Vec3& xi) {
  thread_local std::vector<double> N;
  N.resize(nodes.size());
  lagrange_values(shape, p, xi, N);
  Vec3 x = Vec3::Zero();
  for (std::size_t n = 0; n < nodes.size(); ++n) x += N[n] * nodes[n];
  return x;
}

Mat3 jacobian(Shape shape, int p, std::span<const Vec3> nodes, const Vec3& xi) {
  thread_local std::vector<Vec3> dN;
  dN.resize(nodes.size());
  lagrange_gradients(shape, p, xi, dN);
  Mat3 J = Mat3::Zero();
  for (std::size_t n = 0; n < nodes.size(); ++n) J += nodes[n] * dN[n].transpose();
  return J;
}

Points straight_nodes(Shape shape, int p, std::span<const Vec3> corner_points) {
  const MatX& E = elevation_matrix(shape, 1, p);
  const std::vector<int>& corner = lattice_map(shape, 1).corner;
  CAMBER_ASSERT(corner_points.size() == corner.size(), "one point per corner");
  Points x(static_cast<std::size_t>(E.rows()), Vec3::Zero());
  for (std::size_t n = 0; n < x.size(); ++n) {
    for (std::size_t c = 0; c < corner.size(); ++c) {
      x[n] += E(static_cast<Eigen::Index>(n), corner[c]) * corner_points[c];
    }
  }
  return x;
}

}  // namespace camber
