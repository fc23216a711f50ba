#pragma once
// Squared distance of curved faces to their surface, with derivatives by the nodes.
#include <camber/basis/lagrange.hpp>
#include <camber/smooth/surface_fit.hpp>

#include <vector>

namespace camber::detail {

/// F_f = sum over the sixth-order Gauss points of w |x - foot(x)|^2, w the rule's weight times the
/// area there of the straight face.
class SurfaceDistance {
 public:
  SurfaceDistance(const SurfacePatch& patch, const NearestPoints& nearest);

  /// Makes evaluate() weigh each face by 1 / (F_f + g_f^2 A_f) as it is at the patch's own nodes.
  void weigh_by_start();
  /// Weighted sum of F_f (weights 1 until weigh_by_start); dF/dx is added to slope.
  double evaluate(const Points& x, Points& slope);
  /// sqrt(sum F_f / sum A).
  [[nodiscard]] double root_mean_square(const Points& x);

 private:
  [[nodiscard]] const MatX& values(const SurfaceFace& face) const;
  /// Points and feet of all faces at x; the squared distances by face, times the areas.
  [[nodiscard]] std::vector<double> find_feet(const Points& x);

  const SurfacePatch& patch_;
  const NearestPoints& nearest_;
  MatX triangle_, quadrilateral_;  // basis at the Gauss points: points x nodes
  std::vector<double> face_weight_, face_area_;
  std::vector<Index> point2face_;
  std::vector<double> point_area_;
  Points points_, feet_;  // of all faces, one face after the other
};

}  // namespace camber::detail
