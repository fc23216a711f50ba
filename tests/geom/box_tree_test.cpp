#include <camber/geom/box_tree.hpp>

#include <limits>
#include <random>
#include <set>

#include <gtest/gtest.h>

namespace camber {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();

Box box(const Vec3& lower, const Vec3& upper) {
  Box result;
  result.add(lower);
  result.add(upper);
  return result;
}

std::vector<Box> random_boxes(int count) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.0, 1.0);
  std::vector<Box> result;
  for (int i = 0; i < count; ++i) {
    const Vec3 low(uniform(random), uniform(random), uniform(random));
    result.push_back(
        box(low, low + 0.05 * Vec3(uniform(random), uniform(random), uniform(random))));
  }
  return result;
}

TEST(Box, DistanceIsThatOfTheNearestCornerEdgeOrFace) {
  const Box unit = box({0, 0, 0}, {1, 1, 1});
  EXPECT_DOUBLE_EQ(distance_squared(unit, {0.5, 0.5, 0.5}), 0.0);
  EXPECT_DOUBLE_EQ(distance_squared(unit, {3.0, 0.5, 0.5}), 4.0);   // face
  EXPECT_DOUBLE_EQ(distance_squared(unit, {4.0, 5.0, 0.5}), 25.0);  // edge: 3^2 + 4^2
  EXPECT_DOUBLE_EQ(distance_squared(unit, {2.0, 3.0, 3.0}), 9.0);   // corner: 1 + 4 + 4
}

TEST(Box, IsEnteredByALineOnEitherSideOfItsPoint) {
  const Box unit = box({0, 0, 0}, {1, 1, 1});
  const Vec3 d(1, 0, 0);
  EXPECT_DOUBLE_EQ(line_entry(unit, {-2, 0.5, 0.5}, d, 10.0), 2.0);
  EXPECT_DOUBLE_EQ(line_entry(unit, {4, 0.5, 0.5}, d, 10.0), 3.0);
  EXPECT_DOUBLE_EQ(line_entry(unit, {0.2, 0.5, 0.5}, d, 10.0), 0.0);
  EXPECT_EQ(line_entry(unit, {4, 0.5, 0.5}, d, 2.0), k_infinity);
  EXPECT_EQ(line_entry(unit, {4, 1.5, 0.5}, d, 10.0), k_infinity);
}

TEST(BoxTree, FindsTheSameNearestBoxAsALoop) {
  const std::vector<Box> boxes = random_boxes(500);
  const BoxTree tree(boxes);
  std::mt19937 random(8);
  std::uniform_real_distribution<double> uniform(-0.5, 1.5);
  for (int k = 0; k < 200; ++k) {
    const Vec3 x(uniform(random), uniform(random), uniform(random));
    double expected = k_infinity, found = k_infinity;
    for (const Box& b : boxes) expected = std::min(expected, distance_squared(b, x));
    tree.nearest(
        x, [&] { return found; },
        [&](int i) { found = std::min(found, distance_squared(tree.item(i), x)); });
    EXPECT_EQ(found, expected);
  }
}

TEST(BoxTree, VisitsEveryBoxOnALineOnce) {
  const std::vector<Box> boxes = random_boxes(300);
  const BoxTree tree(boxes);
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  for (int k = 0; k < 100; ++k) {
    const Vec3 x = Vec3::Constant(0.5),
               d = Vec3(normal(random), normal(random), normal(random)).normalized();
    std::multiset<int> expected, found;
    for (int i = 0; i < 300; ++i)
      if (line_entry(boxes[static_cast<std::size_t>(i)], x, d, 0.4) < 0.4) expected.insert(i);
    tree.along_line(
        x, d, [] { return 0.4; }, [&](int i) { found.insert(i); });
    EXPECT_EQ(found, expected);
  }
}

TEST(BoxTree, OfNothingVisitsNothing) {
  const BoxTree tree;
  int visits = 0;
  tree.nearest(
      Vec3::Zero(), [] { return k_infinity; }, [&](int) { ++visits; });
  EXPECT_EQ(visits, 0);
  EXPECT_TRUE(tree.is_empty());
}

}  // namespace
}  // namespace camber
