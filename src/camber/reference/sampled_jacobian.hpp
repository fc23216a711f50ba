#pragma once
// The obvious way to look at det J: evaluate it in many points. For tests; never a certificate.
#include <camber/basis/shape.hpp>

#include <span>

namespace camber::reference {

struct SampledRange {
  double minimum = 0.0, maximum = 0.0;
  Vec3 at_minimum = Vec3::Zero();
};

/// Determinant of dx/dxi (volume shapes) at one point.
[[nodiscard]] double jacobian_determinant(Shape shape, int p, std::span<const Vec3> nodes,
                                          const Vec3& xi);

/// Lowest and highest determinant over the points of the lattice of order n; a pyramid's apex,
/// where the limit depends on the direction, is left out.
[[nodiscard]] SampledRange sampled_jacobian(Shape shape, int p, std::span<const Vec3> nodes, int n);

/// The same of Jp/Jc against the straight copy (volume shapes).
[[nodiscard]] SampledRange sampled_ratio(Shape shape, int p, std::span<const Vec3> nodes, int n);

/// The same of n . N / |N|^2 for a triangle or quadrilateral, N the normal of the straight face.
[[nodiscard]] SampledRange sampled_normal(Shape shape, int p, std::span<const Vec3> nodes, int n);

}  // namespace camber::reference
