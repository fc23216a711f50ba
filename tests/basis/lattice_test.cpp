#include <camber/basis/lattice.hpp>

#include <algorithm>
#include <numeric>
#include <stdexcept>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "samples.hpp"

namespace camber {
namespace {

using testing::ElementsAre;

TEST(Lattice, RunsAlongRowsThenUpTheLayers) {
  const auto triangle = lattice(Shape::triangle, 2);
  EXPECT_EQ(std::vector<LatticePoint>(triangle.begin(), triangle.end()),
            (std::vector<LatticePoint>{
                {0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 2, 0}}));
  const auto pyramid = lattice(Shape::pyramid, 1);
  EXPECT_EQ(std::vector<LatticePoint>(pyramid.begin(), pyramid.end()),
            (std::vector<LatticePoint>{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}, {0, 0, 1}}));
}

TEST(Lattice, HasTheCountsOfTheCgnsElementTypes) {
  EXPECT_EQ(node_count(Shape::tetrahedron, 4), 35);
  EXPECT_EQ(node_count(Shape::pyramid, 4), 55);
  EXPECT_EQ(node_count(Shape::prism, 4), 75);
  EXPECT_EQ(node_count(Shape::hexahedron, 4), 125);
  EXPECT_EQ(node_count(Shape::triangle, 0), 1);
}

TEST(Lattice, IndexIsTheInverseOfTheOrder) {
  for (Shape shape : test::k_shapes) {
    for (int p = 0; p <= k_max_tested_order; ++p) {
      const auto points = lattice(shape, p);
      ASSERT_EQ(std::ssize(points), node_count(shape, p));
      for (std::size_t n = 0; n < points.size(); ++n) {
        EXPECT_EQ(lattice_index(shape, p, points[n]), static_cast<int>(n)) << name(shape) << p;
      }
    }
  }
}

TEST(Lattice, RefusesOrdersThatHaveNoMeaning) {
  EXPECT_THROW(static_cast<void>(node_count(Shape::line, -1)), std::invalid_argument);
  EXPECT_THROW(static_cast<void>(lattice(Shape::line, k_max_lattice_order + 1)),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(lattice_map(Shape::line, 0)), std::invalid_argument);
}

TEST(LatticeMap, PutsEveryNodeOnExactlyOneEntity) {
  for (Shape shape : test::k_shapes) {
    for (int p = 1; p <= k_max_tested_order; ++p) {
      const LatticeMap& map = lattice_map(shape, p);
      std::vector<int> all = map.corner;
      for (const auto& nodes : map.edge_interior) all.insert(all.end(), nodes.begin(), nodes.end());
      for (const auto& nodes : map.face_interior) all.insert(all.end(), nodes.begin(), nodes.end());
      if (dimension(shape) == 3) all.insert(all.end(), map.interior.begin(), map.interior.end());
      std::sort(all.begin(), all.end());
      std::vector<int> expected(static_cast<std::size_t>(node_count(shape, p)));
      std::iota(expected.begin(), expected.end(), 0);
      EXPECT_EQ(all, expected) << name(shape) << p;
    }
  }
}

TEST(LatticeMap, FollowsEdgesAndFacesInTheirOwnDirection) {
  for (Shape shape : test::k_shapes) {
    const auto corner = corners(shape);
    for (int p = 1; p <= 4; ++p) {
      const auto xi = lattice_xi(shape, p);
      const LatticeMap& map = lattice_map(shape, p);
      const auto at = [&](int node) { return xi[static_cast<std::size_t>(node)]; };
      for (std::size_t e = 0; e < map.edge.size(); ++e) {
        const Vec3 a = corner[static_cast<std::size_t>(edges(shape)[e][0])];
        const Vec3 b = corner[static_cast<std::size_t>(edges(shape)[e][1])];
        for (int i = 0; i <= p; ++i) {
          const Vec3 expected = a + (b - a) * i / p;
          EXPECT_LT((at(map.edge[e][static_cast<std::size_t>(i)]) - expected).norm(), 1e-15);
        }
      }
      for (std::size_t f = 0; f < map.face.size(); ++f) {
        const LocalFace& face = faces(shape)[f];
        const auto face_xi = lattice_xi(face.shape, p);
        const std::size_t last = face.shape == Shape::triangle ? 2 : 3;
        const Vec3 a = corner[static_cast<std::size_t>(face.corners[0])];
        const Vec3 u = corner[static_cast<std::size_t>(face.corners[1])] - a;
        const Vec3 v = corner[static_cast<std::size_t>(face.corners[last])] - a;
        ASSERT_EQ(map.face[f].size(), face_xi.size());
        for (std::size_t n = 0; n < face_xi.size(); ++n) {
          const Vec3 expected = a + u * face_xi[n][0] + v * face_xi[n][1];
          EXPECT_LT((at(map.face[f][n]) - expected).norm(), 1e-15) << name(shape) << p;
        }
      }
    }
  }
}

TEST(LatticeMap, HandlesTheQuadraticTriangleAsDrawn) {
  // 5
  // 3 4      edges 01, 12, 20
  // 0 1 2
  const LatticeMap& map = lattice_map(Shape::triangle, 2);
  EXPECT_THAT(map.corner, ElementsAre(0, 2, 5));
  EXPECT_THAT(map.edge[1], ElementsAre(2, 4, 5));
  EXPECT_THAT(map.edge[2], ElementsAre(5, 3, 0));
  EXPECT_TRUE(map.interior.empty());
  EXPECT_EQ(interior_nodes(Shape::quadrilateral, 2).size(), 1U);
}

TEST(Reorient, ReversesALineAndRotatesATriangle) {
  EXPECT_THAT(reorient(Shape::line, 3, std::array{1, 0}), ElementsAre(3, 2, 1, 0));
  // B's corner 0 is A's corner 1, 1 is 2, 2 is 0.
  EXPECT_THAT(reorient(Shape::triangle, 2, std::array{1, 2, 0}), ElementsAre(2, 4, 5, 1, 3, 0));
}

TEST(Reorient, PutsEveryNodeWhereTheCornersSayForAllSymmetries) {
  for (Shape shape : {Shape::line, Shape::triangle, Shape::quadrilateral}) {
    std::vector<int> of_a(static_cast<std::size_t>(corner_count(shape)));
    std::iota(of_a.begin(), of_a.end(), 0);
    int symmetries = 0;
    do {
      const bool symmetric = of_a.size() < 4 || std::abs(of_a[0] - of_a[2]) == 2;
      if (!symmetric) {
        EXPECT_THROW(static_cast<void>(reorient(shape, 3, of_a)), std::invalid_argument);
        continue;
      }
      ++symmetries;
      for (int p = 1; p <= k_max_tested_order; ++p) {
        const std::vector<int> result = reorient(shape, p, of_a);
        const auto xi = lattice_xi(shape, p);
        const Vec3 origin = corners(shape)[static_cast<std::size_t>(of_a.front())];
        const Vec3 u = corners(shape)[static_cast<std::size_t>(of_a[1])] - origin;
        const Vec3 v = corners(shape)[static_cast<std::size_t>(of_a.back())] - origin;
        for (std::size_t n = 0; n < xi.size(); ++n) {
          const Vec3 expected =
              origin + u * xi[n][0] + (shape == Shape::line ? 0 : 1) * v * xi[n][1];
          EXPECT_LT((xi[static_cast<std::size_t>(result[n])] - expected).norm(), 1e-15);
        }
      }
    } while (std::next_permutation(of_a.begin(), of_a.end()));
    EXPECT_EQ(symmetries, shape == Shape::line ? 2 : shape == Shape::triangle ? 6 : 8);
  }
}

TEST(LatticeMap, IsOneTableForAllThreads) {
  std::vector<const LatticeMap*> seen(8, nullptr);
  {
    std::vector<std::jthread> threads;
    for (const LatticeMap*& table : seen) {
      threads.emplace_back([&table] { table = &lattice_map(Shape::hexahedron, 11); });
    }
  }
  for (const LatticeMap* table : seen) EXPECT_EQ(table, seen.front());
  EXPECT_EQ(seen.front()->interior.size(), 1000U);
}

}  // namespace
}  // namespace camber
