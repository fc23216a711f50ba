#include <camber/base/parallel.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/page/tessellation.hpp>

#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "round_block.hpp"

namespace camber {
namespace {

using Key = std::array<double, 3>;
Key key(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

/// Corners of triangle t as points.
std::array<Vec3, 3> corners_of(const Tessellation& result, std::size_t face, std::size_t t) {
  std::array<Vec3, 3> x;
  for (std::size_t k = 0; k < 3; ++k) {
    x[k] = result.points[result.first_point[face] + result.triangles[t][k]];
  }
  return x;
}

double area(const Tessellation& result) {
  double sum = 0.0;
  for (std::size_t f = 0; f < result.level.size(); ++f) {
    for (std::size_t t = result.first_triangle[f]; t < result.first_triangle[f + 1]; ++t) {
      const std::array<Vec3, 3> x = corners_of(result, f, t);
      sum += (x[1] - x[0]).cross(x[2] - x[0]).norm() / 2.0;
    }
  }
  return sum;
}

/// How often each pair of points is the side of a triangle, a -> b counted against b -> a.
/// A closed surface without cracks has every side once in each direction.
void expect_closed(const Tessellation& result) {
  std::map<std::pair<Key, Key>, int> sides;
  for (std::size_t f = 0; f < result.level.size(); ++f) {
    for (std::size_t t = result.first_triangle[f]; t < result.first_triangle[f + 1]; ++t) {
      const std::array<Vec3, 3> x = corners_of(result, f, t);
      for (std::size_t k = 0; k < 3; ++k) ++sides[{key(x[k]), key(x[(k + 1) % 3])}];
    }
  }
  for (const auto& [side, count] : sides) {
    ASSERT_EQ(count, 1);
    ASSERT_TRUE(sides.contains({side.second, side.first}));
  }
}

struct Surface {
  explicit Surface(MeshData mesh) : data(std::move(mesh)) {}
  MeshData data;
  ElementList cells{data, 3}, surfaces{data, 2};
  std::vector<BoundaryFace> faces = boundary_faces(cells, surfaces);
};

TEST(Tessellation, TakesItsPointsFromTheElementsPolynomials) {
  const Surface s(test::round_block(2, 3));
  // One level everywhere, so that no point of a side is moved along it.
  const TessellationOptions options{1e-9, 7, std::size_t{1} << 20U};

  const Tessellation result = tessellate(s.cells, s.faces, {}, options);

  Points nodes;
  for (std::size_t f = 0; f < s.faces.size(); ++f) {
    const Shape shape = gather_face(s.cells, s.faces[f], nodes);
    const std::span<const Vec3> xi = lattice_xi(shape, result.level[f]);
    ASSERT_EQ(xi.size(), result.first_point[f + 1] - result.first_point[f]);
    for (std::size_t i = 0; i < xi.size(); ++i) {
      const Vec3 x = evaluate(shape, 3, nodes, xi[i]);
      EXPECT_LT((result.points[result.first_point[f] + i] - x).norm(), 1e-14);
    }
  }
}

TEST(Tessellation, NormalsAreThoseOfTheSphere) {
  const Surface s(test::round_block(2, 4));

  const Tessellation result = tessellate(s.cells, s.faces);

  for (std::size_t i = 0; i < result.points.size(); ++i) {
    EXPECT_NEAR(result.normals[i].norm(), 1.0, 1e-14);
    EXPECT_GT(result.normals[i].dot(result.points[i].normalized()), 0.99);
  }
}

TEST(Tessellation, AreaOfTheSphereConvergesWithTheSquareOfTheLevel) {
  const Surface s(test::round_block(4, 4));  // order 4: the polynomials miss by far less
  const auto miss = [&](int level) {
    const TessellationOptions options{1e-9, level, std::size_t{1} << 30U};
    return std::abs(area(tessellate(s.cells, s.faces, {}, options)) - 4.0 * std::numbers::pi);
  };

  const double coarse = miss(2), fine = miss(4), finest = miss(8);

  EXPECT_NEAR(std::log2(coarse / fine), 2.0, 0.1);
  EXPECT_NEAR(std::log2(fine / finest), 2.0, 0.1);
}

TEST(Tessellation, HasNoCracksWhereSidesHaveDifferentLevels) {
  // Long and thin: edges along the axis turn little, those around it a lot.
  const Surface s(test::round_block(3, 3, Vec3(8.0, 1.0, 0.5)));

  const Tessellation result = tessellate(s.cells, s.faces);

  const std::set<std::uint8_t> levels(result.level.begin(), result.level.end());
  EXPECT_GT(levels.size(), 2u);
  expect_closed(result);
}

TEST(Tessellation, HasNoCracksBetweenFacesThatAskForMore) {
  const Surface s(test::round_block(3, 1));
  std::vector<int> finer(s.faces.size(), 1);
  for (std::size_t f = 0; f < finer.size(); f += 5) finer[f] = 3 + static_cast<int>(f % 4);

  const Tessellation result = tessellate(s.cells, s.faces, finer);

  for (std::size_t f = 0; f < finer.size(); ++f) EXPECT_GE(result.level[f], finer[f]);
  expect_closed(result);
}

TEST(Tessellation, NeedsOneSquareForAFlatLinearFace) {
  MeshData data = test::round_block(1, 1);

  const Surface s(std::move(data));
  const Tessellation result = tessellate(s.cells, s.faces);

  EXPECT_EQ(result.triangles.size(), 12u);
  EXPECT_FALSE(result.is_reduced);
}

TEST(Tessellation, KeepsToTheNumberOfTrianglesAndSaysSo) {
  const Surface s(test::round_block(3, 3));
  TessellationOptions options;
  options.max_triangles = 2000;

  const Tessellation result = tessellate(s.cells, s.faces, {}, options);

  EXPECT_LE(result.triangles.size(), 2000u);
  EXPECT_GT(result.triangles.size(), 108u);
  EXPECT_TRUE(result.is_reduced);
  EXPECT_FALSE(tessellate(s.cells, s.faces).is_reduced);
}

TEST(Tessellation, ListsEveryEdgeOnce) {
  const Surface s(test::round_block(3, 2));

  const Tessellation result = tessellate(s.cells, s.faces);

  std::size_t edges = 0;
  for (std::uint8_t own : result.own_edges) {
    for (int k = 0; k < 4; ++k) edges += static_cast<unsigned>(own >> k) & 1U;
  }
  EXPECT_EQ(edges, 2u * s.faces.size());  // closed, four edges a face, each of two faces
}

TEST(Tessellation, IsTheSameForAnyNumberOfThreads) {
  const Surface s(test::round_block(3, 3));
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return tessellate(s.cells, s.faces);
  };

  const Tessellation one = run(1), two = run(2);

  EXPECT_EQ(one.points, two.points);
  EXPECT_EQ(one.normals, two.normals);
  EXPECT_EQ(one.triangles, two.triangles);
}

}  // namespace
}  // namespace camber
