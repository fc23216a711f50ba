#include <camber/basis/lattice.hpp>
#include <camber/smooth/marching/sub_simplices.hpp>

#include <cmath>
#include <map>
#include <set>
#include <stdexcept>

#include <gtest/gtest.h>

namespace camber {
namespace {

/// Area or volume times d!.
double measure(Shape shape, int p, const SubSimplex& s) {
  const std::span<const Vec3> xi = lattice_xi(shape, p);
  const auto edge = [&](std::size_t k) {
    return Vec3(xi[static_cast<std::size_t>(s[k])] - xi[static_cast<std::size_t>(s[0])]);
  };
  return s[3] < 0 ? edge(1).cross(edge(2)).z() : edge(1).cross(edge(2)).dot(edge(3));
}

class Cuts : public ::testing::TestWithParam<std::tuple<Shape, int>> {};

TEST_P(Cuts, AreOfPositiveAndEqualMeasure) {
  const auto [shape, p] = GetParam();

  for (const SubSimplex& s : sub_simplices(shape, p)) {
    EXPECT_NEAR(measure(shape, p, s) * std::pow(p, dimension(shape)), 1.0, 1e-12);
  }
}

TEST_P(Cuts, UseEveryNodeAndNoneTwice) {
  const auto [shape, p] = GetParam();
  std::set<int> used;
  std::set<std::set<int>> cuts;

  for (const SubSimplex& s : sub_simplices(shape, p)) {
    const std::set<int> nodes(s.begin(), s.begin() + (s[3] < 0 ? 3 : 4));
    EXPECT_EQ(nodes.size(), s[3] < 0 ? 3u : 4u);
    EXPECT_TRUE(cuts.insert(nodes).second);
    used.insert(nodes.begin(), nodes.end());
  }

  EXPECT_EQ(used.size(), static_cast<std::size_t>(node_count(shape, p)));
}

/// Small elements times their corners; a tet and a triangle are cut into their own kind.
TEST_P(Cuts, AreAsManyAsTheSmallElementsHaveCorners) {
  const auto [shape, p] = GetParam();
  const std::size_t n = static_cast<std::size_t>(p), count = sub_simplices(shape, p).size();

  const std::map<Shape, std::size_t> expected{{Shape::triangle, n * n},
                                              {Shape::quadrilateral, 4 * n * n},
                                              {Shape::tetrahedron, n * n * n},
                                              {Shape::prism, 6 * n * n * n},
                                              {Shape::hexahedron, 8 * n * n * n}};
  if (shape != Shape::pyramid) {
    EXPECT_EQ(count, expected.at(shape));
  } else {
    std::size_t pyramids = 0, tets = 0;
    for (std::size_t m = 1; m <= n; ++m) {
      pyramids += m * m + (m - 1) * (m - 1);
      tets += 2 * m * (m - 1);
    }
    EXPECT_EQ(2 * pyramids + tets, 2 * n * n * n);  // in halves: they fill the pyramid
    EXPECT_EQ(count, 4 * pyramids + tets);
  }
}

INSTANTIATE_TEST_SUITE_P(AllShapes, Cuts,
                         ::testing::Combine(::testing::Values(Shape::triangle, Shape::quadrilateral,
                                                              Shape::tetrahedron, Shape::pyramid,
                                                              Shape::prism, Shape::hexahedron),
                                            ::testing::Values(1, 2, 3, 4)));

TEST(SubSimplices, OfATetFillItOnce) {
  for (int p = 1; p <= 4; ++p) {
    double sum = 0.0;
    for (const SubSimplex& s : sub_simplices(Shape::tetrahedron, p)) {
      sum += measure(Shape::tetrahedron, p, s);
    }
    EXPECT_NEAR(sum, 1.0, 1e-12);
  }
}

TEST(SubSimplices, AreRefusedForLinesAndUnknownOrders) {
  EXPECT_THROW(static_cast<void>(sub_simplices(Shape::line, 2)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(sub_simplices(Shape::prism, 0)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(sub_simplices(Shape::prism, 7)), std::invalid_argument);
}

}  // namespace
}  // namespace camber
