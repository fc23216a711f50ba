#pragma once
// Bernstein coefficients of det J the obvious way: one full Vandermonde system in long double.
#include <camber/basis/shape.hpp>

#include <array>
#include <span>
#include <vector>

namespace camber::reference {

/// Degrees of det J in Bernstein form: total degree in [0] for a tet; in the triangle [0] and along
/// [1] for a prism; one for each direction for a hexahedron and for the cube a pyramid is pulled
/// back to.
struct NaiveBernstein {
  std::array<int, 3> degree{};
  std::vector<double> coefficients;
};

/// Samples det J at as many points as there are coefficients (inside the element, so that a
/// pyramid's apex does not matter), evaluates every Bernstein polynomial there and solves. Cost
/// cubic in the number of coefficients: for low orders. Coefficients are in canonical lattice
/// order, first direction fastest.
[[nodiscard]] NaiveBernstein naive_bernstein(Shape shape, int p, std::span<const Vec3> nodes);

}  // namespace camber::reference
