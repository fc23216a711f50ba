// Random walls and layers: everything is certified, whatever the seed.
#include "random_wall.hpp"

#include <camber/mesh/linear_mesh.hpp>

#include <set>

#include <gtest/gtest.h>

#include "ladder.hpp"

namespace camber {
namespace {

using namespace testing;

class RandomWall : public ::testing::TestWithParam<std::uint32_t> {};

TEST_P(RandomWall, IsCertifiedEverywhere) {
  const RandomCase random = random_case(GetParam());

  const CurveResult result = curve(random.mesh, *random.model, random.options);

  EXPECT_EQ(result.report.validity.certified, result.linear->cell_count()) << random.text();
  EXPECT_LE(result.report.conformity.max_order_jump, 1) << random.text();
  EXPECT_LE(result.report.conformity.max_gap, 1e-13 * result.report.conformity.model_size)
      << random.text();
}

// All 200 are run by bench/random_cases; 5 and 8 spend seconds on untangling.
INSTANTIATE_TEST_SUITE_P(Seeds, RandomWall, ::testing::Values(1, 2, 3, 4, 6, 7, 9, 10, 11, 12));

TEST(RandomCases, AreTheSameForTheSameSeedAndDifferForOthers) {
  EXPECT_EQ(random_case(3).mesh.points, random_case(3).mesh.points);
  EXPECT_NE(random_case(3).mesh.points, random_case(4).mesh.points);
}

TEST(RandomCases, HoldEveryShapeAndEveryOrder) {
  std::set<Shape> shapes;
  std::set<int> orders;
  std::set<bool> mixed;
  for (std::uint32_t seed = 1; seed <= 10; ++seed) {
    const RandomCase random = random_case(seed);
    for (Shape shape : build_linear_mesh(random.mesh).cell_shape) shapes.insert(shape);
    orders.insert(random.options.orders.max_order);
    mixed.insert(random.options.orders.min_order == 1);
  }
  EXPECT_EQ(shapes.size(), 4u);
  EXPECT_EQ(orders, (std::set<int>{2, 3, 4}));
  EXPECT_EQ(mixed.size(), 2u);
}

}  // namespace
}  // namespace camber
