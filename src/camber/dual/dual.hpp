#pragma once
// Forward-mode dual numbers: a value and its N partial derivatives, carried through every
// operation.
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>

#include <Eigen/Core>

namespace camber {

/// v + sum_i d[i] e_i with e_i e_j = 0: f(Dual) has the value f(v) and the derivatives f'(v) d
/// (chain rule). Comparisons look at the value only. A literal or double is a constant (derivatives
/// 0). Source: [karman2022] section 2.2.5 "Marching Direction" (operator overloading of dual
/// numbers).
template <int N>
struct Dual {
  double v = 0.0;
  std::array<double, static_cast<std::size_t>(N)> d{};

  Dual() = default;
  // Constants mix freely with variables, as in a formula.
  Dual(double constant) : v(constant) {}  // NOLINT(google-explicit-constructor)

  /// The i-th independent variable, with value x.
  [[nodiscard]] static Dual variable(double x, int i) {
    Dual r(x);
    r.d[static_cast<std::size_t>(i)] = 1.0;
    return r;
  }

  Dual& operator+=(const Dual& b) { return *this = *this + b; }
  Dual& operator-=(const Dual& b) { return *this = *this - b; }
  Dual& operator*=(const Dual& b) { return *this = *this * b; }
  Dual& operator/=(const Dual& b) { return *this = *this / b; }

  friend Dual operator+(const Dual& a, const Dual& b) { return combine(a.v + b.v, 1.0, a, 1.0, b); }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return combine(a.v - b.v, 1.0, a, -1.0, b);
  }
  friend Dual operator*(const Dual& a, const Dual& b) { return combine(a.v * b.v, b.v, a, a.v, b); }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const double q = a.v / b.v;
    return combine(q, 1.0 / b.v, a, -q / b.v, b);
  }
  friend Dual operator-(const Dual& a) { return chain(-a.v, -1.0, a); }
  friend Dual operator+(const Dual& a) { return a; }

  friend bool operator==(const Dual& a, const Dual& b) { return a.v == b.v; }
  friend auto operator<=>(const Dual& a, const Dual& b) { return a.v <=> b.v; }

  /// Derivative 1/(2 sqrt(v)); at v = 0 that is +inf times d (0 where d is 0).
  friend Dual sqrt(const Dual& a) {
    const double r = std::sqrt(a.v);
    return chain(r, 0.5 / r, a);
  }
  /// At v = 0 the derivative from the right.
  friend Dual abs(const Dual& a) { return a.v < 0.0 ? -a : a; }
  /// The argument with the lower (higher) value; the first of equals.
  friend Dual min(const Dual& a, const Dual& b) { return b.v < a.v ? b : a; }
  friend Dual max(const Dual& a, const Dual& b) { return b.v > a.v ? b : a; }

 private:
  // value, and derivatives by the chain rule: fa da + fb db.
  static Dual combine(double value, double fa, const Dual& a, double fb, const Dual& b) {
    Dual r(value);
    for (std::size_t i = 0; i < r.d.size(); ++i) r.d[i] = fa * a.d[i] + fb * b.d[i];
    return r;
  }
  static Dual chain(double value, double f, const Dual& a) {
    Dual r(value);
    for (std::size_t i = 0; i < r.d.size(); ++i) r.d[i] = a.d[i] == 0.0 ? 0.0 : f * a.d[i];
    return r;
  }
};

}  // namespace camber

/// Lets fixed-size Eigen matrices hold dual numbers.
template <int N>
struct Eigen::NumTraits<camber::Dual<N>> : Eigen::NumTraits<double> {
  using Real = camber::Dual<N>;
  using NonInteger = camber::Dual<N>;
  using Nested = camber::Dual<N>;
  using Literal = camber::Dual<N>;
  enum {
    IsComplex = 0,
    IsInteger = 0,
    IsSigned = 1,
    RequireInitialization = 1,
    ReadCost = N + 1,
    AddCost = N + 1,
    MulCost = 3 * N + 1
  };
};
