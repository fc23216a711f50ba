#include <camber/basis/bernstein.hpp>

#include <algorithm>
#include <stdexcept>

#include <gtest/gtest.h>

#include "samples.hpp"

namespace camber {
namespace {

/// The highest degree asked of each simplex by det J at order 4, and some below.
std::vector<int> degrees(Shape shape) {
  if (shape == Shape::line) return {0, 1, 2, 5, 11};
  if (shape == Shape::triangle) return {0, 1, 2, 6, 10};
  return {0, 1, 3, 6, 9};
}

double falling(int n, int k) { return k == 0 ? 1.0 : n * falling(n - 1, k - 1); }

/// A polynomial of degree n that oscillates on the shape.
double wave(int n, const Vec3& x) {
  const double s = x[0] - 0.8 * x[1] + 0.6 * x[2];
  return test::power(s, n) - 0.7 * test::power(1 - s, n / 2) + 0.3 * x[0] * (n > 0 ? 1 : 0);
}

VecX wave_coefficients(Shape shape, int n) {
  VecX v(node_count(shape, n));
  for (Eigen::Index i = 0; i < v.size(); ++i) {
    v[i] = wave(n, lattice_xi(shape, n)[static_cast<std::size_t>(i)]);
  }
  return bernstein_from_lattice(shape, n) * v;
}

double evaluate_form(Shape shape, int n, const VecX& c, const Vec3& xi) {
  VecX B(c.size());
  bernstein_values(shape, n, xi, {B.data(), static_cast<std::size_t>(B.size())});
  return B.dot(c);
}

TEST(Bernstein, CoefficientOfAQuadraticIsTheTangentsMeeting) {
  // c = (v0, 2 v1 - (v0 + v2)/2, v2)
  MatX expected(3, 3);
  expected << 1, 0, 0, -0.5, 2, -0.5, 0, 0, 1;
  EXPECT_EQ(bernstein_from_lattice(Shape::line, 2), expected);
}

TEST(Bernstein, ValuesSumToOneAndAreNotNegativeInside) {
  for (Shape shape : test::k_simplices) {
    for (int n : degrees(shape)) {
      for (const Vec3& xi : test::inner_points(shape)) {
        std::vector<double> B(static_cast<std::size_t>(node_count(shape, n)));
        bernstein_values(shape, n, xi, B);
        double sum = 0;
        for (double b : B) sum += b;
        EXPECT_NEAR(sum, 1.0, 1e-14);
        EXPECT_GE(*std::min_element(B.begin(), B.end()), 0.0);
      }
    }
  }
}

TEST(Bernstein, CoefficientsOfPowersAreTheKnownOnes) {
  // x^k has the coefficients (b1)_k / (n)_k, falling factorials, at lattice point b.
  for (Shape shape : test::k_simplices) {
    for (int n : degrees(shape)) {
      const auto points = lattice(shape, n);
      for (int k = 0; k <= n; ++k) {
        VecX v(node_count(shape, n));
        for (Eigen::Index i = 0; i < v.size(); ++i) {
          v[i] = test::power(lattice_xi(shape, n)[static_cast<std::size_t>(i)][0], k);
        }
        const VecX c = bernstein_from_lattice(shape, n) * v;
        for (Eigen::Index i = 0; i < c.size(); ++i) {
          const double expected =
              falling(points[static_cast<std::size_t>(i)][0], k) / falling(n, k);
          EXPECT_NEAR(c[i], expected, 1e-12) << name(shape) << n << ' ' << k;
        }
      }
    }
  }
}

TEST(Bernstein, FormIsThePolynomial) {
  for (Shape shape : test::k_simplices) {
    for (int n : degrees(shape)) {
      const VecX c = wave_coefficients(shape, n);
      for (const Vec3& xi : test::inner_points(shape)) {
        EXPECT_NEAR(evaluate_form(shape, n, c, xi), wave(n, xi), 1e-12) << name(shape) << n;
      }
    }
  }
}

TEST(Bernstein, CoefficientsEncloseThePolynomial) {
  for (Shape shape : test::k_simplices) {
    for (int n : degrees(shape)) {
      const VecX c = wave_coefficients(shape, n);
      for (const Vec3& xi : lattice_xi(shape, 13)) {
        EXPECT_GE(wave(n, xi), c.minCoeff() - 1e-12);
        EXPECT_LE(wave(n, xi), c.maxCoeff() + 1e-12);
      }
    }
  }
}

TEST(Bernstein, ChildrenTileTheParent) {
  const std::size_t count[] = {2, 4, 8};
  for (std::size_t s = 0; s < 3; ++s) {
    const Shape shape = test::k_simplices[s];
    const auto children = bernstein_children(shape);
    ASSERT_EQ(children.size(), count[s]);
    for (const auto& x : children) {
      Mat3 A = Mat3::Identity();
      for (int d = 0; d < dimension(shape); ++d)
        A.col(d) = x[static_cast<std::size_t>(d) + 1] - x[0];
      EXPECT_DOUBLE_EQ(A.determinant(), 1.0 / static_cast<double>(count[s])) << name(shape);
    }
    // Every inner point lies in exactly one child, unless it is on a face between two.
    for (const Vec3& xi : test::inner_points(shape, 7)) {
      int inside = 0;
      for (const auto& x : children) {
        Mat3 A = Mat3::Identity();
        for (int d = 0; d < dimension(shape); ++d) {
          A.col(d) = x[static_cast<std::size_t>(d) + 1] - x[0];
        }
        const Vec3 local = A.inverse() * (xi - x[0]);
        const double lowest = std::min(local.head(dimension(shape)).minCoeff(), 1 - local.sum());
        if (lowest > 0) ++inside;
      }
      EXPECT_EQ(inside, 1) << name(shape) << ' ' << xi.transpose();
    }
  }
}

TEST(Bernstein, SubdivisionOfALineIsDeCasteljau) {
  // Left half of degree 2: c0, (c0+c1)/2, (c0+2c1+c2)/4.
  MatX left(3, 3);
  left << 1, 0, 0, 0.5, 0.5, 0, 0.25, 0.5, 0.25;
  EXPECT_EQ(bernstein_subdivision(Shape::line, 2)[0], left);
}

TEST(Bernstein, SubdivisionReproducesThePolynomial) {
  for (Shape shape : test::k_simplices) {
    for (int n : degrees(shape)) {
      const VecX c = wave_coefficients(shape, n);
      const auto children = bernstein_children(shape);
      for (std::size_t s = 0; s < children.size(); ++s) {
        const VecX child = bernstein_subdivision(shape, n)[s] * c;
        for (const Vec3& xi : test::inner_points(shape, 3)) {
          Vec3 x = (1 - xi.sum()) * children[s][0];
          for (Eigen::Index d = 0; d < 3; ++d) {
            x += xi[d] * children[s][static_cast<std::size_t>(d) + 1];
          }
          EXPECT_NEAR(evaluate_form(shape, n, child, xi), wave(n, x), 1e-12) << name(shape) << n;
        }
        EXPECT_GE(child.minCoeff(), c.minCoeff() - 1e-13);  // weights are convex combinations
      }
    }
  }
}

TEST(Bernstein, BoundsCloseQuadraticallyUnderSubdivision) {
  // The gap between the lowest coefficient and the minimum is O(h^2): (x - 1/3)^2 on [0,1].
  VecX v(3);
  for (Eigen::Index i = 0; i < 3; ++i)
    v[i] = test::power(0.5 * static_cast<double>(i) - 1.0 / 3, 2);
  std::vector<VecX> leaves{bernstein_from_lattice(Shape::line, 2) * v};
  double gap[2] = {0, 0};

  for (int level = 1; level <= 8; ++level) {
    std::vector<VecX> next;
    for (const VecX& c : leaves) {
      for (const MatX& S : bernstein_subdivision(Shape::line, 2)) next.push_back(S * c);
    }
    leaves.swap(next);
    double lowest = 1;
    for (const VecX& c : leaves) lowest = std::min(lowest, c.minCoeff());
    if (level == 6) gap[0] = -lowest;
    if (level == 8) gap[1] = -lowest;
  }

  EXPECT_GT(gap[1], 0.0);
  EXPECT_NEAR(gap[0] / gap[1], 16.0, 0.1);
}

TEST(Bernstein, RefusesShapesThatAreNoSimplices) {
  EXPECT_THROW(static_cast<void>(bernstein_from_lattice(Shape::prism, 2)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(bernstein_subdivision(Shape::line, -1)), std::invalid_argument);
}

}  // namespace
}  // namespace camber
