#pragma once
// Arithmetic on several elements at once, one a lane. For kernels that are compiled once per
// instruction set: everything has internal linkage on purpose, and no library header is used, so
// that no inline function compiled for a newer processor can be linked into code for an older one.
// Lane by lane the same operations as on doubles: same bits for any number of lanes.

namespace camber {
namespace {

template <int W>
struct Vector {
  typedef double type __attribute__((vector_size(W * sizeof(double))));
};
template <>
struct Vector<1> {
  using type = double;
};

/// One double for each of W elements.
template <int W>
struct Pack {
  typename Vector<W>::type v;
};

template <int W>
inline Pack<W> broadcast(double s) {
  Pack<W> p{};
  p.v = p.v + s;
  return p;
}
template <int W>
inline Pack<W> operator+(const Pack<W>& a, const Pack<W>& b) {
  return {a.v + b.v};
}
template <int W>
inline Pack<W> operator-(const Pack<W>& a, const Pack<W>& b) {
  return {a.v - b.v};
}
template <int W>
inline Pack<W> operator*(const Pack<W>& a, const Pack<W>& b) {
  return {a.v * b.v};
}
template <int W>
inline Pack<W> operator/(const Pack<W>& a, const Pack<W>& b) {
  return {a.v / b.v};
}
template <int W>
inline Pack<W> operator*(double s, const Pack<W>& a) {
  return {s * a.v};
}
template <int W>
inline Pack<W> lower(const Pack<W>& a, const Pack<W>& b) {
  return {a.v < b.v ? a.v : b.v};
}
template <int W>
inline Pack<W> higher(const Pack<W>& a, const Pack<W>& b) {
  return {a.v > b.v ? a.v : b.v};
}
template <int W>
inline Pack<W> magnitude(const Pack<W>& a) {
  return {a.v < 0.0 ? -a.v : a.v};
}
/// a where test >= 0, b elsewhere.
template <int W>
inline Pack<W> where_not_negative(const Pack<W>& test, const Pack<W>& a, const Pack<W>& b) {
  return {test.v >= 0.0 ? a.v : b.v};
}

/// a where test > 0, b elsewhere.
template <int W>
inline Pack<W> where_positive(const Pack<W>& test, const Pack<W>& a, const Pack<W>& b) {
  return {test.v > 0.0 ? a.v : b.v};
}

/// Hands out pieces of the scratch array.
template <int W>
struct Scratch {
  double* next;
  Pack<W>* take(int n) {
    Pack<W>* piece = reinterpret_cast<Pack<W>*>(next);
    next += static_cast<long>(n) * W;
    return piece;
  }
};

template <int W>
inline Pack<W> square_root(const Pack<W>& a) {
  Pack<W> r = a;
  for (int l = 0; l < W; ++l) r.v[l] = __builtin_sqrt(a.v[l]);
  return r;
}
template <>
inline Pack<1> square_root(const Pack<1>& a) {
  return {__builtin_sqrt(a.v)};
}

}  // namespace
}  // namespace camber
