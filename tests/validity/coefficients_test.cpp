// The coefficients themselves: against the naive solve, by count, and the same bits for all
// kernels.
#include <camber/reference/naive_bernstein.hpp>
#include <camber/validity/detail/element_bounds.hpp>

#include <cstring>

#include <gtest/gtest.h>

#include "elements.hpp"

namespace camber {
namespace {

std::vector<double> coefficients(Shape shape, int p, const Points& nodes,
                                 const detail::KernelChoice& kernel, int lane) {
  const detail::DeterminantPlan& plan = detail::DeterminantPlan::of(shape, p);
  detail::ElementWork& work = detail::element_work();
  double* x = detail::KernelRun::node_buffer(plan, kernel.lanes, work);
  for (int d = 0; d < 3; ++d) {
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      for (int l = 0; l < kernel.lanes; ++l) {
        // Other lanes hold something else, so that a mix-up shows.
        *x++ = nodes[n](d) * (l == lane ? 1.0 : 1.5 + l);
      }
    }
  }
  const detail::KernelRun run(plan, kernel, true, work);
  const double* c = run.curved(lane, work);
  std::vector<double> all(c, c + plan.kernel().size);
  const double* s = run.straight(lane, work);
  all.insert(all.end(), s, s + plan.kernel().size);
  all.push_back(run.margin(lane));
  all.push_back(run.ratio_lowest(lane));
  return all;
}

TEST(Coefficients, AreAsManyAsTheDegreesSay) {
  const auto count = [](Shape shape, int p) {
    return detail::DeterminantPlan::of(shape, p).kernel().size;
  };

  const std::vector<std::array<int, 6>> expected{// p, triangle, tet, prism, hex, pyramid
                                                 {1, 1, 1, 9, 27, 6},
                                                 {2, 6, 20, 90, 216, 120},
                                                 {3, 15, 84, 324, 729, 504},
                                                 {4, 28, 220, 792, 1728, 1320}};

  for (const auto& [p, triangle, tet, prism, hex, pyramid] : expected) {
    EXPECT_EQ(count(Shape::triangle, p), triangle);
    EXPECT_EQ(count(Shape::quadrilateral, p), (2 * p + 1) * (2 * p + 1));
    EXPECT_EQ(count(Shape::tetrahedron, p), tet);
    EXPECT_EQ(count(Shape::prism, p), prism);
    EXPECT_EQ(count(Shape::hexahedron, p), hex);
    EXPECT_EQ(count(Shape::pyramid, p), pyramid);
  }
}

TEST(Coefficients, EqualTheNaiveSolve) {
  std::mt19937 generator(11);
  const std::vector<std::pair<Shape, int>> kinds{
      {Shape::tetrahedron, 1}, {Shape::tetrahedron, 2}, {Shape::tetrahedron, 3},
      {Shape::prism, 1},       {Shape::prism, 2},       {Shape::pyramid, 1},
      {Shape::pyramid, 2},     {Shape::hexahedron, 1},  {Shape::hexahedron, 2}};

  for (const auto& [shape, p] : kinds) {
    const Points nodes = testing::random_element(shape, p, 0.2 / p, generator);
    const reference::NaiveBernstein naive = reference::naive_bernstein(shape, p, nodes);
    const std::vector<double> fast = coefficients(shape, p, nodes, detail::scalar_kernel(), 0);

    ASSERT_EQ(static_cast<int>(naive.coefficients.size()),
              detail::DeterminantPlan::of(shape, p).kernel().size);
    // The naive values are double; its system amplifies their error.
    for (std::size_t n = 0; n < naive.coefficients.size(); ++n) {
      ASSERT_NEAR(fast[n], naive.coefficients[n], 1e-9) << name(shape) << " p " << p << " " << n;
    }
  }
}

TEST(Coefficients, HaveTheSameBitsInEveryLaneOfEveryKernel) {
  std::mt19937 generator(12);
  for (Shape shape : testing::volume_shapes()) {
    for (int p = 1; p <= 4; ++p) {
      const Points nodes = testing::random_element(shape, p, 0.1 / p, generator);
      const std::vector<double> alone = coefficients(shape, p, nodes, detail::scalar_kernel(), 0);
      for (int lanes : {2, 4, 8}) {
        const detail::KernelChoice kernel = detail::kernel_of(lanes);
        if (kernel.run == nullptr) continue;  // not on this machine
        for (int lane = 0; lane < lanes; ++lane) {
          const std::vector<double> packed = coefficients(shape, p, nodes, kernel, lane);
          ASSERT_EQ(std::memcmp(alone.data(), packed.data(), alone.size() * sizeof(double)), 0)
              << name(shape) << " p " << p << " lane " << lane << " of " << lanes;
        }
      }
    }
  }
}

TEST(Coefficients, OfTheStraightCopyAreRaisedWithoutChange) {
  // Hexahedron [0,1]^2 x [0,2]: det J = 2 everywhere, so every coefficient of any degree is 2.
  const Points nodes = testing::mapped(
      Shape::hexahedron, 3, [](const Vec3& xi) { return Vec3(xi.x(), xi.y(), 2.0 * xi.z()); });

  const std::vector<double> all =
      coefficients(Shape::hexahedron, 3, nodes, detail::scalar_kernel(), 0);

  for (std::size_t n = 0; n + 2 < all.size(); ++n) EXPECT_NEAR(all[n], 2.0, 1e-13);
}

TEST(Subdivision, HalvesKeepThePolynomial) {
  std::mt19937 generator(13);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (Shape shape : testing::volume_shapes()) {
    const detail::SubdivisionTable& table = detail::DeterminantPlan::of(shape, 2).subdivision();
    std::vector<double> whole(static_cast<std::size_t>(table.size()));
    for (double& c : whole) c = uniform(generator);

    for (std::size_t d = 0; d < table.directions().size(); ++d) {
      std::vector<double> second = whole, first(whole.size());
      table.split(static_cast<int>(d), second.data(), first.data());
      // The cut is shared: the last coefficient of a row in one half is the first in the other.
      const detail::SplitDirection& direction = table.directions()[d];
      for (std::size_t r = 0; r + 1 < direction.row_begin.size(); ++r) {
        const auto begin = static_cast<std::size_t>(direction.row_begin[r]);
        const auto end = static_cast<std::size_t>(direction.row_begin[r + 1]) - 1;
        const auto at_first = static_cast<std::size_t>(direction.index[begin]);
        const auto at_second = static_cast<std::size_t>(direction.index[end]);
        EXPECT_EQ(first[at_second], second[at_first]);
        EXPECT_EQ(first[at_first], whole[at_first]);
        EXPECT_EQ(second[at_second], whole[at_second]);
      }
      // By hand for the first row of three: b0, (b0+b1)/2, (b0+2b1+b2)/4.
      for (std::size_t r = 0; r + 1 < direction.row_begin.size(); ++r) {
        const auto begin = static_cast<std::size_t>(direction.row_begin[r]);
        if (direction.row_begin[r + 1] - direction.row_begin[r] != 3) continue;
        const auto i0 = static_cast<std::size_t>(direction.index[begin]),
                   i1 = static_cast<std::size_t>(direction.index[begin + 1]),
                   i2 = static_cast<std::size_t>(direction.index[begin + 2]);
        EXPECT_DOUBLE_EQ(first[i1], 0.5 * (whole[i0] + whole[i1]));
        EXPECT_DOUBLE_EQ(first[i2], 0.25 * (whole[i0] + 2.0 * whole[i1] + whole[i2]));
      }
    }
  }
}

}  // namespace
}  // namespace camber
