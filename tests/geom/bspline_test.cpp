#include <camber/base/error.hpp>
#include <camber/geom/bspline.hpp>

#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace camber {
namespace {

BsplineSurface wavy_patch() {
  std::vector<Vec3> poles;
  std::vector<double> weights;
  for (int i = 0; i < 6; ++i) {
    for (int j = 0; j < 5; ++j) {
      poles.emplace_back(0.2 * i, 0.25 * j, 0.1 * std::sin(1.3 * i) * std::cos(0.9 * j));
      weights.push_back(1.0 + 0.3 * ((i * 7 + j * 3) % 4));
    }
  }
  return {BsplineBasis(3, {0, 0, 0, 0, 0.3, 0.7, 1, 1, 1, 1}),
          BsplineBasis(2, {0, 0, 0, 0.5, 0.5, 1, 1, 1}), poles, weights};
}

TEST(BsplineBasis, OfDegreeOneIsTheHatFunction) {
  const BsplineBasis basis(1, {0, 0, 1, 3, 3});
  BsplineBasis::Values values;
  const int start = basis.first_pole(2.5);
  basis.evaluate(start, 2.5, values);

  // Between knots 1 and 3 at 2.5: (3 - 2.5)/2 and (2.5 - 1)/2, slopes -+1/2.
  EXPECT_EQ(start, 1);
  EXPECT_DOUBLE_EQ(values.n[0], 0.25);
  EXPECT_DOUBLE_EQ(values.n[1], 0.75);
  EXPECT_DOUBLE_EQ(values.dn[0], -0.5);
  EXPECT_DOUBLE_EQ(values.dn[1], 0.5);
  EXPECT_DOUBLE_EQ(values.ddn[0], 0.0);
}

TEST(BsplineBasis, SumsToOneAndItsDerivativesToZero) {
  const BsplineBasis basis(4, {0, 0, 0, 0, 0, 0.1, 0.4, 0.4, 0.9, 1, 1, 1, 1, 1});
  BsplineBasis::Values values;
  for (int k = 0; k <= 50; ++k) {
    const double t = k / 50.0;
    basis.evaluate(basis.first_pole(t), t, values);
    double sum = 0.0, slope = 0.0, curvature = 0.0;
    for (int i = 0; i <= 4; ++i) {
      EXPECT_GE(values.n[i], -1e-15);
      sum += values.n[i];
      slope += values.dn[i];
      curvature += values.ddn[i];
    }
    EXPECT_NEAR(sum, 1.0, 1e-14);
    EXPECT_NEAR(slope, 0.0, 1e-11);
    EXPECT_NEAR(curvature, 0.0, 1e-9);
  }
}

TEST(BsplineBasis, PicksTheTrueSpanAtKnotsAndBeyondTheEnds) {
  const BsplineBasis basis(2, {0, 0, 0, 1, 1, 2, 2, 2});
  EXPECT_EQ(basis.first_pole(-1.0), 0);
  EXPECT_EQ(basis.first_pole(0.0), 0);
  EXPECT_EQ(basis.first_pole(1.0), 2);
  EXPECT_EQ(basis.first_pole(2.0), 2);
  EXPECT_EQ(basis.first_pole(5.0), 2);
}

TEST(BsplineBasis, RefusesKnotsThatDoNotFit) {
  EXPECT_THROW(BsplineBasis(3, {0, 0, 1, 1}), GeometryError);
  EXPECT_THROW(BsplineBasis(1, {0, 1, 0, 1}), GeometryError);
  EXPECT_THROW(BsplineBasis(0, {0, 1}), GeometryError);
}

TEST(BsplineCurve, OfARationalQuarterIsACircle) {
  const double w = std::numbers::sqrt2 / 2.0;
  const Vec3 poles[3] = {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const double weights[3] = {1.0, w, 1.0};
  const BsplineCurve curve(BsplineBasis(2, {0, 0, 0, 1, 1, 1}), poles, weights);
  for (int k = 0; k <= 20; ++k) {
    const CurveJet jet = curve.jet(k / 20.0);
    EXPECT_NEAR(jet.c.norm(), 1.0, 1e-15);
    EXPECT_NEAR(jet.c.dot(jet.ct), 0.0, 1e-14);  // the tangent is across the radius
    // |c|^2 = 1 differentiated twice: c'.c' + c.c'' = 0.
    EXPECT_NEAR(jet.ct.squaredNorm() + jet.c.dot(jet.ctt), 0.0, 1e-13);
  }
}

TEST(BsplineSurface, ReproducesThePolynomialOfABezierPatch) {
  // Poles of the bilinear map x = u, y = v, z = u v, raised to biquadratic: P_ij = (i/2, j/2, i
  // j/4).
  std::vector<Vec3> poles;
  for (int i = 0; i < 3; ++i)
    for (int j = 0; j < 3; ++j) poles.emplace_back(0.5 * i, 0.5 * j, 0.25 * i * j);
  const BsplineBasis basis(2, {0, 0, 0, 1, 1, 1});
  const SurfaceJet jet = BsplineSurface(basis, basis, poles).jet({0.3, 0.6});
  EXPECT_LT((jet.s - Vec3(0.3, 0.6, 0.18)).norm(), 1e-15);
  EXPECT_LT((jet.su - Vec3(1.0, 0.0, 0.6)).norm(), 1e-15);
  EXPECT_LT((jet.sv - Vec3(0.0, 1.0, 0.3)).norm(), 1e-15);
  EXPECT_LT((jet.suv - Vec3(0.0, 0.0, 1.0)).norm(), 1e-14);
  EXPECT_LT(jet.suu.norm() + jet.svv.norm(), 1e-14);
}

TEST(BsplineSurface, HasTheDerivativesOfItsDifferences) {
  const BsplineSurface patch = wavy_patch();
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(0.01, 0.99);
  const double h = 1e-5;
  for (int k = 0; k < 40; ++k) {
    Vec2 uv(uniform(random), uniform(random));
    if (std::abs(uv[1] - 0.5) < 2 * h)
      uv[1] += 0.1;  // a kink: v = 1/2 is a double knot of degree 2
    const SurfaceJet jet = patch.jet(uv);
    const Vec2 du(h, 0), dv(0, h);
    const SurfaceJet u1 = patch.jet(uv + du), u0 = patch.jet(uv - du);
    const SurfaceJet v1 = patch.jet(uv + dv), v0 = patch.jet(uv - dv);
    EXPECT_LT((jet.su - (u1.s - u0.s) / (2 * h)).norm(), 1e-8);
    EXPECT_LT((jet.sv - (v1.s - v0.s) / (2 * h)).norm(), 1e-8);
    EXPECT_LT((jet.suu - (u1.su - u0.su) / (2 * h)).norm(), 1e-6);
    EXPECT_LT((jet.suv - (v1.su - v0.su) / (2 * h)).norm(), 1e-6);
    EXPECT_LT((jet.svv - (v1.sv - v0.sv) / (2 * h)).norm(), 1e-6);
  }
}

TEST(BsplineSurface, RefusesTheWrongNumberOfPoles) {
  const BsplineBasis basis(1, {0, 0, 1, 1});
  const std::vector<Vec3> three(3, Vec3::Zero());
  EXPECT_THROW(BsplineSurface(basis, basis, three), GeometryError);
}

TEST(Periods, AreTakenOffTowardsTheWantedPlace) {
  EXPECT_DOUBLE_EQ(nearest_period(6.2, 0.1, 6.0), 0.2 + 6.0 - 6.0);
  EXPECT_DOUBLE_EQ(nearest_period(6.2, 0.1, 0.0), 6.2);
  EXPECT_DOUBLE_EQ(wrap_period(-1.0, 0.0, 6.0), 5.0);
  EXPECT_DOUBLE_EQ(wrap_period(6.0, 0.0, 6.0), 0.0);
  EXPECT_LT(wrap_period(-1e-17, 0.0, 6.0), 6.0);
}

}  // namespace
}  // namespace camber
