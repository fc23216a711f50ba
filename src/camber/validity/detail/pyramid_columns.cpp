// The pyramid's nodal space is span{ x^i y^j (1-z)^(m-i-j) z^k }, m = max(i,j), k <= p - m. With
//   x = a(1-c), y = b(1-c), z = c   it becomes   a^i b^j (1-c)^m c^k   on the cube, and
//   dx/dx_ref                =  i a^(i-1) b^j (1-c)^(m-1) c^k                       =: A
//   dx/dy_ref                =  j a^i b^(j-1) (1-c)^(m-1) c^k                       =: B
//   dx/dz_ref - b dx/dy_ref  =  (i-m) a^i b^j (1-c)^(m-1) c^k + k a^i b^j (1-c)^m c^(k-1) =: C
// are polynomials up to the apex: m = 0 forces i = j = 0 and the first three terms vanish. Adding
// -b B to the third column does not change the determinant and lowers its degree in a, so
//   det = A x B . C   has degree (3p-2, 3p-1, 3p-3) in (a, b, c).
#include <camber/basis/lattice.hpp>
#include <camber/validity/detail/determinant_plan.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace camber::detail {

namespace {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

struct Monomial {
  int i, j, k;
  [[nodiscard]] int m() const { return std::max(i, j); }
};

std::vector<Monomial> monomials(int p) {
  std::vector<Monomial> all;
  for (int i = 0; i <= p; ++i) {
    for (int j = 0; j <= p; ++j) {
      for (int k = 0; k <= p - std::max(i, j); ++k) all.push_back({i, j, k});
    }
  }
  return all;
}

long double power(long double x, int n) {
  long double r = 1.0L;
  for (int i = 0; i < n; ++i) r *= x;
  return r;
}

// inverse(V), V(node, monomial): column n holds the monomial coefficients of the basis function of
// node n.
LongMatrix basis_coefficients(int p) {
  const std::vector<Monomial> terms = monomials(p);
  const std::span<const LatticePoint> nodes = lattice(Shape::pyramid, p);
  const auto size = static_cast<Eigen::Index>(terms.size());
  LongMatrix V(size, size);
  for (Eigen::Index n = 0; n < size; ++n) {
    const auto [i, j, k] = nodes[static_cast<std::size_t>(n)];
    const long double c = static_cast<long double>(k) / p;
    // At the apex every (a, b) is the same point; the functions with m > 0 vanish there.
    const long double a = k == p ? 0.0L : static_cast<long double>(i) / (p - k);
    const long double b = k == p ? 0.0L : static_cast<long double>(j) / (p - k);
    for (Eigen::Index t = 0; t < size; ++t) {
      const Monomial& q = terms[static_cast<std::size_t>(t)];
      V(n, t) = power(a, q.i) * power(b, q.j) * power(1.0L - c, q.m()) * power(c, q.k);
    }
  }
  return V.fullPivLu().inverse();
}

// Bernstein coefficient l, degree n, of s^u (1-s)^v.
long double line_coefficient(int n, int u, int v, int l) {
  return static_cast<long double>(binomial(n - u - v, l - u)) /
         static_cast<long double>(binomial(n, l));
}

// Adds factor * a^i b^j (1-c)^v c^k to one column of Bernstein coefficients on the cube.
void add_term(const CoefficientSpace& space, long double factor, int i, int j, int v, int k,
              LongMatrix& coefficients, Eigen::Index column) {
  const int na = space.factors[0].degree, nb = space.factors[1].degree,
            nc = space.factors[2].degree;
  Eigen::Index row = 0;
  for (int lc = 0; lc <= nc; ++lc) {
    for (int lb = 0; lb <= nb; ++lb) {
      for (int la = 0; la <= na; ++la, ++row) {
        coefficients(row, column) += factor * line_coefficient(na, i, 0, la) *
                                     line_coefficient(nb, j, 0, lb) *
                                     line_coefficient(nc, k, v, lc);
      }
    }
  }
}

// Coefficients of column `d` (A, B, C above) from the coefficients of the monomials.
LongMatrix column_of_monomials(const CoefficientSpace& space, int d, int p) {
  const std::vector<Monomial> terms = monomials(p);
  LongMatrix all = LongMatrix::Zero(space.size(), static_cast<Eigen::Index>(terms.size()));
  for (std::size_t t = 0; t < terms.size(); ++t) {
    const auto column = static_cast<Eigen::Index>(t);
    const auto [i, j, k] = terms[t];
    const int m = terms[t].m();
    if (d == 0 && i > 0) add_term(space, i, i - 1, j, m - 1, k, all, column);
    if (d == 1 && j > 0) add_term(space, j, i, j - 1, m - 1, k, all, column);
    if (d == 2 && i < m) add_term(space, i - m, i, j, m - 1, k, all, column);
    if (d == 2 && k > 0) add_term(space, k, i, j, m, k - 1, all, column);
  }
  return all;
}

// Matrix on the differences along reference direction d (0 or 1): nodes of a row share (j, k), and
// both the rows' differences and the derivative vanish for the functions of (y, z) alone.
FactorPass pass_on_differences(const LongMatrix& on_nodes, int d, int p, ColumnTable& column) {
  const std::span<const LatticePoint> nodes = lattice(Shape::pyramid, p);
  const auto along = static_cast<std::size_t>(d);
  std::vector<Eigen::VectorXd> matrix_columns;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    LatticePoint next = nodes[n];
    if (next[along] >= p - next[2]) continue;
    ++next[along];
    column.from.push_back(static_cast<std::int32_t>(n));
    column.to.push_back(lattice_index(Shape::pyramid, p, next));
    Eigen::Matrix<long double, Eigen::Dynamic, 1> sum =
        Eigen::Matrix<long double, Eigen::Dynamic, 1>::Zero(on_nodes.rows());
    for (; next[along] <= p - next[2]; ++next[along]) {
      sum += on_nodes.col(lattice_index(Shape::pyramid, p, next));
    }
    matrix_columns.push_back(sum.cast<double>());
  }
  FactorPass pass;
  pass.matrix.resize(on_nodes.rows(), static_cast<Eigen::Index>(matrix_columns.size()));
  for (std::size_t c = 0; c < matrix_columns.size(); ++c) {
    pass.matrix.col(static_cast<Eigen::Index>(c)) = matrix_columns[c];
  }
  return pass;
}

// The third column has no such kernel (the base may be twisted): it acts on node[n] - node[0].
FactorPass pass_from_first_node(const LongMatrix& on_nodes, ColumnTable& column) {
  for (Eigen::Index n = 1; n < on_nodes.cols(); ++n) {
    column.from.push_back(0);
    column.to.push_back(static_cast<std::int32_t>(n));
  }
  FactorPass pass;
  pass.matrix = on_nodes.rightCols(on_nodes.cols() - 1).cast<double>();
  return pass;
}

}  // namespace

std::vector<ColumnTable> pyramid_columns(int p) {
  const LongMatrix basis = basis_coefficients(p);
  const std::array<std::array<int, 3>, 3> degrees{
      {{p - 1, p, p - 1}, {p, p - 1, p - 1}, {p - 1, p, p - 1}}};
  std::vector<ColumnTable> columns(3);
  for (int d = 0; d < 3; ++d) {
    ColumnTable& column = columns[static_cast<std::size_t>(d)];
    for (int n : degrees[static_cast<std::size_t>(d)]) column.space.factors.push_back({1, n});
    const LongMatrix on_nodes = column_of_monomials(column.space, d, p) * basis;
    column.passes.push_back(d < 2 ? pass_on_differences(on_nodes, d, p, column)
                                  : pass_from_first_node(on_nodes, column));
  }
  return columns;
}

}  // namespace camber::detail
