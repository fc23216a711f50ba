// The cost kernel, written once for any number of lanes. Included by the cost_*.cpp files only,
// each compiled for one instruction set: everything here has internal linkage on purpose, and no
// library header may be used.
#pragma once
#include <camber/base/lanes.hpp>
#include <camber/metric/detail/cost_view.hpp>

namespace camber::detail {
namespace {

template <int W>
struct Matrix {
  Pack<W> m[3][3];
};

/// Columns of dx/dxi at one point. All nine sums in one pass: a node is loaded once.
template <int W>
inline Matrix<W> jacobian(const double* gradient, int nodes, const Pack<W>* x) {
  Matrix<W> A;
  for (int k = 0; k < 9; ++k) A.m[k / 3][k % 3] = broadcast<W>(0.0);
  for (int n = 0; n < nodes; ++n) {
    const Pack<W> xn[3] = {x[n], x[nodes + n], x[2 * nodes + n]};
    for (int j = 0; j < 3; ++j) {
      const Pack<W> d = broadcast<W>(gradient[j * nodes + n]);
      for (int i = 0; i < 3; ++i) A.m[i][j] = A.m[i][j] + d * xn[i];
    }
  }
  return A;
}

template <int W>
inline Pack<W> determinant(const Matrix<W>& a) {
  const auto along = [&a](int i, int j, int k) {
    return a.m[0][i] * (a.m[1][j] * a.m[2][k] - a.m[1][k] * a.m[2][j]);
  };
  return along(0, 1, 2) - along(1, 0, 2) + along(2, 0, 1);
}

/// Cofactors over the determinant, developed along the first column.
template <int W>
inline Matrix<W> inverse(const Matrix<W>& a) {
  Matrix<W> c;
  for (int j = 0; j < 3; ++j) {
    const int p = (j + 1) % 3, q = (j + 2) % 3;
    for (int i = 0; i < 3; ++i) {
      const int r = (i + 1) % 3, s = (i + 2) % 3;
      c.m[i][j] = a.m[r][p] * a.m[s][q] - a.m[r][q] * a.m[s][p];
    }
  }
  const Pack<W> det = c.m[0][0] * a.m[0][0] + c.m[1][0] * a.m[1][0] + c.m[2][0] * a.m[2][0];
  const Pack<W> inverse_det = broadcast<W>(1.0) / det;
  Matrix<W> b;
  for (int k = 0; k < 9; ++k) b.m[k / 3][k % 3] = c.m[k % 3][k / 3] * inverse_det;
  return b;
}

/// The last row adds its terms from the back, as the fixed-size product of cost<double, 3>() does:
/// both then have the same bits.
template <int W>
inline Matrix<W> product(const Matrix<W>& a, const Matrix<W>& b) {
  Matrix<W> c;
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 2; ++i) {
      c.m[i][j] = a.m[i][0] * b.m[0][j] + a.m[i][1] * b.m[1][j] + a.m[i][2] * b.m[2][j];
    }
    c.m[2][j] = a.m[2][0] * b.m[0][j] + (a.m[2][1] * b.m[1][j] + a.m[2][2] * b.m[2][j]);
  }
  return c;
}

template <int W>
inline Pack<W> frobenius_norm(const Matrix<W>& a) {
  Pack<W> sum = a.m[0][0] * a.m[0][0];
  for (int k = 1; k < 9; ++k) sum = sum + a.m[k % 3][k / 3] * a.m[k % 3][k / 3];
  return square_root(sum);
}

/// cost(A, W^-1) of metric/cost.hpp; 0 where the straight element has no volume to compare with.
template <int W>
inline Pack<W> cost(const Matrix<W>& A, const Matrix<W>& straight) {
  const Pack<W> one = broadcast<W>(1.0), zero = broadcast<W>(0.0);
  const Matrix<W> S = product(A, inverse(straight));
  const Pack<W> tau = determinant(S);
  const Pack<W> WCN = frobenius_norm(S) * frobenius_norm(inverse(S)) / broadcast<W>(3.0);
  const Pack<W> C = where_positive(tau, lower(tau, one) / WCN, tau);
  return where_positive(determinant(straight), C, zero);
}

template <int W>
void cost_kernel(const CostView& view, const double* x_values, const double* corner_values,
                 double* minimum_values, double* sum_values) {
  const Pack<W>* x = reinterpret_cast<const Pack<W>*>(x_values);
  const Pack<W>* corners = reinterpret_cast<const Pack<W>*>(corner_values);
  Pack<W> minimum = broadcast<W>(__builtin_inf()), sum = broadcast<W>(0.0);
  for (int q = 0; q < view.points; ++q) {
    const Matrix<W> A = jacobian(view.gradient + q * 3 * view.nodes, view.nodes, x);
    const Matrix<W> straight =
        jacobian(view.straight_gradient + q * 3 * view.corners, view.corners, corners);
    const Pack<W> C = cost(A, straight);
    minimum = lower(C, minimum);
    sum = sum + C;
  }
  *reinterpret_cast<Pack<W>*>(minimum_values) = minimum;
  *reinterpret_cast<Pack<W>*>(sum_values) = sum;
}

}  // namespace
}  // namespace camber::detail
