#include <camber/dual/dual.hpp>
#include <camber/dual/scalar.hpp>

#include <cmath>
#include <functional>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace camber {
namespace {

using D2 = Dual<2>;

D2 x(double v) { return D2::variable(v, 0); }
D2 y(double v) { return D2::variable(v, 1); }

void expect_dual(const D2& a, double v, double dx, double dy) {
  EXPECT_DOUBLE_EQ(a.v, v);
  EXPECT_DOUBLE_EQ(a.d[0], dx);
  EXPECT_DOUBLE_EQ(a.d[1], dy);
}

TEST(DualNumber, FollowsTheRulesOfDifferentiationByHand) {
  // At x = 3, y = 2.
  expect_dual(x(3) + y(2), 5, 1, 1);
  expect_dual(x(3) - y(2), 1, 1, -1);
  expect_dual(x(3) * y(2), 6, 2, 3);          // (y, x)
  expect_dual(x(3) / y(2), 1.5, 0.5, -0.75);  // (1/y, -x/y^2)
  expect_dual(-x(3), -3, -1, 0);
  expect_dual(sqrt(x(4)), 2, 0.25, 0);  // 1/(2 sqrt(x))
  expect_dual(abs(-x(3)), 3, 1, 0);
  expect_dual(abs(x(3)), 3, 1, 0);
}

TEST(DualNumber, ConstantsHaveNoDerivative) {
  expect_dual(2.0 * x(3) + 1.0, 7, 2, 0);
  expect_dual(1.0 / x(4), 0.25, -0.0625, 0);
  expect_dual(D2(5.0), 5, 0, 0);
}

TEST(DualNumber, CompoundAssignmentIsTheOperator) {
  D2 a = x(3);
  a += y(2);
  expect_dual(a, 5, 1, 1);
  a -= 1.0;
  expect_dual(a, 4, 1, 1);
  a *= y(2);
  expect_dual(a, 8, 2, 6);  // (x + y - 1) y: (y, x + 2y - 1)
  a /= D2(2.0);
  expect_dual(a, 4, 1, 3);
}

TEST(DualNumber, MinAndMaxTakeTheBranchWithItsDerivatives) {
  expect_dual(min(x(3), y(2)), 2, 0, 1);
  expect_dual(max(x(3), y(2)), 3, 1, 0);
  expect_dual(min(x(2), y(2)), 2, 1, 0);  // the first of equals
  expect_dual(max(x(2), y(2)), 2, 1, 0);
}

TEST(DualNumber, ComparesByValue) {
  EXPECT_TRUE(x(1) < y(2));
  EXPECT_TRUE(x(2) == y(2));
  EXPECT_TRUE(x(2) >= 2.0);
  EXPECT_FALSE(x(std::numeric_limits<double>::quiet_NaN()) < 1.0);
}

TEST(DualNumber, SquareRootOfZeroIsZeroWhereNothingMoves) {
  expect_dual(sqrt(D2(0.0)), 0, 0, 0);
  EXPECT_EQ(sqrt(x(0.0)).d[0], std::numeric_limits<double>::infinity());
}

TEST(DualNumber, AgreesWithCentralDifferences) {
  const auto f = [](auto a, auto b) {
    using std::sqrt;
    return sqrt(a * a + b * b) / (a + 2.0 * b) - a * b + sqrt(b);
  };
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(0.5, 2.0);
  for (int trial = 0; trial < 100; ++trial) {
    const double a = uniform(generator), b = uniform(generator), h = 1e-5;

    const D2 dual = f(x(a), y(b));

    EXPECT_DOUBLE_EQ(dual.v, f(a, b));
    EXPECT_NEAR(dual.d[0], (f(a + h, b) - f(a - h, b)) / (2 * h), 1e-9);
    EXPECT_NEAR(dual.d[1], (f(a, b + h) - f(a, b - h)) / (2 * h), 1e-9);
  }
}

TEST(DualNumber, WorksInsideFixedSizeMatrices) {
  // d det(A) / dA = cofactor matrix.
  using D9 = Dual<9>;
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Mat<double, 3> A;
  Mat<D9, 3> dual;
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      A(r, c) = uniform(generator);
      dual(r, c) = D9::variable(A(r, c), 3 * c + r);
    }
  }
  const Mat<double, 3> cofactor = A.determinant() * A.inverse().transpose();

  const D9 det = dual.determinant();
  const D9 norm = frobenius_norm(dual);
  const Mat<D9, 3> identity = dual * dual.inverse();

  EXPECT_NEAR(value(det), A.determinant(), 1e-15);
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) {
      const auto i = static_cast<std::size_t>(3 * c + r);
      EXPECT_NEAR(det.d[i], cofactor(r, c), 1e-13);
      EXPECT_NEAR(norm.d[i], A(r, c) / A.norm(), 1e-14);
      EXPECT_NEAR(value(identity(r, c)), r == c ? 1.0 : 0.0, 1e-12);
      for (double d : identity(r, c).d) EXPECT_NEAR(d, 0.0, 1e-10);  // A A^-1 does not move
    }
  }
}

}  // namespace
}  // namespace camber
