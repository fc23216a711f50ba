#include <camber/base/error.hpp>
#include <camber/basis/quadrature.hpp>
#include <camber/mesh/elevate_data.hpp>

#include <array>
#include <random>
#include <set>
#include <utility>

#include <gtest/gtest.h>

#include "hybrid_mesh.hpp"

namespace camber {
namespace {

using testing::bend;
using testing::hybrid_mesh;
using testing::linear_block;
using testing::nodes_of;

double volume(const ElementBlock& block, const Points& nodes) {
  const Quadrature& rule = gauss(block.shape, 3 * block.order);
  double sum = 0.0;
  for (std::size_t g = 0; g < rule.points.size(); ++g) {
    sum +=
        rule.weights[g] * jacobian(block.shape, block.order, nodes, rule.points[g]).determinant();
  }
  return sum;
}

/// Nodes of the elevated hybrid mesh: points, edges, triangles, quads and insides, each counted
/// once. Edges: cube 12, pyramid + 4, prism + 5 (9 less the 4 of the shared quad), tet + 3: 24.
/// Triangles: pyramid 4, prism 2, tet + 3: 9. Quads: cube 6, prism + 2: 8.
std::size_t expected_points(int p) {
  const auto inside = [&](Shape shape) {
    return dimension(shape) == 2 ? interior_nodes(shape, p).size()
                                 : lattice_map(shape, p).interior.size();
  };
  return 12 + 24 * static_cast<std::size_t>(p - 1) + 9 * inside(Shape::triangle) +
         8 * inside(Shape::quadrilateral) + inside(Shape::hexahedron) + inside(Shape::pyramid) +
         inside(Shape::prism) + inside(Shape::tetrahedron);
}

TEST(AtOrder, SharesTheNineNodesOfAFaceBetweenCubeAndPyramid) {
  MeshData data = hybrid_mesh();
  data.blocks = {data.blocks[5], data.blocks[6]};

  const MeshData quadratic = at_order(data, 2);

  // 27 of the cube and 14 of the pyramid, 9 of them the same.
  EXPECT_EQ(quadratic.points.size(), 32u);
}

TEST(AtOrder, CountsEveryEdgeAndFaceOnceInAHybridMesh) {
  for (int p = 2; p <= k_max_order; ++p) {
    EXPECT_EQ(at_order(hybrid_mesh(), p).points.size(), expected_points(p)) << "order " << p;
  }
}

TEST(AtOrder, KeepsShapeAndVolumeOfEveryElementToRounding) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(0.05, 0.3);
  for (int p = 1; p <= k_max_order; ++p) {
    MeshData low = at_order(hybrid_mesh(), p);
    bend(low);
    for (int q = p; q <= k_max_order; ++q) {
      const MeshData high = at_order(low, q);
      ASSERT_EQ(high.blocks.size(), low.blocks.size());
      for (std::size_t b = 0; b < low.blocks.size(); ++b) {
        const ElementBlock &from = low.blocks[b], &to = high.blocks[b];
        const Points before = nodes_of(low, from), after = nodes_of(high, to);
        ASSERT_EQ(to.order, q);
        for (int k = 0; k < 5; ++k) {
          Vec3 xi(uniform(random), uniform(random), uniform(random));
          for (int c = dimension(from.shape); c < 3; ++c) xi[c] = 0.0;
          EXPECT_LT((evaluate(from.shape, p, before, xi) - evaluate(to.shape, q, after, xi)).norm(),
                    1e-14)
              << name(from.shape) << " " << p << " to " << q;
        }
        if (dimension(from.shape) == 3) {
          EXPECT_NEAR(volume(from, before), volume(to, after), 1e-13);
        }
      }
    }
  }
}

TEST(AtOrder, KeepsTheVolumesOfTheLinearMesh) {
  const MeshData quartic = at_order(hybrid_mesh(), 4);
  const std::array<double, 4> expected{1.0, 1.0 / 3.0, 0.5, 1.0 / 6.0};
  for (std::size_t i = 0; i < 4; ++i) {
    const ElementBlock& block = quartic.blocks[5 + i];
    EXPECT_NEAR(volume(block, nodes_of(quartic, block)), expected[i], 1e-14) << name(block.shape);
  }
}

TEST(AtOrder, JoinsNeighboursOfDifferentOrderThatSeeOneFace) {
  for (int cube_order = 2; cube_order <= 3; ++cube_order) {
    MeshData mixed = hybrid_mesh();
    MeshData cube = mixed;
    cube.blocks = {mixed.blocks[5]};
    cube = at_order(cube, cube_order);  // drops the points of the others
    const Index shift = static_cast<Index>(mixed.points.size());
    mixed.points.insert(mixed.points.end(), cube.points.begin() + 8, cube.points.end());
    mixed.point_tags.clear();
    mixed.blocks[5] = cube.blocks[0];
    for (Index& node : mixed.blocks[5].nodes) {
      if (node >= 8) node += shift - 8;
    }

    EXPECT_EQ(at_order(mixed, 4).points.size(), expected_points(4)) << cube_order;
  }
}

TEST(AtOrder, LeavesAGapOpenInsteadOfMovingEitherSide) {
  MeshData data = hybrid_mesh();
  data.blocks = {data.blocks[5], data.blocks[6]};
  data = at_order(data, 2);
  ElementBlock& pyramid = data.blocks[1];
  const int middle = lattice_map(Shape::pyramid, 2).face_interior[0][0];
  const Index copy = static_cast<Index>(data.points.size());
  const Vec3 shifted =
      data.points[at(pyramid.nodes[static_cast<std::size_t>(middle)])] + Vec3(0, 0, 0.01);
  data.points.push_back(shifted);
  data.point_tags.push_back(9999);
  pyramid.nodes[static_cast<std::size_t>(middle)] = copy;

  const MeshData cubic = at_order(data, 3);

  // Four nodes inside the face of either side.
  EXPECT_EQ(cubic.points.size(), 64u + 30u - 12u);
}

TEST(AtOrder, OneTakesTheCornersBackToTheLastBit) {
  const MeshData linear = hybrid_mesh();

  const MeshData back = at_order(at_order(linear, 4), 1);

  ASSERT_EQ(back.points.size(), linear.points.size());
  for (std::size_t i = 0; i < linear.points.size(); ++i) {
    EXPECT_EQ(back.points[i], linear.points[i]);
  }
  EXPECT_EQ(back.point_tags, linear.point_tags);
  for (std::size_t b = 0; b < linear.blocks.size(); ++b) {
    EXPECT_EQ(back.blocks[b].nodes, linear.blocks[b].nodes);
  }
}

TEST(AtOrder, NumbersAndClassifiesNewNodes) {
  MeshData data = hybrid_mesh();
  data.point_entity.assign(data.points.size(), {0, 1});
  data.point_parameters.assign(data.points.size(), Vec2(0.25, 0.5));

  const MeshData quadratic = at_order(data, 2);

  std::set<GlobalId> tags(quadratic.point_tags.begin(), quadratic.point_tags.end());
  EXPECT_EQ(tags.size(), quadratic.points.size());
  const Index on_line = quadratic.blocks[0].nodes[1];
  EXPECT_EQ(quadratic.point_entity[at(on_line)], (EntityKey{1, 3}));
  EXPECT_TRUE(std::isnan(quadratic.point_parameters[at(on_line)].x()));
  EXPECT_EQ(quadratic.blocks[5].tags, data.blocks[5].tags);
}

TEST(AtOrder, RefusesToLowerACurvedElement) {
  const MeshData cubic = at_order(hybrid_mesh(), 3);
  EXPECT_THROW(static_cast<void>(at_order(cubic, 2)), OptionError);
  EXPECT_THROW(static_cast<void>(at_order(cubic, 0)), OptionError);
  EXPECT_THROW(static_cast<void>(at_order(cubic, 5)), OptionError);
}

}  // namespace
}  // namespace camber
