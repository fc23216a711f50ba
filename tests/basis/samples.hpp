#pragma once
// What several of these tests walk over.
#include <camber/basis/lattice.hpp>

#include <cmath>
#include <vector>

namespace camber::test {

inline constexpr Shape k_shapes[] = {Shape::line,        Shape::triangle, Shape::quadrilateral,
                                     Shape::tetrahedron, Shape::pyramid,  Shape::prism,
                                     Shape::hexahedron};
inline constexpr Shape k_volumes[] = {Shape::tetrahedron, Shape::pyramid, Shape::prism,
                                      Shape::hexahedron};
inline constexpr Shape k_simplices[] = {Shape::line, Shape::triangle, Shape::tetrahedron};

/// Points inside the shape, on no symmetry of it: a lattice, pulled a little towards one point.
inline Points inner_points(Shape shape, int order = 4) {
  Points points;
  const Vec3 pole = 0.7 * reference_centroid(shape) + 0.3 * corners(shape)[1];
  for (const Vec3& xi : lattice_xi(shape, order)) points.push_back(0.87 * xi + 0.13 * pole);
  return points;
}

/// x^n for whole n >= 0, 0^0 = 1.
inline double power(double x, int n) {
  double product = 1.0;
  for (int i = 0; i < n; ++i) product *= x;
  return product;
}

}  // namespace camber::test
