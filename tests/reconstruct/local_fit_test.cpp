#include <camber/reconstruct/detail/local_fit.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace camber::detail {
namespace {

/// A height function of degree 4 over the plane of u and v, through the origin.
Vec3 quartic(double u, double v) {
  return {u, v, 0.3 * u * u - 0.2 * u * v + 0.1 * v * v * v + 0.05 * u * u * v * v};
}

std::vector<Vec3> points_around(int n, double width, double height) {
  std::vector<Vec3> points;
  for (int j = -n; j <= n; ++j) {
    for (int i = -n; i <= n; ++i) {
      if (i != 0 || j != 0) points.push_back(quartic(width * i, height * j));
    }
  }
  std::stable_sort(points.begin(), points.end(),
                   [](const Vec3& a, const Vec3& b) { return a.norm() < b.norm(); });
  return points;
}

TEST(SurfaceFit, ReproducesAHeightFunctionOfItsDegree) {
  for (double height : {0.1, 1e-3}) {  // thin neighbourhoods too
    const SurfaceFit fit =
        fit_surface_at(Vec3::Zero(), Vec3::UnitZ(), points_around(2, 0.1, height), 8);
    EXPECT_EQ(fit.degree, 4);
    for (const auto& [u, v] : {std::pair{0.5, 0.5}, {-1.3, 0.7}, {0.1, -1.9}}) {
      const Vec3 x = quartic(0.1 * u, height * v);
      EXPECT_NEAR((fit.above(x - Vec3(0.0, 0.0, 0.3)) - x).norm(), 0.0, 1e-12);
    }
    EXPECT_EQ(fit.above(Vec3::Zero()), Vec3::Zero());
  }
}

TEST(SurfaceFit, LowersItsDegreeWithItsPoints) {
  const std::vector<Vec3> all = points_around(2, 0.1, 0.1);
  EXPECT_EQ(fit_surface_at(Vec3::Zero(), Vec3::UnitZ(), {all.data(), 12}, 8).degree, 3);
  EXPECT_EQ(fit_surface_at(Vec3::Zero(), Vec3::UnitZ(), {all.data(), 7}, 7).degree, 2);
  std::vector<Vec3> row;  // in one direction only
  for (int i = 1; i < 30; ++i) row.push_back(quartic(0.1 * i, 0.0));
  const SurfaceFit flat = fit_surface_at(Vec3::Zero(), Vec3::UnitZ(), row, 2);
  EXPECT_EQ(flat.degree, 0);
  EXPECT_EQ(flat.above({0.3, 0.2, 1.0}), Vec3(0.3, 0.2, 1.0));
}

TEST(CurveFit, ReproducesACurveOfItsDegreeAlsoFromOneSide) {
  const auto x = [](double t) { return Vec3(t, 0.2 * t * t - 0.1 * t * t * t * t, 0.3 * t * t); };
  std::vector<Vec3> before, after;
  for (int i = 1; i <= 5; ++i) {
    before.push_back(x(-0.1 * i));
    after.push_back(x(0.1 * i));
  }
  const CurveFit both = fit_curve_at(Vec3::Zero(), {before.data(), 3}, {after.data(), 3});
  EXPECT_EQ(both.degree, 4);
  EXPECT_NEAR((both.beside(x(0.05)) - x(0.05)).norm(), 0.0, 1e-13);

  double last = 0.0;
  for (double h : {0.1, 0.05, 0.025}) {  // the tangent is the first chord's: no exact polynomial
    std::vector<Vec3> ahead;
    for (int i = 1; i <= 5; ++i) ahead.push_back(x(h * i));
    const CurveFit fit = fit_curve_at(Vec3::Zero(), {}, ahead);
    const Vec3 foot = fit.beside(x(0.5 * h));
    double error = 1e300;
    for (int k = 0; k <= 20000; ++k) error = std::min(error, (foot - x(h * k / 20000.0)).norm());
    if (last > 0.0) {
      EXPECT_GT(std::log2(last / error), 2.5) << h << " " << error;
    }
    last = error;
  }
}

}  // namespace
}  // namespace camber::detail
