#include <camber/smooth/marching/sub_cost.hpp>

namespace camber {

IdealSimplex<2> ideal_simplex(const SimplexCorners<double, 2>& X) {
  IdealSimplex<2> ideal;
  const std::array<double, 3> lengths = edge_lengths<double>(X);
  ideal.W_inverse = triangle_weight_matrix<double>(lengths).inverse();
  ideal.normal = (X[1] - X[0]).cross(X[2] - X[0]);
  // r = 2 area / perimeter
  ideal.inscribed_radius = ideal.normal.norm() / (lengths[0] + lengths[1] + lengths[2]);
  return ideal;
}

IdealSimplex<3> ideal_simplex(const SimplexCorners<double, 3>& X) {
  IdealSimplex<3> ideal;
  const Mat3 W = tetrahedron_weight_matrix<double>(edge_lengths<double>(X));
  ideal.W_inverse = W.inverse();
  const Vec3 a = X[1] - X[0], b = X[2] - X[0], c = X[3] - X[0];
  const double surface = 0.5 * (a.cross(b).norm() + b.cross(c).norm() + c.cross(a).norm() +
                                (b - a).cross(c - a).norm());
  // r = 3 volume / surface
  ideal.inscribed_radius = 0.5 * std::abs(a.cross(b).dot(c)) / surface;
  return ideal;
}

Mat3 sub_map(const SimplexCorners<double, 3>& x, const IdealSimplex<3>& ideal) {
  return edge_matrix<double, 3>(x) * ideal.W_inverse;
}

}  // namespace camber
