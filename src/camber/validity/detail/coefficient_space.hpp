#pragma once
// Spaces of polynomials in Bernstein form on a product of simplices: one tetrahedron, triangle x
// line, line x line x line. Every determinant of the certificate lives in one of these.
#include <camber/base/vec.hpp>
#include <camber/validity/detail/kernel_plan.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace camber::detail {

/// Barycentric multi-index (i0, i1, .., i_dim) of a coefficient; the entries sum to the degree.
using MultiIndex = std::array<int, 4>;

/// One simplex of the product: dim 1 (line), 2 (triangle) or 3 (tetrahedron), with its degree.
struct Factor {
  int dim = 1;
  int degree = 0;
  [[nodiscard]] int size() const;
};

/// Product space; factor 0 varies fastest. The coefficient number of (f0, f1, f2) is
/// f0 + size0 * (f1 + size1 * f2), each f in Camber's canonical lattice order.
struct CoefficientSpace {
  std::vector<Factor> factors;
  [[nodiscard]] int size() const;
  [[nodiscard]] int stride(int factor) const;
};

/// C(n, k) in double; exact while it is below 2^53.
[[nodiscard]] double binomial(int n, int k);

/// Multi-indices of one factor in canonical order (i1 fastest, i0 = degree - the others).
[[nodiscard]] std::vector<MultiIndex> multi_indices(const Factor& factor);
/// Place of a multi-index in that order.
[[nodiscard]] int multi_index_place(const Factor& factor, const MultiIndex& index);
/// degree! / (i0! i1! ..).
[[nodiscard]] double multinomial(const Factor& factor, const MultiIndex& index);

/// Product of the factors' multinomials for every coefficient: coefficient * multinomial is the
/// "scaled" form, in which a product of polynomials is a plain convolution.
[[nodiscard]] std::vector<double> multinomials(const CoefficientSpace& space);

/// The space that holds products of polynomials of a and b (degrees add).
[[nodiscard]] CoefficientSpace product_space(const CoefficientSpace& a, const CoefficientSpace& b);

/// E (size of `to` x size of `from`): the same polynomial of one factor in a higher degree. All
/// entries are >= 0 and every row sums to 1.
[[nodiscard]] MatX factor_elevation(const Factor& from, const Factor& to);

/// A coefficient that is the value of the polynomial at a corner: vertex[f] of each factor.
struct CornerCoefficient {
  int coefficient = 0;
  std::array<int, 3> vertex{};
};
/// All corners; those that share a coefficient (degree 0) appear once.
[[nodiscard]] std::vector<CornerCoefficient> corner_coefficients(const CoefficientSpace& space);

/// The runs of coefficients along i1 of factor 0.
[[nodiscard]] std::vector<CoefficientRow> coefficient_rows(const CoefficientSpace& space);

/// out[i * rows(b) + j]: first coefficient of the product's row that row i of a times row j of b
/// adds to.
[[nodiscard]] std::vector<std::int32_t> product_rows(const CoefficientSpace& a,
                                                     const CoefficientSpace& b);

}  // namespace camber::detail
