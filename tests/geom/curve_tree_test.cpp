#include <camber/geom/curve_tree.hpp>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

namespace camber {
namespace {

constexpr double k_pi = std::numbers::pi;
constexpr double k_infinity = std::numeric_limits<double>::infinity();

/// (a cos t, b sin t, 0), closed or a part of it.
class Ellipse final : public ParametricCurve {
 public:
  Ellipse(double a, double b, double first, double last)
      : a_(a), b_(b), first_(first), last_(last) {}
  CurveJet jet(double t) const override {
    return {{a_ * std::cos(t), b_ * std::sin(t), 0},
            {-a_ * std::sin(t), b_ * std::cos(t), 0},
            {-a_ * std::cos(t), -b_ * std::sin(t), 0}};
  }
  double first() const override { return first_; }
  double last() const override { return last_; }
  double period() const override { return last_ - first_ > 6.28 ? last_ - first_ : 0.0; }
  std::vector<double> breaks() const override { return {first_, last_}; }

 private:
  double a_, b_, first_, last_;
};

TEST(CurveTree, MeasuresACircle) {
  const Ellipse circle(2.0, 2.0, 0.0, 2.0 * k_pi);
  const CurveTree tree(circle);
  EXPECT_NEAR(tree.length(), 4.0 * k_pi, 1e-13);
  EXPECT_NEAR(tree.length_to(1.0), 2.0, 1e-14);
  EXPECT_NEAR(tree.length_to(1.0 + 2.0 * k_pi), 2.0 + 4.0 * k_pi, 1e-13);  // once round
  EXPECT_NEAR(tree.length_to(-1.0), -2.0, 1e-13);
}

TEST(CurveTree, MeasuresAnEllipseAsTheEllipticIntegral) {
  // Perimeter 4 a E(m), m = 1 - (b/a)^2; the complete integral from the standard library.
  const Ellipse ellipse(10.0, 1.0, 0.0, 2.0 * k_pi);
  const double expected = 40.0 * std::comp_ellint_2(std::sqrt(0.99));
  EXPECT_NEAR(CurveTree(ellipse).length(), expected, 1e-12 * expected);
}

TEST(CurveTree, FindsTheParameterOfALength) {
  const Ellipse ellipse(10.0, 1.0, 0.3, 3.0);
  const CurveTree tree(ellipse);
  for (int k = 0; k <= 20; ++k) {
    const double length = tree.length() * k / 20.0;
    EXPECT_NEAR(tree.length_to(tree.parameter_at(length)), length, 1e-13 * tree.length());
  }
  EXPECT_NEAR(tree.parameter_at(0.0), 0.3, 1e-12);
  EXPECT_NEAR(tree.parameter_at(tree.length()), 3.0, 1e-12);
}

TEST(CurveTree, FindsTheNearestPointOfAnEllipse) {
  const Ellipse ellipse(3.0, 1.0, 0.0, 2.0 * k_pi);
  const CurveTree tree(ellipse);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> uniform(-4.0, 4.0);
  for (int k = 0; k < 200; ++k) {
    const Vec3 x(uniform(random), uniform(random), 0.25 * uniform(random));
    double sampled = k_infinity;
    for (int i = 0; i < 4000; ++i)
      sampled = std::min(sampled, (ellipse.jet(2.0 * k_pi * i / 4000.0).c - x).norm());
    const auto foot = tree.nearest(x, k_infinity);
    ASSERT_TRUE(foot);
    EXPECT_LE(std::sqrt(foot->distance_squared), sampled + 1e-14);
    EXPECT_GE(std::sqrt(foot->distance_squared), sampled - 1e-3);
    EXPECT_LT(std::abs((foot->point - x).dot(ellipse.jet(foot->t).ct)), 1e-10);
  }
}

TEST(CurveTree, StopsAtTheEndsOfAnArc) {
  const Ellipse arc(1.0, 1.0, 0.0, 1.0);
  const CurveTree tree(arc);
  const auto foot = tree.nearest({1.0, -2.0, 0.0}, k_infinity);
  ASSERT_TRUE(foot);
  EXPECT_DOUBLE_EQ(foot->t, 0.0);
  EXPECT_DOUBLE_EQ(foot->distance_squared, 4.0);
  EXPECT_GT(foot->tangential, 1.0);  // not orthogonal: the arc's end
}

TEST(CurveTree, ReturnsNothingBeyondTheBound) {
  const Ellipse circle(1.0, 1.0, 0.0, 2.0 * k_pi);
  const CurveTree tree(circle);
  EXPECT_FALSE(tree.nearest({3.0, 0.0, 0.0}, 3.9));
  EXPECT_TRUE(tree.nearest({3.0, 0.0, 0.0}, 4.1));
}

TEST(FindFoot, ConvergesQuadraticallyFromASeed) {
  const Ellipse ellipse(3.0, 1.0, 0.0, 2.0 * k_pi);
  const double t = 0.7;
  const CurveJet jet = ellipse.jet(t);
  const Vec3 normal = Vec3(-jet.ct[1], jet.ct[0], 0.0).normalized();
  const CurveFoot foot = find_foot(ellipse, jet.c - 0.2 * normal, t + 0.1, 0.0, 2.0 * k_pi, 6.0);
  EXPECT_TRUE(foot.is_converged);
  EXPECT_NEAR(foot.t, t, 1e-13);
}

}  // namespace
}  // namespace camber
