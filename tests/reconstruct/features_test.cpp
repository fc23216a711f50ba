#include <algorithm>

#include <gtest/gtest.h>

#include "surfaces.hpp"

namespace camber {
namespace {

using namespace testing;

TEST(Features, OfABoxAreItsSidesEdgesAndCorners) {
  const int n = 3;
  const FacetMesh mesh = box_surface(n);
  const Features features = find_features(mesh);

  EXPECT_EQ(features.region_count, 6);
  ASSERT_EQ(features.chains.size(), 12u);
  EXPECT_EQ(features.corners.size(), 8u);
  for (const Chain& chain : features.chains) {
    EXPECT_FALSE(chain.is_closed);
    EXPECT_EQ(chain.vertices.size(), 4u);
    ASSERT_EQ(chain.edges.size(), 3u);
    for (std::size_t i = 0; i < chain.edges.size(); ++i) {
      const auto [a, b] = std::minmax(chain.vertices[i], chain.vertices[i + 1]);
      EXPECT_EQ(features.edges[at(chain.edges[i])].vertex, (std::array<Index, 2>{a, b}));
    }
  }
  for (std::size_t f = 0; f < mesh.facets.size(); ++f) {
    const Vec3 n_f = mesh.area_vector(static_cast<Index>(f));
    for (std::size_t g = 0; g < mesh.facets.size(); ++g) {
      const bool is_same_side = n_f.dot(mesh.area_vector(static_cast<Index>(g))) > 0.0;
      EXPECT_EQ(features.region[f] == features.region[g], is_same_side);
    }
  }
}

TEST(Features, RunRoundTheRimsOfACylinderWithoutACorner) {
  const int n = 12;
  const Features features = find_features(capped_cylinder(n));

  EXPECT_EQ(features.region_count, 3);
  EXPECT_TRUE(features.corners.empty());
  ASSERT_EQ(features.chains.size(), 2u);
  for (const Chain& chain : features.chains) {
    EXPECT_TRUE(chain.is_closed);
    EXPECT_EQ(chain.vertices.size(), 12u);
    EXPECT_EQ(chain.edges.size(), 12u);
  }
}

TEST(Features, DependOnTheAngleAskedFor) {
  const FacetMesh mesh = facets_of(icosphere(0));  // facets turned by 41.8 degrees

  EXPECT_EQ(find_features(mesh, {42.0, 40.0}).region_count, 1);
  EXPECT_EQ(find_features(mesh, {20.0, 40.0}).region_count, 20);
}

TEST(Features, AreNoSpreadBends) {
  // The same turn of 45 degrees: of a nose of few facets, and of a fold between flat parts.
  const auto strip = [](const std::vector<double>& directions) {
    std::vector<Vec3> profile{Vec3::Zero()};
    for (double degrees : directions) {
      const double a = degrees * std::numbers::pi / 180.0;
      profile.push_back(profile.back() + Vec3(std::cos(a), 0.0, std::sin(a)));
    }
    const int n = static_cast<int>(directions.size());
    return facets_of(grid(n, 2, [&](double u, double v) {
      return Vec3(profile[static_cast<std::size_t>(std::lround(u * n))] + v * Vec3::UnitY());
    }));
  };
  EXPECT_EQ(find_features(strip({0.0, 45.0, 90.0, 135.0})).region_count, 1);
  EXPECT_EQ(find_features(strip({0.0, 0.0, 45.0, 45.0})).region_count, 2);
  EXPECT_EQ(find_features(strip({0.0, 0.0, 85.0, 170.0})).region_count, 3);
}

TEST(Features, BoundAnOpenSurface) {
  const FacetMesh mesh =
      facets_of(grid(4, 3, [](double u, double v) { return Vec3(u, v, 0.1 * u * v); }));
  const Features features = find_features(mesh);

  EXPECT_EQ(features.region_count, 1);
  EXPECT_EQ(features.chains.size(), 4u);
  EXPECT_EQ(features.corners.size(), 4u);
}

}  // namespace
}  // namespace camber
