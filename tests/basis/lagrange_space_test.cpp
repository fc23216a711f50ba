// What the bases can represent, and the volumes that follow.
#include <camber/basis/lagrange.hpp>
#include <camber/basis/quadrature.hpp>

#include <gtest/gtest.h>

#include "samples.hpp"

namespace camber {
namespace {

/// x^i y^j z^k (1-z)^e: a monomial, or with e = max(i,j)-i-j one of the pyramid's.
struct Monomial {
  int i, j, k, e;

  [[nodiscard]] double operator()(const Vec3& x) const {
    return test::power(x[0], i) * test::power(x[1], j) * test::power(x[2], k) *
           (e == 0 ? 1.0 : std::pow(1 - x[2], e));
  }
  [[nodiscard]] Vec3 gradient(const Vec3& x) const {
    const auto slope = [](double t, int n) { return n == 0 ? 0.0 : n * test::power(t, n - 1); };
    const double X = test::power(x[0], i), Y = test::power(x[1], j), Z = test::power(x[2], k);
    const double S = e == 0 ? 1.0 : std::pow(1 - x[2], e);
    const double dS = e == 0 ? 0.0 : -e * std::pow(1 - x[2], e - 1);
    return {slope(x[0], i) * Y * Z * S, X * slope(x[1], j) * Z * S,
            X * Y * (slope(x[2], k) * S + Z * dS)};
  }
  /// At a node; at the apex the limit along the axis.
  [[nodiscard]] double at_node(const Vec3& x) const {
    if (e == 0 || x[2] < 1.0) return (*this)(x);
    return i + j == 0 ? 1.0 : 0.0;
  }
};

std::vector<Monomial> space(Shape shape, int p) {
  std::vector<Monomial> monomials;
  for (const auto& [i, j, k] : lattice(shape == Shape::pyramid ? Shape::hexahedron : shape, p)) {
    if (shape != Shape::pyramid) {
      monomials.push_back({i, j, k, 0});
    } else if (k <= p - std::max(i, j)) {
      monomials.push_back({i, j, k, std::max(i, j) - i - j});
    }
  }
  return monomials;
}

TEST(LagrangeSpace, ReproducesEveryMonomialAndItsGradient) {
  for (Shape shape : test::k_shapes) {
    const Points points = test::inner_points(shape, 2);
    for (int p = 1; p <= k_max_tested_order; ++p) {
      const Tabulation table = tabulate(shape, p, points);
      const std::vector<Monomial> monomials = space(shape, p);
      ASSERT_EQ(std::ssize(monomials), node_count(shape, p));
      for (const Monomial& f : monomials) {
        VecX nodal(node_count(shape, p));
        for (Eigen::Index n = 0; n < nodal.size(); ++n) {
          nodal[n] = f.at_node(lattice_xi(shape, p)[static_cast<std::size_t>(n)]);
        }
        for (std::size_t r = 0; r < points.size(); ++r) {
          const auto row = static_cast<Eigen::Index>(r);
          EXPECT_NEAR(table.values.row(row).dot(nodal), f(points[r]), 1e-13) << name(shape) << p;
          const Vec3 exact = f.gradient(points[r]);
          for (std::size_t d = 0; d < static_cast<std::size_t>(dimension(shape)); ++d) {
            EXPECT_NEAR(table.gradient[d].row(row).dot(nodal), exact[static_cast<Eigen::Index>(d)],
                        1e-12)
                << name(shape) << p;
          }
        }
      }
    }
  }
}

double volume(Shape shape, int p, const Points& nodes) {
  const Quadrature& rule = gauss(shape, 4);  // the Jacobians here are of first degree at most
  double sum = 0;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    sum += rule.weights[q] * jacobian(shape, p, nodes, rule.points[q]).determinant();
  }
  return sum;
}

TEST(LagrangeSpace, GivesExactVolumesOfAffineElements) {
  Mat3 A;
  A << 2, 1, 0, -0.5, 1.5, 0.25, 0.3, -0.2, 1;
  const Vec3 offset(5, -3, 1);
  for (Shape shape : test::k_volumes) {
    for (int p = 1; p <= k_max_tested_order; ++p) {
      Points corner;
      for (const Vec3& xi : corners(shape)) corner.push_back(A * xi + offset);
      const Points nodes = straight_nodes(shape, p, corner);
      EXPECT_NEAR(volume(shape, p, nodes), A.determinant() * reference_measure(shape), 1e-12)
          << name(shape) << p;
      const Vec3 xi = test::inner_points(shape, 2).front();
      EXPECT_LT((evaluate(shape, p, nodes, xi) - (A * xi + offset)).norm(), 1e-13);
      EXPECT_LT((jacobian(shape, p, nodes, xi) - A).norm(), 1e-12);
    }
  }
}

TEST(LagrangeSpace, GivesExactVolumesOfCurvedElements) {
  // x -> x + x^2/4 after the shear y -> y + z^2/2: the Jacobian is 1 + x/2, whose integral is the
  // volume times 1 + (centroid x)/2. Both maps are of second degree in one coordinate.
  for (Shape shape : test::k_volumes) {
    for (int p = 2; p <= k_max_tested_order; ++p) {
      Points nodes;
      for (const Vec3& xi : lattice_xi(shape, p)) {
        nodes.emplace_back(xi[0] + xi[0] * xi[0] / 4, xi[1] + xi[2] * xi[2] / 2, xi[2]);
      }
      const double expected = reference_measure(shape) * (1 + reference_centroid(shape)[0] / 2);
      EXPECT_NEAR(volume(shape, p, nodes), expected, 1e-13) << name(shape) << p;
    }
  }
}

TEST(LagrangeSpace, ApproximatesASmoothMapAtTheRateOfItsOrder) {
  // Halving the element must divide the error by 2^(p+1), in the limit.
  const auto f = [](const Vec3& x) { return std::exp(x[0] + 0.7 * x[1] + 0.4 * x[2]); };
  for (Shape shape : test::k_shapes) {
    for (int p = 1; p <= 4; ++p) {
      double error[2] = {0, 0};
      for (int level = 0; level < 2; ++level) {
        const double h = level == 0 ? 0.2 : 0.1;
        Points nodes;
        for (const Vec3& xi : lattice_xi(shape, p)) nodes.emplace_back(f(h * xi), 0, 0);
        for (const Vec3& xi : test::inner_points(shape, 6)) {
          error[level] =
              std::max(error[level], std::abs(evaluate(shape, p, nodes, xi)[0] - f(h * xi)));
        }
      }
      EXPECT_NEAR(std::log2(error[0] / error[1]), p + 1, 0.25) << name(shape) << p;
    }
  }
}

}  // namespace
}  // namespace camber
