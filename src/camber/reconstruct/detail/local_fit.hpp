#pragma once
// Polynomials fitted to the neighbourhood of a vertex: height functions of surfaces and curves.
#include <camber/base/vec.hpp>

#include <array>
#include <span>

namespace camber::detail {

inline constexpr int k_fit_degree = 4;

/// A surface near a vertex as a height over its tangent plane:
///   x(a, b) = origin + a e1 + b e2 + n sum_{1 <= j+k <= degree} c_jk (a / s1)^j (b / s2)^k
/// It meets the vertex itself. degree 0: nothing curved was found, points stay where they are.
struct SurfaceFit {
  Vec3 origin, e1, e2, normal;
  double s1 = 1.0, s2 = 1.0;
  int degree = 0;
  std::array<double, (k_fit_degree + 1) * (k_fit_degree + 2) / 2> coefficient{};

  /// Point of the surface above (below) x along the normal.
  [[nodiscard]] Vec3 above(const Vec3& x) const;
};

/// Weighted least squares, weights falling with the distance; the highest degree from k_fit_degree
/// down to 2 for which there are enough points in general position and that meets the nearest ones:
/// a fit that misses them does not know the surface between them. Lower degrees see nearer points
/// only. Source: Jiao and Zha 2008,
/// doi 10.1145/1364901.1364924.
/// @param normal      unit, roughly that of the surface
/// @param neighbours  nearest rings first
/// @param nearest     how many of them are of the first ring
[[nodiscard]] SurfaceFit fit_surface_at(const Vec3& origin, const Vec3& normal,
                                        std::span<const Vec3> neighbours, std::size_t nearest);

/// A curve near a vertex as heights over its tangent:
///   x(a) = origin + a t + sum_{1 <= j <= degree} c_j (a / s)^j,   c_j across t
struct CurveFit {
  Vec3 origin, tangent;
  double s = 1.0;
  int degree = 0;
  std::array<Vec3, k_fit_degree + 1> coefficient;

  /// Point of the curve whose projection on the tangent is that of x.
  [[nodiscard]] Vec3 beside(const Vec3& x) const;
};

/// Weighted least squares as for surfaces; points that run back along the tangent do not count.
/// @param before, after  neighbours along the chain, nearest first
[[nodiscard]] CurveFit fit_curve_at(const Vec3& origin, std::span<const Vec3> before,
                                    std::span<const Vec3> after);

}  // namespace camber::detail
