#include <camber/dual/scalar.hpp>
#include <camber/smooth/distortion.hpp>

#include <array>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace camber {
namespace {

using Dual9 = Dual<9>;

/// The energy as its docstring has it, for any number type.
template <Scalar T>
T energy(const Mat<T, 3>& A, double delta) {
  using std::sqrt;
  Mat<T, 3> cof;
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) {
      const int a = (i + 1) % 3, b = (i + 2) % 3, c = (j + 1) % 3, d = (j + 2) % 3;
      cof(i, j) = A(a, c) * A(b, d) - A(a, d) * A(b, c);
    }
  }
  const T tau = A(0, 0) * cof(0, 0) + A(0, 1) * cof(0, 1) + A(0, 2) * cof(0, 2);
  const T h = T(0.5) * (tau + sqrt(tau * tau + T(4.0 * delta * delta)));
  const T norm = frobenius_norm(A), cof_norm = frobenius_norm(cof);
  return norm * norm * cof_norm * cof_norm / (T(9.0) * h * h) * (h + T(1.0) / h) / T(2.0);
}

Mat3 random_matrix(std::mt19937& random, double spread) {
  std::uniform_real_distribution<double> uniform(-spread, spread);
  Mat3 T = Mat3::Identity();
  for (int i = 0; i < 9; ++i) T(i % 3, i / 3) += uniform(random);
  return T;
}

Mat3 random_rotation(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Vec3 axis = Vec3(uniform(random), uniform(random), uniform(random) + 2.0).normalized();
  return Eigen::AngleAxisd(3.0 * uniform(random), axis).toRotationMatrix();
}

/// Spreads and regularisations from nearly rigid to inverted.
constexpr std::array<std::pair<double, double>, 4> k_ranges{
    {{0.1, 0.0}, {0.3, 0.0}, {1.0, 0.1}, {2.0, 0.5}}};

TEST(Distortion, IsOneForARotationAndNowhereLess) {
  std::mt19937 random(1);
  for (int k = 0; k < 100; ++k) {
    const Distortion rigid = distortion(random_rotation(random), 0.0);
    EXPECT_NEAR(rigid.energy, 1.0, 1e-14);
    EXPECT_LT(rigid.gradient.norm(), 1e-13);
    EXPECT_GE(distortion(random_matrix(random, 0.3), 0.0).energy, 1.0 - 1e-14);
  }
}

TEST(Distortion, OfAStretchByTwoAlongOneAxisIsFifteenEighths) {
  // |T|^2 = 4 + 1 + 1 = 6, |cof T|^2 = 1 + 4 + 4 = 9, h = 2: 54 / 36 * (2 + 1/2) / 2 = 1.875.
  EXPECT_NEAR(distortion(Vec3(2, 1, 1).asDiagonal(), 0.0).energy, 1.875, 1e-15);
}

TEST(Distortion, OfAScalingIsItsSizeTermAlone) {
  for (double s : {0.2, 0.5, 1.0, 3.0}) {
    const double h = s * s * s;
    EXPECT_NEAR(distortion(s * Mat3::Identity(), 0.0).energy / (0.5 * (h + 1.0 / h)), 1.0, 1e-14);
  }
}

TEST(Distortion, DoesNotSeeRotationsNorWhichMeshIsTheIdeal) {
  std::mt19937 random(2);
  for (int k = 0; k < 100; ++k) {
    const Mat3 T = random_matrix(random, 0.3);
    const double expected = distortion(T, 0.0).energy;
    const Mat3 turned = random_rotation(random) * T * random_rotation(random);
    EXPECT_NEAR(distortion(turned, 0.0).energy / expected, 1.0, 1e-12);
    EXPECT_NEAR(distortion(Mat3(T.inverse()), 0.0).energy / expected, 1.0, 1e-12);
  }
}

TEST(Distortion, HasTheGradientOfDualNumbers) {
  std::mt19937 random(3);
  for (const auto& [spread, delta] : k_ranges) {
    for (int k = 0; k < 50; ++k) {
      const Mat3 T = random_matrix(random, spread);
      if (delta == 0.0 && T.determinant() <= 0.0) continue;
      Mat<Dual9, 3> D;
      for (int i = 0; i < 9; ++i) D(i % 3, i / 3) = Dual9::variable(T(i % 3, i / 3), i);
      const Dual9 expected = energy<Dual9>(D, delta);

      const Distortion result = distortion(T, delta);

      EXPECT_NEAR(result.energy / expected.v, 1.0, 1e-10);
      for (int i = 0; i < 9; ++i) {
        EXPECT_NEAR(result.gradient(i % 3, i / 3), expected.d[static_cast<std::size_t>(i)],
                    1e-10 * result.gradient.norm());
      }
    }
  }
}

TEST(Distortion, HasTheGradientOfCentralDifferences) {
  std::mt19937 random(4);
  constexpr double k_step = 1e-5;
  for (int k = 0; k < 50; ++k) {
    const Mat3 T = random_matrix(random, 0.25);
    const Distortion result = distortion(T, 0.01);
    for (int i = 0; i < 9; ++i) {
      Mat3 up = T, down = T;
      up(i % 3, i / 3) += k_step;
      down(i % 3, i / 3) -= k_step;
      const double slope =
          (distortion(up, 0.01).energy - distortion(down, 0.01).energy) / (2.0 * k_step);
      EXPECT_NEAR(result.gradient(i % 3, i / 3), slope,
                  1e-6 * std::max(1.0, result.gradient.norm()));
    }
  }
}

TEST(Distortion, IsInfiniteAtInversionUnlessRegularised) {
  const Mat3 flat = Vec3(1, 1, 0).asDiagonal(), turned_over = Vec3(1, 1, -1).asDiagonal();
  for (const Mat3& T : {flat, turned_over}) {
    EXPECT_EQ(distortion(T, 0.0).energy, std::numeric_limits<double>::infinity());
    EXPECT_TRUE(std::isfinite(distortion(T, 0.1).energy));
    EXPECT_TRUE(distortion(T, 0.1).gradient.allFinite());
  }
  // The slope leads out: more det T, less energy.
  EXPECT_LT(distortion(turned_over, 0.1).gradient(2, 2), 0.0);
}

TEST(RegularisedDeterminant, TendsToTauAboveAndToItsInverseBelow) {
  EXPECT_EQ(regularised_determinant(0.7, 0.0), 0.7);
  EXPECT_EQ(regularised_determinant(-0.7, 0.0), 0.0);
  EXPECT_EQ(regularised_determinant(0.0, 0.25), 0.25);
  // h(tau) h(-tau) = delta^2, also where tau is a million deltas.
  for (double tau : {0.1, 1.0, 1e3, 1e6}) {
    const double product = regularised_determinant(tau, 1e-2) * regularised_determinant(-tau, 1e-2);
    EXPECT_NEAR(product / 1e-4, 1.0, 1e-14) << tau;
  }
}

}  // namespace
}  // namespace camber
