// Inverted elements that nodes, corners and sub-simplices do not reveal, and degenerate ones.
#include <camber/reference/sampled_jacobian.hpp>
#include <camber/validity/element_validity.hpp>

#include <array>

#include <gtest/gtest.h>

#include "elements.hpp"

namespace camber {
namespace {

using testing::mapped;
using testing::volume_shapes;

// x(s) of a quadratic edge with nodes 0, m, 1.
double quadratic_edge(double s, double m) { return s + (4.0 * m - 2.0) * s * (1.0 - s); }

Points extruded_edge(Shape shape, int p, double m) {
  return mapped(shape, p,
                [m](const Vec3& xi) { return Vec3(quadratic_edge(xi.x(), m), xi.y(), xi.z()); });
}

// All sub-hexahedra of the lattice, by the determinant at each of their corners.
bool sub_hexahedra_are_positive(int p, const Points& nodes) {
  for (const LatticePoint& a : lattice(Shape::hexahedron, p)) {
    for (int corner = 0; corner < 8; ++corner) {
      Mat3 edges;
      for (int d = 0; d < 3; ++d) {
        const auto axis = static_cast<std::size_t>(d);
        LatticePoint from = a;
        for (int e = 0; e < 3; ++e) from[static_cast<std::size_t>(e)] += corner >> e & 1;
        LatticePoint to = from;
        from[axis] = a[axis];
        to[axis] = a[axis] + 1;
        if (*std::max_element(from.begin(), from.end()) > p || to[axis] > p)
          edges.setIdentity();
        else
          edges.col(d) = nodes[static_cast<std::size_t>(lattice_index(Shape::hexahedron, p, to))] -
                         nodes[static_cast<std::size_t>(lattice_index(Shape::hexahedron, p, from))];
      }
      if (edges.determinant() <= 0.0) return false;
    }
  }
  return true;
}

TEST(Zoo, QuadraticEdgeWithPositiveHalvesIsFoundInverted) {
  // Nodes 0, 0.2, 1: the halves are 0.2 and 0.8 long, but x'(0) = 4 * 0.2 - 1 = -0.2.
  for (Shape shape : volume_shapes()) {
    if (shape == Shape::pyramid) continue;  // x alone is not in its space off the base
    const Points nodes = extruded_edge(shape, 2, 0.2);

    const JacobianBounds bounds = certify(shape, 2, nodes);

    EXPECT_EQ(bounds.verdict, Verdict::invalid) << name(shape);
    EXPECT_NEAR(bounds.min_upper, -0.2, 1e-12);
    EXPECT_NEAR(bounds.worst_xi.x(), 0.0, 1e-12);
    EXPECT_EQ(quick_verdict(shape, 2, nodes), Verdict::invalid);
  }
  EXPECT_TRUE(sub_hexahedra_are_positive(2, extruded_edge(Shape::hexahedron, 2, 0.2)));
}

TEST(Zoo, TheSameEdgeStaysInvertedInHigherOrders) {
  for (int p = 3; p <= 5; ++p) {
    EXPECT_EQ(quick_verdict(Shape::hexahedron, p, extruded_edge(Shape::hexahedron, p, 0.2)),
              Verdict::invalid);
    EXPECT_EQ(quick_verdict(Shape::prism, p, extruded_edge(Shape::prism, p, 0.2)),
              Verdict::invalid);
    EXPECT_EQ(quick_verdict(Shape::tetrahedron, p, extruded_edge(Shape::tetrahedron, p, 0.2)),
              Verdict::invalid);
  }
}

TEST(Zoo, TheVerdictTurnsExactlyAtTheQuarterPoint) {
  // x'(0) = 4 m - 1: zero at m = 1/4, where the element is degenerate on a whole face.
  for (Shape shape : {Shape::hexahedron, Shape::prism, Shape::tetrahedron}) {
    EXPECT_EQ(quick_verdict(shape, 2, extruded_edge(shape, 2, 0.25 + 1e-9)), Verdict::valid);
    EXPECT_EQ(quick_verdict(shape, 2, extruded_edge(shape, 2, 0.25 - 1e-9)), Verdict::invalid);
    EXPECT_NE(quick_verdict(shape, 2, extruded_edge(shape, 2, 0.25)), Verdict::valid);
  }
}

// Moves the nodes of a valid element along a random direction until det J just becomes negative
// somewhere. `depth` is how negative, as a fraction of the reference determinant 1.
Points barely_inverted(Shape shape, int p, double depth, std::mt19937& generator) {
  const Points straight = mapped(shape, p, [](const Vec3& xi) { return xi; });
  Points direction;
  for (std::size_t n = 0; n < straight.size(); ++n) {
    direction.push_back(testing::random_vector(generator));
  }
  const auto moved = [&](double s) {
    Points nodes = straight;
    for (std::size_t n = 0; n < nodes.size(); ++n) nodes[n] += s * direction[n];
    return nodes;
  };
  CertifyOptions sharp;
  sharp.sharpness = 0.2;
  double low = 0.0, high = 2.0;
  for (int halving = 0; halving < 14; ++halving) {
    const double s = 0.5 * (low + high);
    (certify(shape, p, moved(s), sharp).min_upper > -depth ? low : high) = s;
  }
  return moved(high);
}

TEST(Zoo, PocketsBetweenTheNodesAreFoundInEveryShapeAndOrder) {
  std::mt19937 generator(31);
  for (Shape shape : volume_shapes()) {
    for (int p = 1; p <= 4; ++p) {
      // Linear tets (constant J) and pyramids (bilinear J) show all in their corners.
      if (p == 1 && (shape == Shape::tetrahedron || shape == Shape::pyramid)) continue;
      int hidden = 0;
      for (int trial = 0; trial < 60 && hidden == 0; ++trial) {
        const Points nodes = barely_inverted(shape, p, 1e-3, generator);
        const reference::SampledRange at_nodes = reference::sampled_jacobian(shape, p, nodes, p);
        if (at_nodes.minimum <= 0.0) continue;  // visible at a node
        ++hidden;

        const JacobianBounds bounds = certify(shape, p, nodes);

        EXPECT_EQ(bounds.verdict, Verdict::invalid) << name(shape) << p;
        EXPECT_EQ(quick_verdict(shape, p, nodes), Verdict::invalid);
        EXPECT_LT(reference::jacobian_determinant(shape, p, nodes, bounds.worst_xi), 0.0);
      }
      EXPECT_EQ(hidden, 1) << "no hidden pocket in " << name(shape) << p;
    }
  }
}

TEST(Zoo, ExactlyDegenerateElementsAreNeverValid) {
  using Map = std::function<Vec3(const Vec3&)>;
  const std::vector<std::pair<const char*, Map>> maps{
      {"flat", [](const Vec3& xi) { return Vec3(xi.x(), xi.y(), 0.0); }},
      {"flat and tilted",
       [](const Vec3& xi) { return Vec3(xi.x(), xi.y(), 0.3 * xi.x() + 0.7 * xi.y()); }},
      {"a line", [](const Vec3& xi) { return Vec3(xi.x(), 2.0 * xi.x(), 3.0 * xi.x()); }},
      {"a point", [](const Vec3&) { return Vec3(1.0, 2.0, 3.0); }},
      {"face onto an edge", [](const Vec3& xi) { return Vec3(xi.x(), xi.y() * xi.x(), xi.z()); }},
      {"edge onto a point",
       [](const Vec3& xi) { return Vec3(xi.x(), xi.y() * (xi.x() + xi.z()), xi.z()); }},
      {"mirrored", [](const Vec3& xi) { return Vec3(-xi.x(), xi.y(), xi.z()); }}};

  for (Shape shape : volume_shapes()) {
    for (int p = 2; p <= 4; ++p) {
      for (const auto& [what, map] : maps) {
        const Points nodes = mapped(shape, p, map);
        const reference::SampledRange range = reference::sampled_jacobian(shape, p, nodes, 5);
        if (range.minimum > 1e-9) continue;  // the pyramid's lattice never sees this collapse

        EXPECT_NE(certify(shape, p, nodes).verdict, Verdict::valid) << what << " " << name(shape);
        EXPECT_NE(quick_verdict(shape, p, nodes), Verdict::valid) << what << " " << name(shape);
      }
    }
  }
}

TEST(Zoo, CollapsedCornersAreNeverValid) {
  for (Shape shape : volume_shapes()) {
    for (const std::array<int, 2>& edge : edges(shape)) {
      Points corner(corners(shape).begin(), corners(shape).end());
      corner[static_cast<std::size_t>(edge[0])] = corner[static_cast<std::size_t>(edge[1])];
      for (int p = 1; p <= 3; ++p) {
        EXPECT_NE(quick_verdict(shape, p, straight_nodes(shape, p, corner)), Verdict::valid);
      }
    }
  }
}

TEST(Zoo, TetWithTwoFacesOnOneSmoothSurfaceIsNotValid) {
  // Corners 0 and 1 on the edge, 2 and 3 in the plane z = 0 of the surface at that edge: the two
  // faces are tangent there, J = 0 along the edge, whatever the rest does.
  Points nodes = mapped(Shape::tetrahedron, 2, [](const Vec3& xi) {
    const double y = xi.y() - xi.z();
    return Vec3(xi.x(), y, 0.5 * (xi.y() + xi.z()) * (xi.y() + xi.z()));
  });

  EXPECT_NE(quick_verdict(Shape::tetrahedron, 2, nodes), Verdict::valid);
}

}  // namespace
}  // namespace camber
