#include <camber/smooth/lbfgs.hpp>

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

namespace camber {
namespace {

/// A symmetric positive definite matrix with eigenvalues from 1 to `condition`.
MatX random_spd(Eigen::Index n, double condition, std::mt19937& random) {
  std::normal_distribution<double> normal;
  MatX R(n, n);
  for (Eigen::Index i = 0; i < n * n; ++i) R(i % n, i / n) = normal(random);
  const MatX Q = Eigen::HouseholderQR<MatX>(R).householderQ();
  VecX values(n);
  for (Eigen::Index i = 0; i < n; ++i) {
    values[i] = std::pow(condition, static_cast<double>(i) / static_cast<double>(n - 1));
  }
  return Q * values.asDiagonal() * Q.transpose();
}

double rosenbrock(const VecX& x, VecX& g) {
  const double a = 1.0 - x[0], b = x[1] - x[0] * x[0];
  g.resize(2);
  g << -2.0 * a - 400.0 * x[0] * b, 200.0 * b;
  return a * a + 100.0 * b * b;
}

TEST(Lbfgs, FindsTheMinimumOfAParabolaInOneStepWithItsHessian) {
  VecX x(1);
  x << 5.0;
  int calls = 0;
  // f = 2 (x - 3)^2, f'' = 4.
  const auto f = [&](const VecX& y, VecX& g) {
    ++calls;
    g.resize(1);
    g[0] = 4.0 * (y[0] - 3.0);
    return 2.0 * (y[0] - 3.0) * (y[0] - 3.0);
  };

  const int iterations = minimise_lbfgs(f, x, DiagonalHessian(VecX::Constant(1, 0.25)), {});

  EXPECT_EQ(x[0], 3.0);
  EXPECT_EQ(iterations, 1);
  EXPECT_EQ(calls, 2);
}

TEST(Lbfgs, SolvesAConvexQuadratic) {
  std::mt19937 random(1);
  const MatX A = random_spd(20, 100.0, random);
  const VecX solution = VecX::LinSpaced(20, -1.0, 2.0);
  const VecX b = A * solution;
  VecX x = VecX::Zero(20);
  LbfgsOptions options;
  options.max_iterations = 200;

  const int iterations = minimise_lbfgs(
      [&](const VecX& y, VecX& g) {
        g = A * y - b;
        return 0.5 * y.dot(A * y) - b.dot(y);
      },
      x, DiagonalHessian(VecX::Ones(20)), options);

  EXPECT_LT((x - solution).norm(), 1e-5 * solution.norm());
  EXPECT_LT(iterations, 100);
}

TEST(Lbfgs, FollowsTheValleyOfRosenbrock) {
  VecX x(2);
  x << -1.2, 1.0;

  const int iterations = minimise_lbfgs(rosenbrock, x, DiagonalHessian(VecX::Ones(2)), {});

  EXPECT_LT((x - VecX::Ones(2)).norm(), 1e-6);
  EXPECT_LT(iterations, 60);
}

TEST(Lbfgs, DoesNotDependOnTheUnitsThatItsDiagonalKnows) {
  std::mt19937 random(2);
  const MatX A = random_spd(10, 50.0, random);
  const VecX b = VecX::LinSpaced(10, 1.0, 3.0);
  VecX units(10);
  for (Eigen::Index i = 0; i < 10; ++i)
    units[i] = std::pow(2.0, static_cast<double>(i % 5) * 4.0 - 8.0);
  const auto run = [&](const VecX& unit) {
    VecX x = VecX::Zero(10);
    LbfgsOptions options;
    options.max_iterations = 15;
    minimise_lbfgs(
        [&](const VecX& y, VecX& g) {
          const VecX z = unit.cwiseProduct(y);
          g = unit.cwiseProduct(A * z - b);
          return 0.5 * z.dot(A * z) - b.dot(z);
        },
        x, DiagonalHessian(unit.array().square().inverse().matrix()), options);
    return VecX(unit.cwiseProduct(x));
  };

  EXPECT_LT((run(units) - run(VecX::Ones(10))).norm(), 1e-10);
}

TEST(Lbfgs, StaysWhereTheObjectiveIsDefined) {
  // f = x - log x for x > 0, minimum at 1; the unit step from 1e-3 would be right, from 50 it is
  // far too long.
  for (double start : {1e-3, 0.5, 50.0}) {
    VecX x(1);
    x << start;
    minimise_lbfgs(
        [&](const VecX& y, VecX& g) {
          if (y[0] <= 0.0) return std::numeric_limits<double>::infinity();
          g.resize(1);
          g[0] = 1.0 - 1.0 / y[0];
          return y[0] - std::log(y[0]);
        },
        x, DiagonalHessian(VecX::Constant(1, 100.0)), {});
    EXPECT_NEAR(x[0], 1.0, 1e-6) << "from " << start;
  }
}

TEST(Lbfgs, LeavesAStartAloneThatIsUndefinedOrStationary) {
  VecX x = VecX::Constant(2, 7.0);
  EXPECT_EQ(
      minimise_lbfgs([](const VecX&, VecX&) { return std::numeric_limits<double>::infinity(); }, x,
                     DiagonalHessian(VecX::Ones(2)), {}),
      0);
  EXPECT_EQ(x, VecX::Constant(2, 7.0));

  VecX minimum = VecX::Ones(2);
  EXPECT_EQ(minimise_lbfgs(rosenbrock, minimum, DiagonalHessian(VecX::Ones(2)), {}), 0);
  EXPECT_EQ(minimum, VecX::Ones(2));
}

TEST(Lbfgs, StopsWhenToldAndAfterTheIterationsAllowed) {
  LbfgsOptions options;
  options.max_iterations = 5;
  VecX x(2);
  x << -1.2, 1.0;
  EXPECT_EQ(minimise_lbfgs(rosenbrock, x, DiagonalHessian(VecX::Ones(2)), options), 5);

  x << -1.2, 1.0;
  options.max_iterations = 100;
  VecX g;
  minimise_lbfgs(rosenbrock, x, DiagonalHessian(VecX::Ones(2)), options,
                 [&](const VecX& y) { return rosenbrock(y, g) < 1.0; });
  EXPECT_LT(rosenbrock(x, g), 1.0);
  EXPECT_GT(rosenbrock(x, g), 1e-6);
}

TEST(Lbfgs, NeverStepsFartherThanTheLongestStep) {
  LbfgsOptions options;
  options.longest_step = 0.1;
  options.max_iterations = 20;
  VecX x = VecX::Constant(1, 10.0), last = x;
  minimise_lbfgs(
      [](const VecX& y, VecX& g) {
        g = y;
        return 0.5 * y.squaredNorm();
      },
      x, DiagonalHessian(VecX::Ones(1)), options,
      [&](const VecX& y) {
        EXPECT_LE((y - last).norm(), 0.1 * (1.0 + 1e-12));
        last = y;
        return false;
      });
  EXPECT_NEAR(x[0], 8.0, 1e-9);
}

}  // namespace
}  // namespace camber
