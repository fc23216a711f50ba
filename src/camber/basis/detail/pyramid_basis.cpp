#include <camber/basis/detail/cache.hpp>
#include <camber/basis/detail/jacobi.hpp>
#include <camber/basis/detail/pyramid_basis.hpp>
#include <camber/basis/lattice.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace camber::detail {
namespace {

template <class T>
using Column = Eigen::Matrix<T, Eigen::Dynamic, 1>;
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;

/// The modes' factors at a point of the collapsed cube.
template <class T>
struct Collapsed {
  T a, b, s;
  JacobiValues<T> A, B;  // Legendre polynomials of 2a-1, 2b-1

  Collapsed(int p, T a_in, T b_in, T s_in)
      : a(a_in),
        b(b_in),
        s(s_in),
        A(jacobi_values(p, 0, 2 * a_in - 1)),
        B(jacobi_values(p, 0, 2 * b_in - 1)) {}
};

/// Calls mode(number, i, j, m, s^(m-1), P_k, P_k', scale) for all modes; s^(m-1) is 0 for m = 0.
template <class T, class Mode>
void for_each_mode(int p, const Collapsed<T>& at, const Mode& mode) {
  Eigen::Index number = 0;
  T power = 0;
  for (int m = 0; m <= p; ++m) {
    if (m > 0) power = m == 1 ? T(1) : power * at.s;
    const JacobiValues<T> C = jacobi_values(p - m, 2 * m + 2, 1 - 2 * at.s);
    for (int i = 0; i <= m; ++i) {
      for (int j = i == m ? 0 : m; j <= m; ++j) {
        for (int k = 0; k <= p - m; ++k) {
          const auto n = static_cast<std::size_t>(k);
          const T scale = std::sqrt(T((2 * i + 1) * (2 * j + 1) * (2 * (k + m) + 3)));
          mode(number++, i, j, m, power, C.value[n], C.slope[n], scale);
        }
      }
    }
  }
}

template <class T>
void modes(int p, const Collapsed<T>& at, Column<T>& psi) {
  psi.resize(node_count(Shape::pyramid, p));
  for_each_mode(p, at, [&](Eigen::Index n, int i, int j, int m, T power, T P, T, T scale) {
    const T C = m == 0 ? P : power * at.s * P;
    psi[n] = scale * at.A.value[static_cast<std::size_t>(i)] *
             at.B.value[static_cast<std::size_t>(j)] * C;
  });
}

/// V^-T: row n holds the modal coefficients of N_n.
const MatX& nodal_from_modal(int p) {
  static Cache<MatX, 32> cache;
  return cache.get(static_cast<std::size_t>(p), [&] {
    const auto nodes = lattice(Shape::pyramid, p);
    const auto count = static_cast<Eigen::Index>(nodes.size());
    LongMatrix V(count, count);
    Column<long double> psi;
    for (Eigen::Index n = 0; n < count; ++n) {
      const auto [i, j, k] = nodes[static_cast<std::size_t>(n)];
      const long double size = p - k;
      const long double a = p == k ? 0.5L : i / size;
      const long double b = p == k ? 0.5L : j / size;
      modes(p, Collapsed<long double>(p, a, b, p == 0 ? 0.75L : size / p), psi);
      V.row(n) = psi.transpose();
    }
    const LongMatrix inverse = V.partialPivLu().inverse();
    return MatX(inverse.transpose().cast<double>());
  });
}

Collapsed<double> collapse(int p, const Vec3& xi) {
  const double s = 1.0 - xi[2];
  if (s == 0.0) return {p, 0.5, 0.5, 0.0};
  return {p, xi[0] / s, xi[1] / s, s};
}

}  // namespace

void pyramid_values(int p, const Vec3& xi, std::span<double> N) {
  thread_local Column<double> psi;
  modes(p, collapse(p, xi), psi);
  Eigen::Map<VecX>(N.data(), psi.size()).noalias() = nodal_from_modal(p) * psi;
}

void pyramid_gradients(int p, const Vec3& xi, std::span<Vec3> dN) {
  const Collapsed<double> at = collapse(p, xi);
  thread_local Eigen::Matrix<double, Eigen::Dynamic, 3> slopes;
  slopes.resize(node_count(Shape::pyramid, p), 3);
  // da/dx = db/dy = 1/s, da/dz = a/s, db/dz = b/s: the 1/s is taken out of s^m.
  for_each_mode(
      p, at,
      [&](Eigen::Index n, int i, int j, int m, double power, double P, double dP, double scale) {
        const auto u = static_cast<std::size_t>(i);
        const auto v = static_cast<std::size_t>(j);
        const double dA = 2.0 * at.A.slope[u] * at.B.value[v];
        const double dB = 2.0 * at.A.value[u] * at.B.slope[v];
        const double AB = at.A.value[u] * at.B.value[v];
        const double s_m = m == 0 ? 1.0 : power * at.s;
        const double dC = 2.0 * s_m * dP - m * power * P;
        const Vec3 gradient(dA * power * P, dB * power * P,
                            (at.a * dA + at.b * dB) * power * P + AB * dC);
        slopes.row(n) = scale * gradient.transpose();
      });
  thread_local Eigen::Matrix<double, Eigen::Dynamic, 3> result;
  result.noalias() = nodal_from_modal(p) * slopes;
  for (Eigen::Index n = 0; n < result.rows(); ++n) {
    dN[static_cast<std::size_t>(n)] = result.row(n).transpose();
  }
}

}  // namespace camber::detail
