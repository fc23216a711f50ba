#include <camber/metric/biased_average.hpp>
#include <camber/metric/cost.hpp>
#include <camber/metric/shape_conformity.hpp>

#include <array>
#include <cmath>
#include <limits>
#include <random>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace camber {
namespace {

Mat3 random_matrix(std::mt19937& generator) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Mat3 A;
  for (int c = 0; c < 3; ++c) {
    for (int r = 0; r < 3; ++r) A(r, c) = uniform(generator);
  }
  return A;
}

TEST(Wcn, IsOneForTheIdealElementUpToScaleRotationAndReflection) {
  std::mt19937 generator(1);
  for (int trial = 0; trial < 50; ++trial) {
    const Mat3 W = random_matrix(generator);
    if (std::abs(W.determinant()) < 0.05) continue;
    const Mat3 R = Eigen::AngleAxisd(0.1 * trial, Vec3(1, 2, 3).normalized()).matrix();
    const Mat3 W_inv = W.inverse();

    EXPECT_NEAR((weighted_condition_number<double, 3>(2.5 * R * W, W_inv)), 1.0, 1e-10);
    EXPECT_NEAR((weighted_condition_number<double, 3>(-R * W, W_inv)), 1.0, 1e-10);
  }
}

TEST(Wcn, OfAStretchByHand) {
  // A = diag(2,1), W = 1: |A| = sqrt 5, |A^-1| = sqrt(1.25), product 2.5, over d = 2: 1.25.
  Mat<double, 2> A;
  A << 2, 0, 0, 1;
  const Mat<double, 2> one = Mat<double, 2>::Identity();
  EXPECT_NEAR((weighted_condition_number<double, 2>(A, one)), 1.25, 1e-15);
  // diag(2,1,1): sqrt 6 * sqrt 2.25 / 3 = 1.5 sqrt 6 / 3.
  const Mat3 B = Vec3(2, 1, 1).asDiagonal();
  EXPECT_NEAR((weighted_condition_number<double, 3>(B, Mat3::Identity())), 0.5 * std::sqrt(6.0),
              1e-15);
}

TEST(Wcn, IsAtLeastOneAndInfiniteForASingularMatrix) {
  std::mt19937 generator(2);
  for (int trial = 0; trial < 200; ++trial) {
    EXPECT_GE((weighted_condition_number<double, 3>(random_matrix(generator), Mat3::Identity())),
              1.0 - 1e-12);
  }
  EXPECT_EQ((weighted_condition_number<double, 3>(Mat3::Zero(), Mat3::Identity())),
            std::numeric_limits<double>::infinity());
}

TEST(NormalisedJacobian, IsTheRatioOfDeterminants) {
  std::mt19937 generator(3);
  for (int trial = 0; trial < 50; ++trial) {
    const Mat3 A = random_matrix(generator);
    const Mat3 W = random_matrix(generator) + 2.0 * Mat3::Identity();
    EXPECT_NEAR((normalized_jacobian<double, 3>(A, W.inverse())), A.determinant() / W.determinant(),
                1e-12);
  }
}

TEST(NormalisedJacobian, OfASurfaceIsTheAreaRatioWithTheSignOfTheTurn) {
  const Vec3 N(0, 0, 2);
  EXPECT_DOUBLE_EQ(surface_normalized_jacobian<double>(Vec3(0, 0, 4), N), 2.0);
  EXPECT_DOUBLE_EQ(surface_normalized_jacobian<double>(Vec3(0, 3, 4), N), 2.5);
  EXPECT_DOUBLE_EQ(surface_normalized_jacobian<double>(Vec3(0, 3, -4), N), -2.5);
}

TEST(Cost, ByHand) {
  EXPECT_DOUBLE_EQ(cost(1.0, 1.0), 1.0);
  EXPECT_DOUBLE_EQ(cost(5.0, 2.0), 0.5);  // capped at 1
  EXPECT_DOUBLE_EQ(cost(0.5, 2.0), 0.25);
  EXPECT_DOUBLE_EQ(cost(0.0, 2.0), 0.0);
  EXPECT_DOUBLE_EQ(cost(-3.0, 2.0), -3.0);  // inverted: tau itself
}

TEST(Cost, OfAScaledRotationIsTheCappedVolumeRatio) {
  const Mat3 R = Eigen::AngleAxisd(0.4, Vec3(1, 1, 0).normalized()).matrix();
  EXPECT_NEAR((cost<double, 3>(0.5 * R, Mat3::Identity())), 0.125, 1e-14);
  EXPECT_NEAR((cost<double, 3>(2.0 * R, Mat3::Identity())), 1.0, 1e-14);
  EXPECT_NEAR((cost<double, 3>(-R, Mat3::Identity())), -1.0, 1e-14);
}

TEST(Cost, DualDerivativesAgreeWithCentralDifferences) {
  using D9 = Dual<9>;
  std::mt19937 generator(4);
  const double h = 1e-6;
  int compared = 0;
  for (int trial = 0; trial < 60; ++trial) {
    const Mat3 A = Mat3::Identity() + 0.6 * random_matrix(generator);
    const Mat3 W_inv = (Mat3::Identity() + 0.2 * random_matrix(generator)).inverse();
    const double tau = normalized_jacobian<double, 3>(A, W_inv);
    if (std::abs(tau - 1.0) < 1e-2 || std::abs(tau) < 1e-2) continue;  // at a kink
    Mat<D9, 3> dual;
    for (int i = 0; i < 9; ++i) dual(i % 3, i / 3) = D9::variable(A(i % 3, i / 3), i);

    const D9 C = cost<D9, 3>(dual, W_inv);

    EXPECT_NEAR(C.v, (cost<double, 3>(A, W_inv)), 1e-14);
    for (int i = 0; i < 9; ++i) {
      Mat3 up = A, down = A;
      up(i % 3, i / 3) += h;
      down(i % 3, i / 3) -= h;
      EXPECT_NEAR(C.d[static_cast<std::size_t>(i)],
                  ((cost<double, 3>(up, W_inv)) - (cost<double, 3>(down, W_inv))) / (2 * h), 1e-6);
    }
    ++compared;
  }
  EXPECT_GT(compared, 30);
}

TEST(BiasedAverage, ByHand) {
  // Costs 0.2, 0.4, 0.9: minimum 0.2, mean 0.5; 0.2 * 0.8 + 0.5 * 0.2 = 0.26.
  const std::array<double, 3> costs{0.2, 0.4, 0.9};
  EXPECT_NEAR(biased_average(costs), 0.26, 1e-15);
  // A minimum of 1 leaves the mean, a minimum of 0 or below the minimum.
  EXPECT_DOUBLE_EQ(biased_average(1.0, 1.0, 3.0), 3.0);
  EXPECT_DOUBLE_EQ(biased_average(0.0, 7.0, 3.0), 7.0);
  EXPECT_DOUBLE_EQ(biased_average(std::array<double, 2>{-2.0, 1.0}), -2.0);
}

TEST(BiasedAverage, OfVectorsUsesTheCostOfTheMinimum) {
  const Vec3 F = biased_average<double, Vec3>(0.25, Vec3(4, 0, 0), Vec3(0, 8, 0));
  EXPECT_NEAR((F - Vec3(3, 2, 0)).norm(), 0.0, 1e-15);
}

TEST(BiasedAverage, LiesBetweenMinimumAndMean) {
  std::mt19937 generator(5);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  for (int trial = 0; trial < 100; ++trial) {
    std::array<double, 6> costs;
    double sum = 0.0;
    for (double& c : costs) sum += c = uniform(generator);
    const double F = biased_average(costs);
    EXPECT_GE(F, *std::min_element(costs.begin(), costs.end()));
    EXPECT_LE(F, sum / 6.0);
  }
}

TEST(ShapeConformity, IsTheAreaWeightedMeanDistance) {
  // 0.1 over area 1 and 0.4 over area 3: (0.1 + 1.2) / 4 = 0.325.
  const std::array<double, 2> distance{0.1, 0.4}, area{1.0, 3.0};

  ShapeConformity face = shape_conformity(distance, area);

  EXPECT_NEAR(face.average(), 0.325, 1e-15);
  EXPECT_DOUBLE_EQ(face.maximum, 0.4);
  // Together with a face of the same area that lies on the surface the mean halves.
  face.add({0.0, 4.0, 0.0});
  EXPECT_NEAR(face.average(), 0.1625, 1e-15);
  EXPECT_EQ(ShapeConformity{}.average(), 0.0);
}

}  // namespace
}  // namespace camber
