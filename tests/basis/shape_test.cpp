#include <camber/basis/shape.hpp>

#include <map>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "samples.hpp"

namespace camber {
namespace {

Vec3 corner(Shape shape, int c) { return corners(shape)[static_cast<std::size_t>(c)]; }

int size_of(const LocalFace& face) { return corner_count(face.shape); }

/// Vector area and centroid of a (plane) face, from its triangles about corner 0.
std::pair<Vec3, Vec3> area_and_centroid(Shape shape, const LocalFace& face) {
  Vec3 area = Vec3::Zero(), moment = Vec3::Zero();
  double total = 0;
  const Vec3 a = corner(shape, face.corners[0]);
  for (std::size_t i = 1; i + 1 < static_cast<std::size_t>(size_of(face)); ++i) {
    const Vec3 b = corner(shape, face.corners[i]), c = corner(shape, face.corners[i + 1]);
    const Vec3 part = 0.5 * (b - a).cross(c - a);
    area += part;
    moment += part.norm() * (a + b + c) / 3.0;
    total += part.norm();
  }
  return {area, moment / total};
}

TEST(Shape, HasTheCornersEdgesAndFacesOfTheSolid) {
  EXPECT_EQ(corner_count(Shape::pyramid), 5);
  EXPECT_EQ(edges(Shape::pyramid).size(), 8U);
  EXPECT_EQ(faces(Shape::pyramid).size(), 5U);
  EXPECT_EQ(name(Shape::prism), "prism");
  EXPECT_TRUE(faces(Shape::line).empty());
  ASSERT_EQ(faces(Shape::triangle).size(), 1U);
  EXPECT_EQ(faces(Shape::triangle)[0].corners, (std::array<int, 4>{0, 1, 2, -1}));
  for (Shape shape : test::k_volumes) {  // Euler: corners - edges + faces = 2
    EXPECT_EQ(corner_count(shape) - std::ssize(edges(shape)) + std::ssize(faces(shape)), 2);
  }
}

TEST(Shape, FacesFormAClosedOutwardSurface) {
  for (Shape shape : test::k_volumes) {
    std::map<std::pair<int, int>, int> directed;
    for (const LocalFace& face : faces(shape)) {
      const int n = size_of(face);
      for (int i = 0; i < n; ++i) {
        const auto at = [&](int c) { return face.corners[static_cast<std::size_t>(c % n)]; };
        ++directed[{at(i), at(i + 1)}];
      }
      const auto [area, centroid] = area_and_centroid(shape, face);
      EXPECT_GT(area.dot(centroid - reference_centroid(shape)), 0.0) << name(shape);
    }
    for (const auto& [edge, count] : directed) {
      EXPECT_EQ(count, 1) << name(shape);
      EXPECT_EQ(directed.count({edge.second, edge.first}), 1U) << name(shape);
    }
    std::set<std::pair<int, int>> known;
    for (const auto& [a, b] : edges(shape)) known.insert({std::min(a, b), std::max(a, b)});
    EXPECT_EQ(known.size() * 2, directed.size());
    for (const auto& [a, b] : known) EXPECT_EQ(directed.count({a, b}), 1U) << name(shape);
  }
}

TEST(Shape, VolumeFollowsFromItsFacesByTheDivergenceTheorem) {
  for (Shape shape : test::k_volumes) {
    double volume = 0;
    for (const LocalFace& face : faces(shape)) {
      const auto [area, centroid] = area_and_centroid(shape, face);
      volume += area.dot(centroid) / 3.0;
    }
    EXPECT_NEAR(volume, reference_measure(shape), 1e-15) << name(shape);
  }
}

}  // namespace
}  // namespace camber
