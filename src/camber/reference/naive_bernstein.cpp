#include <camber/reference/naive_bernstein.hpp>
#include <camber/reference/sampled_jacobian.hpp>

namespace camber::reference {

namespace {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using LongVector = Eigen::Matrix<long double, Eigen::Dynamic, 1>;

// A coefficient as exponents (i0, i1, i2, i3) of each of up to three barycentric systems.
struct Term {
  std::array<std::array<int, 4>, 3> exponent{};
};

std::vector<std::array<int, 4>> exponents(int dim, int degree) {
  std::vector<std::array<int, 4>> all;
  for (int k = 0; k <= (dim > 2 ? degree : 0); ++k) {
    for (int j = 0; j <= (dim > 1 ? degree - k : 0); ++j) {
      for (int i = 0; i <= degree - j - k; ++i) all.push_back({degree - i - j - k, i, j, k});
    }
  }
  return all;
}

long double bernstein(const std::array<int, 4>& exponent, const std::array<long double, 4>& x) {
  long double value = 1.0L;
  int n = 0;
  for (std::size_t s = 0; s < 4; ++s) {
    for (int i = 1; i <= exponent[s]; ++i) value *= x[s] * ++n / i;  // n!/(i0! i1! ..) prod x^i
  }
  return value;
}

}  // namespace

NaiveBernstein naive_bernstein(Shape shape, int p, std::span<const Vec3> nodes) {
  NaiveBernstein result;
  std::vector<int> dims;
  if (shape == Shape::tetrahedron) {
    dims = {3};
    result.degree = {3 * (p - 1), 0, 0};
  } else if (shape == Shape::prism) {
    dims = {2, 1};
    result.degree = {3 * p - 2, 3 * p - 1, 0};
  } else if (shape == Shape::pyramid) {
    dims = {1, 1, 1};
    result.degree = {3 * p - 2, 3 * p - 1, 3 * p - 3};
  } else {
    dims = {1, 1, 1};
    result.degree = {3 * p - 1, 3 * p - 1, 3 * p - 1};
  }
  std::vector<Term> terms(1);
  for (std::size_t f = 0; f < dims.size(); ++f) {
    std::vector<Term> next;
    for (const auto& exponent : exponents(dims[f], result.degree[f])) {
      for (Term term : terms) {
        term.exponent[f] = exponent;
        next.push_back(term);
      }
    }
    terms = std::move(next);
  }

  const auto size = static_cast<Eigen::Index>(terms.size());
  LongMatrix V(size, size);
  LongVector values(size);
  for (Eigen::Index row = 0; row < size; ++row) {
    // The term's own place, drawn inside: (i + 1/2) / (n + (dim + 1)/2).
    std::array<std::array<long double, 4>, 3> barycentric{};
    Vec3 xi = Vec3::Zero();
    int axis = 0;
    for (std::size_t f = 0; f < dims.size(); ++f) {
      const int corners = dims[f] + 1;
      for (int s = 0; s < corners; ++s) {
        const auto corner = static_cast<std::size_t>(s);
        const int i = terms[static_cast<std::size_t>(row)].exponent[f][corner];
        barycentric[f][corner] = (i + 0.5L) / (result.degree[f] + 0.5L * corners);
        if (s > 0) xi(axis++) = static_cast<double>(barycentric[f][corner]);
      }
    }
    if (shape == Shape::pyramid) {
      xi.x() *= 1.0 - xi.z();
      xi.y() *= 1.0 - xi.z();
    }
    values(row) = jacobian_determinant(shape, p, nodes, xi);
    for (Eigen::Index column = 0; column < size; ++column) {
      long double product = 1.0L;
      for (std::size_t f = 0; f < dims.size(); ++f) {
        product *= bernstein(terms[static_cast<std::size_t>(column)].exponent[f], barycentric[f]);
      }
      V(row, column) = product;
    }
  }
  const LongVector c = V.partialPivLu().solve(values);
  for (Eigen::Index n = 0; n < size; ++n) result.coefficients.push_back(static_cast<double>(c(n)));
  return result;
}

}  // namespace camber::reference
