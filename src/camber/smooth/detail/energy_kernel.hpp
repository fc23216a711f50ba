// The energy kernel, written once for any number of lanes. Included by the energy_*.cpp files only,
// each compiled for one instruction set: everything here has internal linkage on purpose, and no
// library header may be used.
#pragma once
#include <camber/base/lanes.hpp>
#include <camber/smooth/detail/energy_view.hpp>

namespace camber::detail {
namespace {

template <int W>
struct Matrix {
  Pack<W> m[3][3];
};

template <int W>
inline Pack<W> dot(const Matrix<W>& a, const Matrix<W>& b) {
  Pack<W> sum = a.m[0][0] * b.m[0][0];
  for (int k = 1; k < 9; ++k) sum = sum + a.m[k / 3][k % 3] * b.m[k / 3][k % 3];
  return sum;
}

/// Cofactor matrix: columns are cross products of the columns of a.
template <int W>
inline Matrix<W> cofactor(const Matrix<W>& a) {
  Matrix<W> c;
  for (int j = 0; j < 3; ++j) {
    const int p = (j + 1) % 3, q = (j + 2) % 3;
    for (int i = 0; i < 3; ++i) {
      const int r = (i + 1) % 3, s = (i + 2) % 3;
      c.m[i][j] = a.m[r][p] * a.m[s][q] - a.m[s][p] * a.m[r][q];
    }
  }
  return c;
}

/// a b^T if `transposed`, else a b.
template <int W>
inline Matrix<W> product(const Matrix<W>& a, const Matrix<W>& b, bool transposed) {
  Matrix<W> c;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      Pack<W> sum = a.m[i][0] * (transposed ? b.m[j][0] : b.m[0][j]);
      for (int k = 1; k < 3; ++k) sum = sum + a.m[i][k] * (transposed ? b.m[j][k] : b.m[k][j]);
      c.m[i][j] = sum;
    }
  }
  return c;
}

/// |cof T|^2 / 2 by T: |T|^2 T - T T^T T.
template <int W>
inline Matrix<W> half_cofactor_slope(const Matrix<W>& T, const Pack<W>& a) {
  const Matrix<W> TTT = product(product(T, T, true), T, false);
  Matrix<W> slope;
  for (int k = 0; k < 9; ++k) {
    slope.m[k / 3][k % 3] = a * T.m[k / 3][k % 3] - TTT.m[k / 3][k % 3];
  }
  return slope;
}

template <int W>
struct Sample {
  Pack<W> energy;
  Matrix<W> slope;  // by T
};

/// The distortion of smooth/distortion.hpp: a b (1/h + 1/h^3) / 18 with a = |T|^2, b = |cof T|^2.
template <int W>
inline Sample<W> shape_sample(const Matrix<W>& T, const Matrix<W>& cof, const Pack<W>& tau,
                              const Pack<W>& delta) {
  const Pack<W> one = broadcast<W>(1.0), zero = broadcast<W>(0.0);
  const Pack<W> root = square_root(tau * tau + 4.0 * (delta * delta));
  // The same number either way, without the cancellation of root and tau.
  const Pack<W> above = 0.5 * (tau + root);
  const Pack<W> below = 2.0 * (delta * delta) / higher(root - tau, broadcast<W>(1e-300));
  const Pack<W> h = where_not_negative(tau, above, below);
  const Pack<W> a = dot(T, T), b = dot(cof, cof);
  const Pack<W> i1 = one / h, i2 = i1 * i1;
  const Pack<W> size = 0.5 * (i1 + i1 * i2);
  const Pack<W> size_slope = zero - 0.5 * i2 - 1.5 * (i2 * i2);
  const Pack<W> h_slope = h / root;
  const Pack<W> ninth = broadcast<W>(1.0 / 9.0);
  Sample<W> s;
  s.energy = ninth * (a * b * size);
  const Matrix<W> b_slope = half_cofactor_slope(T, a);
  const Pack<W> by_T = ninth * (2.0 * (b * size)), by_b = ninth * (2.0 * (a * size)),
                by_cof = ninth * (a * b * size_slope * h_slope);
  for (int k = 0; k < 9; ++k) {
    const int i = k / 3, j = k % 3;
    s.slope.m[i][j] = by_T * T.m[i][j] + by_b * b_slope.m[i][j] + by_cof * cof.m[i][j];
  }
  return s;
}

/// E^k, E = sqrt(a b) / (3 tau) (1 + m^2), m = max(0, 1/tau - 1): WCN times a one-sided size term.
/// d ln E / d tau = -1/tau - 2 m / (tau^2 (1 + m^2)).
template <int W>
inline Sample<W> quality_sample(const Matrix<W>& T, const Matrix<W>& cof, const Pack<W>& tau) {
  const Pack<W> one = broadcast<W>(1.0), zero = broadcast<W>(0.0);
  const Pack<W> a = dot(T, T), b = dot(cof, cof);
  const Pack<W> inverse = one / tau;
  const Pack<W> m = higher(zero, inverse - one);
  const Pack<W> cap = one + m * m;
  const Pack<W> E = (1.0 / 3.0) * (square_root(a * b) * inverse * cap);
  Pack<W> power = E * E;
  power = power * power;  // E^4: k_quality_power
  // dF/dT = k F dlnE/dT; dlnE/dT = T/a + (b'/2)/b + (dlnE/dtau) cof.
  const Pack<W> kF = static_cast<double>(k_quality_power) * power;
  const Pack<W> by_T = kF / a, by_b = kF / b;
  const Pack<W> by_cof = zero - kF * inverse * (one + 2.0 * (m * inverse) / cap);
  const Matrix<W> b_slope = half_cofactor_slope(T, a);
  Sample<W> s;
  s.energy = where_not_negative(zero - tau, broadcast<W>(__builtin_inf()), power);
  for (int k = 0; k < 9; ++k) {
    const int i = k / 3, j = k % 3;
    s.slope.m[i][j] = by_T * T.m[i][j] + by_b * b_slope.m[i][j] + by_cof * cof.m[i][j];
  }
  return s;
}

template <int W>
inline Sample<W> metric_sample(const Matrix<W>& T) {
  Sample<W> s;
  s.energy = dot(T, T);
  for (int k = 0; k < 9; ++k) s.slope.m[k / 3][k % 3] = 2.0 * T.m[k / 3][k % 3];
  return s;
}

/// Columns of dx/dxi at one sample.
template <int W>
inline Matrix<W> jacobian(const double* gradient, int nodes, const Pack<W>* x) {
  Matrix<W> A;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const double* d = gradient + j * nodes;
      const Pack<W>* xi = x + i * nodes;
      Pack<W> sum = d[0] * xi[0];
      for (int n = 1; n < nodes; ++n) sum = sum + d[n] * xi[n];
      A.m[i][j] = sum;
    }
  }
  return A;
}

template <int W>
void energy_kernel(EnergyKind kind, const EnergyView& view, const double* x_values,
                   const double* corner_values, const double* delta_values, double* slope_values,
                   double* energy_values, double* least_values) {
  const Pack<W>* x = reinterpret_cast<const Pack<W>*>(x_values);
  const Pack<W>* corners = reinterpret_cast<const Pack<W>*>(corner_values);
  const Pack<W> delta = *reinterpret_cast<const Pack<W>*>(delta_values);
  Pack<W>* slope = reinterpret_cast<Pack<W>*>(slope_values);
  const int n = view.nodes;
  const Pack<W> zero = broadcast<W>(0.0);
  for (int i = 0; i < 3 * n; ++i) slope[i] = zero;
  Pack<W> energy = zero, least = broadcast<W>(__builtin_inf());
  for (int s = 0; s < view.samples; ++s) {
    const double* gradient = view.gradient + s * 3 * n;
    const Matrix<W> A = jacobian(gradient, n, x);
    const Matrix<W> straight =
        jacobian(view.straight_gradient + s * 3 * view.corners, view.corners, corners);
    // W^-1 = cof(W)^T / det W.
    const Matrix<W> straight_cof = cofactor(straight);
    const Pack<W> straight_det = straight.m[0][0] * straight_cof.m[0][0] +
                                 straight.m[1][0] * straight_cof.m[1][0] +
                                 straight.m[2][0] * straight_cof.m[2][0];
    const Pack<W> inverse_det = broadcast<W>(1.0) / straight_det;
    Matrix<W> W_inverse;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) W_inverse.m[i][j] = straight_cof.m[j][i] * inverse_det;
    }
    const Matrix<W> T = product(A, W_inverse, false);
    Sample<W> f;
    if (kind == EnergyKind::metric) {
      f = metric_sample(T);
    } else {
      const Matrix<W> cof = cofactor(T);
      const Pack<W> tau =
          T.m[0][0] * cof.m[0][0] + T.m[1][0] * cof.m[1][0] + T.m[2][0] * cof.m[2][0];
      least = lower(least, tau);
      f = kind == EnergyKind::shape ? shape_sample(T, cof, tau, delta)
                                    : quality_sample(T, cof, tau);
    }
    const double weight = view.weight[s];
    energy = energy + weight * f.energy;
    // dE/dA = dE/dT W^-T, weighted.
    const Matrix<W> stress = product(f.slope, W_inverse, true);
    for (int i = 0; i < 3; ++i) {
      const Pack<W> p0 = weight * stress.m[i][0], p1 = weight * stress.m[i][1],
                    p2 = weight * stress.m[i][2];
      Pack<W>* out = slope + i * n;
      for (int k = 0; k < n; ++k) {
        out[k] = out[k] + gradient[k] * p0 + gradient[n + k] * p1 + gradient[2 * n + k] * p2;
      }
    }
  }
  *reinterpret_cast<Pack<W>*>(energy_values) = energy;
  *reinterpret_cast<Pack<W>*>(least_values) = least;
}

template <int W>
void stiffness_kernel(const EnergyView& view, const double* corner_values, const int* linear,
                      const int* pairs, int pair_count, double* room, double* sum_values) {
  const Pack<W>* corners = reinterpret_cast<const Pack<W>*>(corner_values);
  Pack<W>* g = reinterpret_cast<Pack<W>*>(room);
  Pack<W>* sums = reinterpret_cast<Pack<W>*>(sum_values);
  const int n = view.nodes;
  const Pack<W> zero = broadcast<W>(0.0);
  for (int p = 0; p < pair_count; ++p) sums[p] = zero;
  for (int s = 0; s < view.samples; ++s) {
    Matrix<W> straight;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        const double* d = view.straight_gradient + (s * 3 + j) * view.corners;
        Pack<W> sum = zero;
        for (int c = 0; c < view.corners; ++c) {
          sum = sum + d[linear[c]] * corners[i * view.corners + c];
        }
        straight.m[i][j] = sum;
      }
    }
    // W^-T = cof(W) / det W.
    const Matrix<W> cof = cofactor(straight);
    const Pack<W> inverse_det =
        broadcast<W>(1.0) / (cof.m[0][0] * straight.m[0][0] + cof.m[1][0] * straight.m[1][0] +
                             cof.m[2][0] * straight.m[2][0]);
    const double* dN = view.gradient + s * 3 * n;
    for (int i = 0; i < 3; ++i) {
      const Pack<W> t0 = cof.m[i][0] * inverse_det, t1 = cof.m[i][1] * inverse_det,
                    t2 = cof.m[i][2] * inverse_det;
      for (int k = 0; k < n; ++k) {
        g[3 * k + i] = dN[k] * t0 + (dN[n + k] * t1 + dN[2 * n + k] * t2);
      }
    }
    const double weight = view.weight[s];
    for (int p = 0; p < pair_count; ++p) {
      const Pack<W>*a = g + 3 * pairs[2 * p], *b = g + 3 * pairs[2 * p + 1];
      sums[p] = sums[p] + weight * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
    }
  }
}

}  // namespace
}  // namespace camber::detail
