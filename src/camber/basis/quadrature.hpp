#pragma once
#include <camber/basis/shape.hpp>

#include <vector>

namespace camber {

struct Quadrature {
  std::vector<Vec3> points;     // reference coordinates
  std::vector<double> weights;  // sum = reference_measure(shape); all positive
};

/// Rule with points strictly inside, exact for polynomials of total degree <= `degree` (tensor
/// shapes: degree in each direction; prism: total in the triangle, each along). Pyramid: exact for
/// polynomials in (x,y,z), and for the rational space through the collapsed product rule. Collapsed
/// Gauss-Jacobi products, floor(degree/2) + 1 points a direction; degree 0..61, else
/// std::invalid_argument. Cached; any thread.
[[nodiscard]] const Quadrature& gauss(Shape shape, int degree);

/// The paper's sixth-order Gauss points of surface elements (Karman 2022, Fig. 4): triangle 12
/// points (Dunavant 1985, degree 6), quadrilateral 4 x 4, line 4.
[[nodiscard]] const Quadrature& sixth_order(Shape shape);

/// n-point Gauss-Legendre on [0,1].
[[nodiscard]] Quadrature gauss_legendre(int n);

}  // namespace camber
