// What must not change the verdict: motion, scale, degree elevation; and cells of extreme aspect
// ratio.
#include <camber/validity/element_validity.hpp>

#include <cmath>

#include <gtest/gtest.h>

#include "elements.hpp"

namespace camber {
namespace {

using testing::mapped;
using testing::transformed;
using testing::volume_shapes;

void expect_near(const JacobianBounds& a, const JacobianBounds& b, double factor,
                 double tolerance) {
  EXPECT_EQ(a.verdict, b.verdict);
  EXPECT_NEAR(a.min_lower * factor, b.min_lower, tolerance * factor);
  EXPECT_NEAR(a.min_upper * factor, b.min_upper, tolerance * factor);
  EXPECT_NEAR(a.max_upper * factor, b.max_upper, tolerance * factor);
  EXPECT_NEAR(a.scaled_jacobian, b.scaled_jacobian, tolerance);
  EXPECT_NEAR(a.jacobian_ratio, b.jacobian_ratio, tolerance);
}

TEST(Invariance, RotationAndTranslationLeaveTheBounds) {
  std::mt19937 generator(41);
  for (Shape shape : volume_shapes()) {
    for (int p = 1; p <= 4; ++p) {
      const Points nodes = testing::random_element(shape, p, 0.06 / p, generator);
      const Mat3 R = testing::rotation(1.1, testing::random_vector(generator));
      const Vec3 shift(300.0, -200.0, 100.0);
      const JacobianBounds before = certify(shape, p, nodes);

      const JacobianBounds after =
          certify(shape, p, transformed(nodes, [&](const Vec3& x) { return Vec3(R * x + shift); }));

      expect_near(before, after, 1.0, 1e-7);
    }
  }
}

TEST(Invariance, PowersOfTwoScaleTheBoundsExactly) {
  std::mt19937 generator(42);
  for (int exponent : {-40, -10, 10, 40}) {
    const double scale = std::ldexp(1.0, exponent);
    for (Shape shape : volume_shapes()) {
      const Points nodes = testing::random_element(shape, 3, 0.03, generator);
      const JacobianBounds before = certify(shape, 3, nodes);

      const JacobianBounds after =
          certify(shape, 3, transformed(nodes, [&](const Vec3& x) { return Vec3(scale * x); }));

      EXPECT_EQ(after.verdict, before.verdict);
      EXPECT_EQ(after.min_lower, before.min_lower * scale * scale * scale);
      EXPECT_EQ(after.scaled_jacobian, before.scaled_jacobian);
      EXPECT_EQ(after.jacobian_ratio, before.jacobian_ratio);
    }
  }
}

TEST(Invariance, MirroringAValidElementMakesItInvalid) {
  std::mt19937 generator(43);
  for (Shape shape : volume_shapes()) {
    for (int p = 1; p <= 3; ++p) {
      const Points nodes = testing::random_element(shape, p, 0.05 / p, generator);
      ASSERT_EQ(quick_verdict(shape, p, nodes), Verdict::valid);

      const JacobianBounds bounds = certify(
          shape, p, transformed(nodes, [](const Vec3& x) { return Vec3(x.x(), x.y(), -x.z()); }));

      EXPECT_EQ(bounds.verdict, Verdict::invalid);
      EXPECT_LT(bounds.scaled_jacobian, 0.0);
      EXPECT_GE(bounds.scaled_jacobian, -1.0);
    }
  }
}

TEST(Invariance, DegreeElevationLeavesVerdictAndBounds) {
  std::mt19937 generator(44);
  for (Shape shape : volume_shapes()) {
    for (int p = 1; p <= 3; ++p) {
      for (double amplitude : {0.05, 0.3}) {
        const Points nodes = testing::random_element(shape, p, amplitude / p, generator);
        const MatX& E = elevation_matrix(shape, p, p + 1);
        Points raised(static_cast<std::size_t>(E.rows()), Vec3::Zero());
        for (Eigen::Index r = 0; r < E.rows(); ++r) {
          for (Eigen::Index c = 0; c < E.cols(); ++c) {
            raised[static_cast<std::size_t>(r)] += E(r, c) * nodes[static_cast<std::size_t>(c)];
          }
        }
        CertifyOptions sharp;
        sharp.sharpness = 0.01;

        const JacobianBounds low = certify(shape, p, nodes, sharp);
        const JacobianBounds high = certify(shape, p + 1, raised, sharp);

        EXPECT_EQ(low.verdict, high.verdict) << name(shape) << p;
        // Two certified intervals of the same number overlap, and both are sharp.
        EXPECT_LE(low.min_lower, high.min_upper + 1e-12);
        EXPECT_LE(high.min_lower, low.min_upper + 1e-12);
        EXPECT_NEAR(low.min_upper, high.min_upper, 0.011 * std::abs(low.min_upper) + 1e-12);
        EXPECT_NEAR(low.max_upper, high.max_upper, 0.011 * low.max_upper);
      }
    }
  }
}

// A wall layer: height h, carried rigidly on a curved wall (a shear: det J = h), in a general
// position.
Points wall_cell(Shape shape, int p, double h, double tau) {
  const Mat3 R = testing::rotation(0.7, Vec3(1.0, 2.0, 3.0));
  return mapped(shape, p, [&](const Vec3& xi) {
    const double bump = 0.15 * xi.x() * (1.0 - xi.x()) + 0.1 * xi.x() * xi.y();
    // z-derivative h (1 + (tau - 1) x^2-like decay) : smallest, tau h, along x = 1.
    const double height = h * xi.z() * (1.0 + (tau - 1.0) * xi.x());
    return Vec3(R * Vec3(xi.x(), xi.y(), bump + height) + Vec3(2.0, 1.0, -3.0));
  });
}

TEST(ThinCells, KeepTheirVerdictDownToAspectTenMillion) {
  for (double h : {1e-3, 1e-5, 1e-6, 1e-7}) {
    for (Shape shape : {Shape::prism, Shape::hexahedron, Shape::tetrahedron}) {
      for (int p = 2; p <= 4; ++p) {
        const JacobianBounds bounds = certify(shape, p, wall_cell(shape, p, h, 1.0));

        EXPECT_EQ(bounds.verdict, Verdict::valid) << name(shape) << p << " h " << h;
        // Coordinates of size 4 are rounded to 4e-16: relative 1e-8 of the height 1e-7, amplified
        // by the differentiation.
        EXPECT_NEAR(bounds.min_lower / h, 1.0, 1e-6);
        EXPECT_EQ(quick_verdict(shape, p, wall_cell(shape, p, h, 0.01)), Verdict::valid);
        EXPECT_EQ(quick_verdict(shape, p, wall_cell(shape, p, h, -0.01)), Verdict::invalid);
        EXPECT_EQ(quick_verdict(shape, p, wall_cell(shape, p, -h, 1.0)), Verdict::invalid);
      }
    }
  }
}

TEST(ThinCells, PyramidsToo) {
  for (double h : {1e-3, 1e-5, 1e-7}) {
    for (int p = 1; p <= 4; ++p) {
      const auto flat = [&](double height) {
        return mapped(Shape::pyramid, p, [&](const Vec3& xi) {
          return Vec3(xi.x() + 2.0, xi.y() - 1.0, height * xi.z() + 0.3 * xi.x() + 0.1 * xi.y());
        });
      };

      EXPECT_EQ(quick_verdict(Shape::pyramid, p, flat(h)), Verdict::valid);
      EXPECT_EQ(quick_verdict(Shape::pyramid, p, flat(-h)), Verdict::invalid);
      // The third column acts on differences to the first node, so the width costs some digits
      // here.
      EXPECT_NEAR(certify(Shape::pyramid, p, flat(h)).min_lower / h, 1.0, 1e-3);
    }
  }
}

}  // namespace
}  // namespace camber
