#include <camber/basis/lagrange.hpp>
#include <camber/elevate/blend.hpp>

#include <functional>
#include <random>

#include <gtest/gtest.h>

namespace camber {
namespace {

/// Lattice values of u with garbage inside, then blended.
Points blended(Shape shape, int q, const std::function<Vec3(const Vec3&)>& u) {
  Points values;
  for (const Vec3& xi : lattice_xi(shape, q)) values.push_back(u(xi));
  for (int node : interior_nodes(shape, q)) {
    values[static_cast<std::size_t>(node)] = Vec3::Constant(1e6);
  }
  blend_face_interior(shape, q, values);
  return values;
}

void expect_exact(Shape shape, int q, const std::function<Vec3(const Vec3&)>& u) {
  const Points values = blended(shape, q, u);
  for (std::size_t i = 0; i < values.size(); ++i) {
    EXPECT_LT((values[i] - u(lattice_xi(shape, q)[i])).norm(), 1e-13) << name(shape) << q;
  }
}

TEST(Blend, CornerWeightsAreBarycentricAndBilinear) {
  std::array<double, 4> w{};
  corner_weights(Shape::triangle, {0.2, 0.3, 0.0}, w);
  EXPECT_DOUBLE_EQ(w[0], 0.5);
  EXPECT_DOUBLE_EQ(w[1], 0.2);
  EXPECT_DOUBLE_EQ(w[2], 0.3);
  corner_weights(Shape::quadrilateral, {0.25, 0.5, 0.0}, w);
  EXPECT_DOUBLE_EQ(w[0], 0.375);
  EXPECT_DOUBLE_EQ(w[1], 0.125);
  EXPECT_DOUBLE_EQ(w[2], 0.125);
  EXPECT_DOUBLE_EQ(w[3], 0.375);
}

TEST(Blend, KeepsTheEdgesBitForBit) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  for (Shape shape : {Shape::triangle, Shape::quadrilateral}) {
    for (int q = 2; q <= 4; ++q) {
      Points before(static_cast<std::size_t>(node_count(shape, q)));
      for (Vec3& u : before) u = {value(random), value(random), value(random)};
      for (int corner : lattice_map(shape, q).corner) {
        before[static_cast<std::size_t>(corner)] = Vec3::Zero();
      }
      Points after = before;

      blend_face_interior(shape, q, after);

      for (const std::vector<int>& edge : lattice_map(shape, q).edge) {
        for (int node : edge) {
          EXPECT_EQ(after[static_cast<std::size_t>(node)], before[static_cast<std::size_t>(node)]);
        }
      }
    }
  }
}

TEST(Blend, FillsTheMiddleOfAQuadrilateralByHand) {
  // One edge rises by 1 at its middle: at the centre of the quad half of it is left. u on y = 0.
  Points u(9, Vec3::Zero());
  const LatticeMap& map = lattice_map(Shape::quadrilateral, 2);
  u[static_cast<std::size_t>(map.edge_interior[0][0])] = {0.0, 0.0, 1.0};

  blend_face_interior(Shape::quadrilateral, 2, u);

  EXPECT_NEAR(u[static_cast<std::size_t>(map.interior[0])].z(), 0.5, 1e-15);
}

TEST(Blend, FillsTheMiddleOfATriangleByHand) {
  // Order 3, edge 0 is u = s(1-s) e_z; the centroid (1/3,1/3) sees (1 - 1/3) u(1/2) = 2/3 * 1/4.
  Points u(10, Vec3::Zero());
  const LatticeMap& map = lattice_map(Shape::triangle, 3);
  for (int node : map.edge_interior[0]) u[static_cast<std::size_t>(node)] = {0.0, 0.0, 2.0 / 9.0};

  blend_face_interior(Shape::triangle, 3, u);

  EXPECT_NEAR(u[static_cast<std::size_t>(map.interior[0])].z(), 1.0 / 6.0, 1e-15);
}

TEST(Blend, OfATriangleMatchesItsClosedForm) {
  // Edges u_e = w_e s(1-s): the formula is sum w_e l_a l_b / (l_a + l_b).
  const std::array<double, 3> w{1.0, -0.4, 2.5};
  for (int q = 3; q <= 6; ++q) {
    expect_exact(Shape::triangle, q, [&](const Vec3& xi) -> Vec3 {
      const std::array<double, 3> l{1.0 - xi.x() - xi.y(), xi.x(), xi.y()};
      double sum = 0.0;
      for (std::size_t e = 0; e < 3; ++e) {
        const double a = l[e], b = l[(e + 1) % 3];
        if (a + b > 0.0) sum += w[e] * a * b / (a + b);
      }
      return {sum, -sum, 3.0 * sum};
    });
  }
}

TEST(Blend, OfAQuadrilateralGivesBackRuledFields) {
  const Vec3 a(1.0, -2.0, 0.5), b(0.3, 0.7, -1.1);
  for (int q = 2; q <= 6; ++q) {
    expect_exact(Shape::quadrilateral, q, [&](const Vec3& xi) -> Vec3 {
      const double x = xi.x(), y = xi.y();
      return x * (1.0 - x) * (1.0 + y) * a + (2.0 - x) * y * (1.0 - y) * b;
    });
  }
}

TEST(Blend, IsLinearInTheEdgesAndDoesNotDependOnTheFrame) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> value(-1.0, 1.0);
  for (Shape shape : {Shape::triangle, Shape::quadrilateral}) {
    const std::array<int, 4> turned =
        shape == Shape::triangle ? std::array{1, 2, 0, -1} : std::array{3, 2, 1, 0};
    const std::size_t n = static_cast<std::size_t>(corner_count(shape));
    const int q = 4;
    const std::vector<int> old_node = reorient(shape, q, std::span(turned.data(), n));
    Points u(static_cast<std::size_t>(node_count(shape, q)), Vec3::Zero());
    for (const std::vector<int>& edge : lattice_map(shape, q).edge_interior) {
      for (int node : edge) u[static_cast<std::size_t>(node)] = {value(random), value(random), 0.0};
    }
    Points other(u.size());
    for (std::size_t i = 0; i < u.size(); ++i) {
      other[i] = -3.0 * u[static_cast<std::size_t>(old_node[i])];
    }

    blend_face_interior(shape, q, u);
    blend_face_interior(shape, q, other);

    for (std::size_t i = 0; i < u.size(); ++i) {
      EXPECT_LT((other[i] + 3.0 * u[static_cast<std::size_t>(old_node[i])]).norm(), 1e-14);
    }
  }
}

}  // namespace
}  // namespace camber
