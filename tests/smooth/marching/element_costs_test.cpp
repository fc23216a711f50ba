#include <camber/basis/lagrange.hpp>
#include <camber/smooth/marching/element_costs.hpp>
#include <camber/smooth/marching/sub_simplices.hpp>

#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

namespace camber {
namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// An element with bent straight copy (corners moved) and shaken nodes.
struct Sample {
  Shape shape;
  int p;
  Points X, x;

  Sample(Shape s, int order, double amplitude, unsigned seed) : shape(s), p(order) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> uniform(-1.0, 1.0);
    const auto shaken = [&](double a) {
      Vec3 u;
      for (int i = 0; i < 3; ++i) u[i] = a * uniform(random);
      return u;
    };
    Points corner;
    for (const Vec3& c : corners(shape)) corner.push_back(c + shaken(0.1));
    X = straight_nodes(shape, p, corner);
    x = X;
    for (Vec3& node : x) node += shaken(amplitude / p);
  }
};

template <int d>
std::vector<SubCost<d>> costs_of(const Sample& sample, int level) {
  std::vector<SubCost<d>> costs;
  element_costs<d>(sample.shape, sample.p, sample.x, sample.X, level, costs);
  return costs;
}

class ElementCosts : public ::testing::TestWithParam<std::tuple<Shape, int, int>> {
 protected:
  template <class Check>
  static void by_dimension(Shape shape, const Check& check) {
    if (dimension(shape) == 2) {
      check(std::integral_constant<int, 2>{});
    } else {
      check(std::integral_constant<int, 3>{});
    }
  }
};

TEST_P(ElementCosts, OfTheStraightCopyAreOne) {
  const auto [shape, p, level] = GetParam();
  Sample sample(shape, p, 0.0, 1);

  by_dimension(shape, [&, level = level](auto d) {
    for (const auto& sub : costs_of<d>(sample, level)) EXPECT_NEAR(sub.cost, 1.0, 1e-11);
  });
}

TEST_P(ElementCosts, DoNotSeeRotationShiftAndGrowth) {
  const auto [shape, p, level] = GetParam();
  Sample sample(shape, p, 0.0, 2);
  const Mat3 turn = Eigen::AngleAxisd(0.4, Vec3(1, 2, -1).normalized()).toRotationMatrix();
  for (Vec3& node : sample.x) node = Vec3(3, -1, 2) + 1.7 * (turn * node);

  by_dimension(shape, [&, level = level](auto d) {
    for (const auto& sub : costs_of<d>(sample, level)) EXPECT_NEAR(sub.cost, 1.0, 1e-11);
  });
}

TEST_P(ElementCosts, HaveTheDerivativesOfCentralDifferencesByTheirCorners) {
  const auto [shape, p, level] = GetParam();
  const Sample sample(shape, p, 0.12, 3);
  constexpr double h = 1e-6;

  by_dimension(shape, [&, p = p, shape = shape, level = level](auto d) {
    const std::vector<SubCost<d>> costs = costs_of<d>(sample, level);
    const std::span<const SubSimplex> simplices = sub_simplices(shape, p);
    // Every few: large orders have hundreds.
    for (std::size_t i = 0; i < simplices.size(); i += 1 + simplices.size() / 2) {
      for (int k = 0; k <= d; ++k) {
        for (int r = 0; r < 3; ++r) {
          Sample more = sample, less = sample;
          more.x[at(simplices[i][at(k)])][r] += h;
          less.x[at(simplices[i][at(k)])][r] -= h;
          const double up = costs_of<d>(more, level)[i].cost;
          const double down = costs_of<d>(less, level)[i].cost;
          const double here = costs[i].cost;
          // The cap at 1 and a change of the lowest point are corners of the function.
          if (std::abs(up - 2.0 * here + down) > 1e-9) continue;
          EXPECT_NEAR(costs[i].slope[at(k)][r], (up - down) / (2.0 * h), 2e-6 * p * p);
        }
      }
    }
  });
}

TEST_P(ElementCosts, AreTheLowestJacobianAsItIsWhereThatIsNegative) {
  const auto [shape, p, level] = GetParam();
  Sample sample(shape, p, 0.0, 4);
  for (Vec3& node : sample.x) node.x() *= -1.0;  // inside out
  by_dimension(shape, [&, level = level](auto d) {
    for (const auto& sub : costs_of<d>(sample, level)) {
      if (d == 3) {
        EXPECT_NEAR(sub.cost, -1.0, 1e-11);
      } else {
        EXPECT_LT(sub.cost, 0.0);
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(AllShapes, ElementCosts,
                         ::testing::Combine(::testing::Values(Shape::triangle, Shape::quadrilateral,
                                                              Shape::tetrahedron, Shape::pyramid,
                                                              Shape::prism, Shape::hexahedron),
                                            ::testing::Values(2, 3, 4),
                                            ::testing::Values(0, 1, 2)));

/// A 1D defect seen along an edge: nodes at 0, 0.2, 1 have positive halves but x'(0) < 0.
TEST(ElementCosts, SubdivisionSeesAnInversionBetweenNodesThatSubVolumesMiss) {
  Sample sample(Shape::hexahedron, 2, 0.0, 5);
  sample.X = straight_nodes(Shape::hexahedron, 2, corners(Shape::hexahedron));
  sample.x = sample.X;
  for (Vec3& node : sample.x) {
    if (node.x() == 0.5) node.x() = 0.2;
  }
  const auto lowest = [&](int level) {
    const std::vector<SubCost<3>> costs = costs_of<3>(sample, level);
    return std::min_element(costs.begin(), costs.end(),
                            [](const auto& a, const auto& b) { return a.cost < b.cost; })
        ->cost;
  };

  EXPECT_GT(lowest(0), 0.0);
  EXPECT_NEAR(lowest(1), -0.2, 1e-12);
  EXPECT_NEAR(lowest(2), -0.2, 1e-12);
}

TEST(InscribedRadius, OfTheUnitTetAndTriangleIsTheKnownOne) {
  const SimplexCorners<double, 3> tet{Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)};
  const SimplexCorners<double, 2> triangle{Vec3(0, 0, 0), Vec3(3, 0, 0), Vec3(0, 4, 0)};

  // 3 V / S = 0.5 / (1.5 + sqrt(3) / 2)
  EXPECT_NEAR(ideal_simplex(tet).inscribed_radius, 0.5 / (1.5 + std::sqrt(3.0) / 2.0), 1e-15);
  EXPECT_NEAR(ideal_simplex(triangle).inscribed_radius, 1.0, 1e-15);  // 2 * 6 / 12
}

TEST(BiasedJacobian, CountsLargeValuesAsOneAndReturnsTheLowestIfItIsNotPositive) {
  const std::vector<double> good{0.5, 3.0}, bad{0.5, -0.25, 3.0};

  // 0.5 * (1 - 0.5) + 0.75 * 0.5
  EXPECT_NEAR(biased_jacobian<double>(good), 0.625, 1e-15);
  EXPECT_EQ(biased_jacobian<double>(bad), -0.25);
}

}  // namespace
}  // namespace camber
