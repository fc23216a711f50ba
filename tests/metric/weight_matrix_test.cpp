#include <camber/metric/weight_matrix.hpp>
#include <camber/metric/weighted_condition_number.hpp>

#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace camber {
namespace {

using Tet = std::array<Vec3, 4>;

Tet random_tet(std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Tet x;
  for (Vec3& v : x) v = Vec3(uniform(generator), uniform(generator), uniform(generator));
  return x;
}

std::array<double, 6> lengths(const Tet& x) {
  const auto l = [&](std::size_t a, std::size_t b) { return (x[a] - x[b]).norm(); };
  return {l(0, 1), l(0, 2), l(0, 3), l(1, 2), l(1, 3), l(2, 3)};
}

TEST(WeightMatrix, OfARightTriangleByHand) {
  // Legs 3 and 4 at vertex 0, hypotenuse 5.
  const Mat<double, 2> W = triangle_weight_matrix<double>({3.0, 4.0, 5.0});

  EXPECT_DOUBLE_EQ(W(0, 0), 3.0);
  EXPECT_NEAR(W(0, 1), 0.0, 1e-15);
  EXPECT_EQ(W(1, 0), 0.0);
  EXPECT_DOUBLE_EQ(W(1, 1), 4.0);
}

TEST(WeightMatrix, OfTheRegularTetrahedronByHand) {
  const Mat3 W = tetrahedron_weight_matrix<double>({1, 1, 1, 1, 1, 1});

  EXPECT_DOUBLE_EQ(W(0, 1), 0.5);
  EXPECT_DOUBLE_EQ(W(1, 1), std::sqrt(3.0) / 2.0);
  EXPECT_DOUBLE_EQ(W(0, 2), 0.5);
  EXPECT_NEAR(W(1, 2), std::sqrt(3.0) / 6.0, 1e-15);
  EXPECT_NEAR(W(2, 2), std::sqrt(2.0 / 3.0), 1e-15);
  EXPECT_NEAR(W.determinant(), 1.0 / std::sqrt(2.0), 1e-15);  // 6 * sqrt(2)/12
}

TEST(WeightMatrix, EqualsTheEdgeMatrixUpToARotation) {
  std::mt19937 generator(1);
  int compared = 0;
  for (int trial = 0; trial < 100; ++trial) {
    const Tet x = random_tet(generator);
    const Mat3 A = edge_matrix<double, 3>({x[0], x[1], x[2], x[3]});
    if (std::abs(A.determinant()) < 0.05) continue;

    const Mat3 W = tetrahedron_weight_matrix<double>(lengths(x));

    // Same Gram matrix; A W^-1 is orthogonal; same volume.
    EXPECT_NEAR((W.transpose() * W - A.transpose() * A).norm(), 0.0, 1e-12);
    const Mat3 Q = A * W.inverse();
    EXPECT_NEAR((Q.transpose() * Q - Mat3::Identity()).norm(), 0.0, 1e-9);
    EXPECT_NEAR(W.determinant(), std::abs(A.determinant()), 1e-12);
    EXPECT_NEAR((weighted_condition_number<double, 3>(A, W.inverse())), 1.0, 1e-9);
    ++compared;
  }
  EXPECT_GT(compared, 50);
}

TEST(WeightMatrix, OfATriangleInSpaceIsItsOwnPlane) {
  std::mt19937 generator(2);
  for (int trial = 0; trial < 50; ++trial) {
    const Tet x = random_tet(generator);
    const Vec3 a = x[1] - x[0], b = x[2] - x[0];

    const Mat<double, 2> W =
        triangle_weight_matrix<double>({a.norm(), b.norm(), (x[2] - x[1]).norm()});

    EXPECT_NEAR(W.determinant(), a.cross(b).norm(), 1e-7);
    EXPECT_NEAR(W.col(0).dot(W.col(1)), a.dot(b), 1e-13);
  }
}

TEST(WeightMatrix, OfAFlatTriangleHasNoArea) {
  EXPECT_EQ(triangle_weight_matrix<double>({1.0, 1.0, 2.0}).determinant(), 0.0);
  EXPECT_EQ(triangle_weight_matrix<double>({1.0, 1.0, 3.0}).determinant(), 0.0);
}

TEST(WeightMatrix, DualDerivativesAgreeWithCentralDifferences) {
  using D6 = Dual<6>;
  const std::array<double, 6> l{1.0, 1.1, 0.9, 1.2, 1.05, 0.95};
  std::array<D6, 6> dual;
  for (int i = 0; i < 6; ++i) {
    dual[static_cast<std::size_t>(i)] = D6::variable(l[static_cast<std::size_t>(i)], i);
  }
  const double h = 1e-6;

  const D6 volume = tetrahedron_weight_matrix<D6>(dual).determinant();

  for (std::size_t i = 0; i < 6; ++i) {
    std::array<double, 6> up = l, down = l;
    up[i] += h;
    down[i] -= h;
    EXPECT_NEAR(volume.d[i],
                (tetrahedron_weight_matrix<double>(up).determinant() -
                 tetrahedron_weight_matrix<double>(down).determinant()) /
                    (2 * h),
                1e-8);
  }
}

}  // namespace
}  // namespace camber
