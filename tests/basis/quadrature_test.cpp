#include <camber/basis/quadrature.hpp>

#include <numbers>
#include <numeric>
#include <stdexcept>

#include <gtest/gtest.h>

#include "samples.hpp"

namespace camber {
namespace {

double factorial(int n) { return n < 2 ? 1.0 : n * factorial(n - 1); }

/// Integral of x^i y^j z^k over the reference shape.
double exact(Shape shape, int i, int j, int k) {
  const double along_z = 1.0 / (k + 1);
  switch (shape) {
    case Shape::line:
      return 1.0 / (i + 1);
    case Shape::quadrilateral:
      return 1.0 / ((i + 1) * (j + 1));
    case Shape::hexahedron:
      return along_z / ((i + 1) * (j + 1));
    case Shape::triangle:
      return factorial(i) * factorial(j) / factorial(i + j + 2);
    case Shape::prism:
      return factorial(i) * factorial(j) / factorial(i + j + 2) * along_z;
    case Shape::tetrahedron:
      return factorial(i) * factorial(j) * factorial(k) / factorial(i + j + k + 3);
    case Shape::pyramid:  // int_0^1 z^k (1-z)^(i+j+2) dz / ((i+1)(j+1))
      return factorial(i + j + 2) * factorial(k) / factorial(i + j + k + 3) / ((i + 1) * (j + 1));
    case Shape::point:
      return 1.0;
  }
  return 0.0;
}

double integrate(const Quadrature& rule, int i, int j, int k) {
  double sum = 0;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const Vec3& x = rule.points[q];
    sum += rule.weights[q] * test::power(x[0], i) * test::power(x[1], j) * test::power(x[2], k);
  }
  return sum;
}

/// Exponents the rule of this degree must integrate.
bool in_reach(Shape shape, int degree, int i, int j, int k) {
  switch (shape) {
    case Shape::triangle:
    case Shape::tetrahedron:
    case Shape::pyramid:
      return i + j + k <= degree;
    case Shape::prism:
      return i + j <= degree;
    default:
      return true;
  }
}

TEST(Gauss, IsTheTwoPointRuleOfTheTextbook) {
  const Quadrature rule = gauss_legendre(2);
  const double x = (1 - 1 / std::numbers::sqrt3) / 2;
  ASSERT_EQ(rule.points.size(), 2U);
  EXPECT_NEAR(rule.points[0][0], x, 1e-16);
  EXPECT_NEAR(rule.points[1][0], 1 - x, 1e-16);
  EXPECT_DOUBLE_EQ(rule.weights[0], 0.5);
}

TEST(Gauss, IntegratesEveryMonomialOfItsDegree) {
  constexpr double k_rounding = 1e-14;  // of a sum of up to 1331 terms with the total 1
  for (Shape shape : test::k_shapes) {
    const int dim = dimension(shape);
    for (int degree : {0, 1, 2, 3, 4, 5, 6, 7, 9, 12, 15, 20}) {
      const Quadrature& rule = gauss(shape, degree);
      const int step =
          degree > 10 ? 4 : 1;  // a sample of the exponents is enough when they are many
      for (int k = 0; k <= (dim == 3 ? degree : 0); k += step) {
        for (int j = 0; j <= (dim >= 2 ? degree : 0); j += step) {
          for (int i = 0; i <= degree; i += step) {
            if (!in_reach(shape, degree, i, j, k)) continue;
            EXPECT_NEAR(integrate(rule, i, j, k), exact(shape, i, j, k), k_rounding)
                << name(shape) << ' ' << degree << ": " << i << j << k;
          }
        }
      }
    }
  }
}

TEST(Gauss, HasPositiveWeightsAndPointsInside) {
  for (Shape shape : test::k_shapes) {
    for (int degree = 0; degree <= 20; ++degree) {
      const Quadrature& rule = gauss(shape, degree);
      ASSERT_EQ(rule.points.size(), rule.weights.size());
      for (double w : rule.weights) EXPECT_GT(w, 0.0);
      for (const Vec3& x : rule.points) {
        for (int d = 0; d < 3; ++d) {
          if (d < dimension(shape)) {
            EXPECT_GT(x[d], 0.0);
            EXPECT_LT(x[d], 1.0);
          } else {
            EXPECT_EQ(x[d], 0.0);
          }
        }
        if (shape == Shape::triangle || shape == Shape::prism) {
          EXPECT_LT(x[0] + x[1], 1.0);
        }
        if (shape == Shape::tetrahedron) {
          EXPECT_LT(x.sum(), 1.0);
        }
        if (shape == Shape::pyramid) {
          EXPECT_LT(std::max(x[0], x[1]) + x[2], 1.0);
        }
      }
    }
  }
}

TEST(Gauss, FindsMeasureAndCentroidOfTheReferenceShapes) {
  for (Shape shape : test::k_shapes) {
    const Quadrature& rule = gauss(shape, 1);
    Vec3 moment = Vec3::Zero();
    for (std::size_t q = 0; q < rule.points.size(); ++q) moment += rule.weights[q] * rule.points[q];
    const double measure = std::accumulate(rule.weights.begin(), rule.weights.end(), 0.0);
    EXPECT_NEAR(measure, reference_measure(shape), 1e-15);
    EXPECT_LT((moment / measure - reference_centroid(shape)).norm(), 1e-15) << name(shape);
  }
}

TEST(Gauss, IntegratesThePyramidsRationalFunctions) {
  // x y/(1-z) = a b (1-z) on the collapsed cube: 1/4 int (1-z)^3 dz = 1/16.
  const Quadrature& rule = gauss(Shape::pyramid, 2);
  double sum = 0;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const Vec3& x = rule.points[q];
    sum += rule.weights[q] * x[0] * x[1] / (1 - x[2]);
  }
  EXPECT_NEAR(sum, 1.0 / 16.0, 1e-16);
}

TEST(Gauss, ConvergesOnAFunctionThatIsNoPolynomial) {
  const auto error = [](int n) {
    const Quadrature rule = gauss_legendre(n);
    double sum = 0;
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      sum += rule.weights[q] * std::exp(rule.points[q][0]);
    }
    return std::abs(sum - (std::numbers::e - 1));
  };
  EXPECT_GT(error(2), 1e-4);
  EXPECT_LT(error(4), 1e-8);
  EXPECT_LT(error(8), 1e-15);
  EXPECT_LT(error(31), 1e-15);
}

TEST(Gauss, RefusesDegreesItHasNoRuleFor) {
  EXPECT_THROW(static_cast<void>(gauss(Shape::line, -1)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(gauss(Shape::line, 62)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(gauss_legendre(0)), std::invalid_argument);
}

TEST(SixthOrder, IsDunavantsTwelvePointsOnTheTriangle) {
  const Quadrature& rule = sixth_order(Shape::triangle);
  ASSERT_EQ(rule.points.size(), 12U);
  for (int i = 0; i <= 6; ++i) {
    for (int j = 0; i + j <= 6; ++j) {
      EXPECT_NEAR(integrate(rule, i, j, 0), exact(Shape::triangle, i, j, 0), 1e-15) << i << j;
    }
  }
  EXPECT_GT(std::abs(integrate(rule, 7, 0, 0) - exact(Shape::triangle, 7, 0, 0)), 1e-8);
  for (const Vec3& x : rule.points) EXPECT_GT(std::min({x[0], x[1], 1 - x[0] - x[1]}), 0.0);
}

TEST(SixthOrder, IsFourGaussPointsADirectionOnQuadrilateralsAndLines) {
  EXPECT_EQ(sixth_order(Shape::quadrilateral).points.size(), 16U);
  EXPECT_EQ(sixth_order(Shape::line).points.size(), 4U);
  EXPECT_NEAR(integrate(sixth_order(Shape::quadrilateral), 7, 6, 0), 1.0 / 56.0, 1e-16);
  EXPECT_THROW(static_cast<void>(sixth_order(Shape::tetrahedron)), std::invalid_argument);
}

}  // namespace
}  // namespace camber
