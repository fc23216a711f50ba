#pragma once
// Certified bounds of the Jacobian determinant of one curved element.
#include <camber/basis/shape.hpp>

#include <span>

namespace camber {

enum class Verdict { valid, invalid, undecided };

struct JacobianBounds {
  Verdict verdict = Verdict::undecided;
  // det J per reference volume: min_lower <= min J <= min_upper, max J <= max_upper.
  double min_lower = 0.0, min_upper = 0.0, max_upper = 0.0;
  /// Certified lower bound of min J / max |J| over the element, in [-1, 1].
  double scaled_jacobian = 0.0;
  /// Certified lower bound of min tau, tau = Jp/Jc against the straight copy with the same corners.
  /// Where the straight copy itself cannot be shown valid there is no such bound: then min(0,
  /// scaled_jacobian).
  double jacobian_ratio = 0.0;
  Vec3 worst_xi = Vec3::Zero();  // where the smallest value found lies: min_upper holds there
};

struct CertifyOptions {
  int max_depth = 12;      // of subdivision, before `undecided`
  double sharpness = 0.1;  // bounds are refined until min_upper - min_lower <= sharpness *
                           // |min_upper| or the verdict alone is asked for (sharpness = inf)
};

/// Bernstein bounds with adaptive subdivision of det J for tet, pyramid, prism, hexahedron, p
/// in 1..8.
/// @param nodes  node_count(shape,p) physical nodes in canonical order [length]
/// `valid` iff the lowest coefficient of every leaf clears round-off: at least 64 u times the sum
/// of magnitudes in the determinant's products, plus what the conversion of the nodes may have
/// cost. Only differences of nodes enter: the distance from the origin costs no digits; taken along
/// the reference directions (but for the pyramid's axis), so that the width of a thin cell costs
/// none either. `invalid` iff a point with det J < 0 was found, by the same margin. Everything else
/// is `undecided`: an element that is exactly degenerate somewhere, one whose subdivision ended,
/// one with nodes that are not finite (bounds 0, scaled_jacobian -1). The minimum, the maximum and
/// tau are each refined to `sharpness`, with at most 64 * max_depth halvings. Thread-safe;
/// allocation only in thread-local work arrays. Throws std::invalid_argument for another shape or
/// order, or if nodes.size() is not node_count(shape,p). Same bits for every instruction set.
/// Sources: Johnen, Remacle, Geuzaine 2013 (doi 10.1016/j.jcp.2012.08.051); pyramid: pulled back to
/// the cube, x = a(1-c), y = b(1-c), z = c, where det J is a polynomial of degree (3p-2, 3p-1,
/// 3p-3).
[[nodiscard]] JacobianBounds certify(Shape shape, int p, std::span<const Vec3> nodes,
                                     const CertifyOptions& options = {});

/// The same question for a boundary face (tri, quad): n(xi) . N(xi) > 0 with n the normal of the
/// curved face and N that of the straight face at the same xi; min_*, max_upper and jacobian_ratio
/// are of n.N / |N|^2. A straight face without normal somewhere is `undecided`.
[[nodiscard]] JacobianBounds certify_face(Shape shape, int p, std::span<const Vec3> nodes,
                                          const CertifyOptions& options = {});

/// Only the verdict of certify, as early as possible: corners and coefficients, then subdivision.
[[nodiscard]] Verdict quick_verdict(Shape shape, int p, std::span<const Vec3> nodes,
                                    const CertifyOptions& options = {});

}  // namespace camber
