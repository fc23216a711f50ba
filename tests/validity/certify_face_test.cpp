#include <camber/reference/sampled_jacobian.hpp>
#include <camber/validity/element_validity.hpp>

#include <gtest/gtest.h>

#include "elements.hpp"

namespace camber {
namespace {

using testing::mapped;

const std::vector<Shape>& face_shapes() {
  static const std::vector<Shape> shapes{Shape::triangle, Shape::quadrilateral};
  return shapes;
}

TEST(CertifyFace, FlatFacesHaveRatioOne) {
  for (Shape shape : face_shapes()) {
    for (int p = 1; p <= 4; ++p) {
      const Points nodes = mapped(shape, p, [](const Vec3& xi) {
        return Vec3(2.0 * xi.x(), 3.0 * xi.y() + xi.x(), xi.x() - xi.y());
      });

      const JacobianBounds bounds = certify_face(shape, p, nodes);

      EXPECT_EQ(bounds.verdict, Verdict::valid);
      EXPECT_NEAR(bounds.min_lower, 1.0, 1e-11);
      EXPECT_NEAR(bounds.min_upper, 1.0, 1e-11);
      EXPECT_NEAR(bounds.max_upper, 1.0, 1e-11);
    }
  }
}

TEST(CertifyFace, ABulgeInTheNormalDirectionDoesNotMatter) {
  // z = f(x, y) over a flat face: n . N = |N|^2 whatever f.
  for (Shape shape : face_shapes()) {
    const Points nodes = mapped(shape, 4, [](const Vec3& xi) {
      const double bubble = xi.x() * (1.0 - xi.x()) * xi.y() * (1.0 - xi.x() - xi.y());
      return Vec3(xi.x(), xi.y(), 5.0 * bubble);
    });

    EXPECT_NEAR(certify_face(shape, 4, nodes).min_lower, 1.0, 1e-9);
  }
}

TEST(CertifyFace, AQuadraticEdgeBunchedInsideTheFaceIsInverted) {
  // Nodes 0, 0.2, 1 along x: n . N / |N|^2 = x'(0) = -0.2.
  for (Shape shape : face_shapes()) {
    const Points nodes = mapped(shape, 2, [](const Vec3& xi) {
      return Vec3(xi.x() - 1.2 * xi.x() * (1.0 - xi.x()), xi.y(), 0.0);
    });

    const JacobianBounds bounds = certify_face(shape, 2, nodes);

    EXPECT_EQ(bounds.verdict, Verdict::invalid);
    EXPECT_NEAR(bounds.min_upper, -0.2, 1e-12);
  }
}

TEST(CertifyFace, BoundsContainDenseSamplesAndVerdictsAreNeverContradicted) {
  std::mt19937 generator(51);
  int valid = 0, invalid = 0;
  for (Shape shape : face_shapes()) {
    for (int p = 1; p <= 4; ++p) {
      for (int trial = 0; trial < 20; ++trial) {
        const Points nodes = testing::random_element(shape, p, 0.03 * (trial + 1) / p, generator);
        const JacobianBounds bounds = certify_face(shape, p, nodes);
        const reference::SampledRange range = reference::sampled_normal(shape, p, nodes, 20);

        if (bounds.verdict == Verdict::undecided) continue;
        EXPECT_LE(bounds.min_lower, range.minimum + 1e-10);
        EXPECT_GE(bounds.max_upper, range.maximum - 1e-10);
        if (bounds.verdict == Verdict::valid) {
          EXPECT_GT(range.minimum, 0.0);
        }
        if (bounds.verdict == Verdict::invalid) {
          EXPECT_LT(bounds.min_upper, 0.0);
        }
        valid += bounds.verdict == Verdict::valid;
        invalid += bounds.verdict == Verdict::invalid;
      }
    }
  }
  EXPECT_GT(valid, 40);
  EXPECT_GT(invalid, 10);
}

TEST(CertifyFace, DegenerateFacesAreNeverValid) {
  for (Shape shape : face_shapes()) {
    for (int p = 1; p <= 3; ++p) {
      const Points line = mapped(shape, p, [](const Vec3& xi) {
        return Vec3(xi.x() + xi.y(), 2.0 * (xi.x() + xi.y()), 1.0);
      });
      const Points point = mapped(shape, p, [](const Vec3&) { return Vec3(1.0, 1.0, 1.0); });

      EXPECT_NE(certify_face(shape, p, line).verdict, Verdict::valid);
      EXPECT_NE(certify_face(shape, p, point).verdict, Verdict::valid);
    }
  }
}

TEST(CertifyFace, TurnsWithTheFace) {
  std::mt19937 generator(52);
  for (Shape shape : face_shapes()) {
    const Points nodes = testing::random_element(shape, 3, 0.03, generator);
    const Mat3 R = testing::rotation(2.0, Vec3(1.0, -1.0, 0.5));
    const JacobianBounds before = certify_face(shape, 3, nodes);

    const JacobianBounds after = certify_face(
        shape, 3, testing::transformed(nodes, [&](const Vec3& x) { return Vec3(1e3 * (R * x)); }));

    EXPECT_EQ(after.verdict, before.verdict);
    EXPECT_NEAR(after.min_lower, before.min_lower, 1e-10);
    EXPECT_NEAR(after.max_upper, before.max_upper, 1e-10);
  }
}

}  // namespace
}  // namespace camber
