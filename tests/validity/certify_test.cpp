#include <camber/reference/sampled_jacobian.hpp>
#include <camber/validity/element_validity.hpp>

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gtest/gtest.h>

#include "elements.hpp"

namespace camber {
namespace {

using testing::mapped;
using testing::volume_shapes;

constexpr CertifyOptions k_verdict_only{12, std::numeric_limits<double>::infinity()};

TEST(Certify, ReferenceElementsHaveJacobianOne) {
  for (Shape shape : volume_shapes()) {
    for (int p = 1; p <= 5; ++p) {
      const Points nodes = mapped(shape, p, [](const Vec3& xi) { return xi; });

      const JacobianBounds bounds = certify(shape, p, nodes);

      EXPECT_EQ(bounds.verdict, Verdict::valid) << name(shape) << p;
      EXPECT_NEAR(bounds.min_lower, 1.0, 1e-8);
      EXPECT_NEAR(bounds.min_upper, 1.0, 1e-8);
      EXPECT_NEAR(bounds.max_upper, 1.0, 1e-8);
      EXPECT_NEAR(bounds.scaled_jacobian, 1.0, 1e-8);
      EXPECT_NEAR(bounds.jacobian_ratio, 1.0, 1e-8);
    }
  }
}

TEST(Certify, LinearTetIsItsDeterminant) {
  // Edges (2,0,0), (1,3,0), (0,1,4): det = 2 * 3 * 4 = 24.
  const Points nodes{{5, 5, 5}, {7, 5, 5}, {6, 8, 5}, {5, 6, 9}};

  const JacobianBounds bounds = certify(Shape::tetrahedron, 1, nodes);

  EXPECT_EQ(bounds.verdict, Verdict::valid);
  EXPECT_NEAR(bounds.min_lower, 24.0, 1e-11);
  EXPECT_NEAR(bounds.max_upper, 24.0, 1e-11);
}

TEST(Certify, FindsTheMinimumInsideAnEdge) {
  // x = s + 1.6 s(1-s)(1-2s) is cubic, x' = 1 + 1.6(1 - 6s + 6s^2): 2.6 at the ends and
  // 1 + 1.6 (1 - 1.5) = 0.2 in the middle. y and z are untouched, so det J = x'.
  const auto x = [](const Vec3& xi) {
    const double s = xi.x();
    return Vec3(s + 1.6 * s * (1.0 - s) * (1.0 - 2.0 * s), xi.y(), xi.z());
  };
  CertifyOptions sharp;
  sharp.sharpness = 1e-3;

  for (Shape shape : {Shape::hexahedron, Shape::prism, Shape::tetrahedron}) {
    const JacobianBounds bounds = certify(shape, 3, mapped(shape, 3, x), sharp);

    EXPECT_EQ(bounds.verdict, Verdict::valid);
    EXPECT_LE(bounds.min_lower, 0.2);
    EXPECT_GE(bounds.min_lower, 0.2 * (1.0 - 1.1e-3));
    EXPECT_GE(bounds.min_upper, 0.2 - 1e-12);
    EXPECT_NEAR(bounds.max_upper, 2.6, 2.6e-3 + 1e-12);
    EXPECT_NEAR(bounds.scaled_jacobian, 0.2 / 2.6, 2e-4);
    EXPECT_NEAR(bounds.jacobian_ratio, 0.2, 2.1e-4);
    EXPECT_NEAR(bounds.worst_xi.x(), 0.5, 0.05);
  }
}

TEST(Certify, ALinearPrismMayTaperButNotTurnOver) {
  // Top triangle scaled by t: det J = ((1-z) + t z)^2, at the top t^2; a turned top (t < 0) crosses
  // zero.
  const auto tapered = [](double t) {
    return mapped(Shape::prism, 1, [t](const Vec3& xi) {
      const double scale = 1.0 - xi.z() + t * xi.z();
      return Vec3(scale * xi.x(), scale * xi.y(), xi.z());
    });
  };

  const JacobianBounds bounds = certify(Shape::prism, 1, tapered(0.5));

  EXPECT_EQ(bounds.verdict, Verdict::valid);
  EXPECT_NEAR(bounds.min_upper, 0.25, 1e-12);
  EXPECT_NEAR(bounds.max_upper, 1.0, 1e-12);
  EXPECT_EQ(bounds.jacobian_ratio, 1.0);
  EXPECT_NE(certify(Shape::prism, 1, tapered(-0.5)).verdict, Verdict::valid);
  EXPECT_NE(certify(Shape::prism, 1, tapered(0.0)).verdict, Verdict::valid);
}

TEST(Certify, BoundsContainDenseSamplesAndVerdictsAreNeverContradicted) {
  std::mt19937 generator(21);
  int valid = 0, invalid = 0, undecided = 0;
  for (Shape shape : volume_shapes()) {
    for (int p = 1; p <= 4; ++p) {
      for (int trial = 0; trial < 10; ++trial) {
        // From nearly straight to hopeless.
        const double amplitude = 0.04 * (trial + 1) / p;
        const Points nodes = testing::random_element(shape, p, amplitude, generator);
        const JacobianBounds bounds = certify(shape, p, nodes);
        const reference::SampledRange range =
            reference::sampled_jacobian(shape, p, nodes, p < 4 ? 9 : 7);
        const double slack = 1e-12 * range.maximum;

        EXPECT_LE(bounds.min_lower, range.minimum + slack) << name(shape) << p;
        EXPECT_LE(bounds.min_lower, bounds.min_upper);
        EXPECT_GE(bounds.max_upper, range.maximum - slack);
        const double at_worst = reference::jacobian_determinant(shape, p, nodes, bounds.worst_xi);
        if (bounds.worst_xi.z() < 1.0 || shape != Shape::pyramid) {
          EXPECT_NEAR(at_worst, bounds.min_upper, 1e-5 * bounds.max_upper) << name(shape) << p;
        }
        if (bounds.verdict == Verdict::valid) {
          EXPECT_GT(range.minimum, 0.0);
          EXPECT_LE(bounds.scaled_jacobian, range.minimum / range.maximum + 1e-12);
          EXPECT_GT(bounds.scaled_jacobian, 0.0);
        }
        if (bounds.verdict == Verdict::invalid) {
          EXPECT_LT(bounds.min_upper, 0.0);
        }
        EXPECT_EQ(quick_verdict(shape, p, nodes), bounds.verdict);
        EXPECT_EQ(certify(shape, p, nodes, k_verdict_only).verdict, bounds.verdict);
        valid += bounds.verdict == Verdict::valid;
        invalid += bounds.verdict == Verdict::invalid;
        undecided += bounds.verdict == Verdict::undecided;
      }
    }
  }
  EXPECT_GT(valid, 30);
  EXPECT_GT(invalid, 30);
  EXPECT_EQ(undecided, 0);
}

TEST(Certify, IsAsSharpAsAsked) {
  std::mt19937 generator(22);
  for (double sharpness : {0.3, 0.1, 0.01}) {
    for (Shape shape : volume_shapes()) {
      for (int p = 2; p <= 3; ++p) {
        const Points nodes = testing::random_element(shape, p, 0.08 / p, generator);
        CertifyOptions options;
        options.sharpness = sharpness;

        const JacobianBounds bounds = certify(shape, p, nodes, options);

        EXPECT_LE(bounds.min_upper - bounds.min_lower,
                  sharpness * std::abs(bounds.min_upper) + 1e-12);
      }
    }
  }
}

TEST(Certify, RatioBoundHoldsAgainstTheStraightCopy) {
  std::mt19937 generator(23);
  for (Shape shape : volume_shapes()) {
    for (int p = 2; p <= 4; ++p) {
      // Random corners, then random nodes on top of the straight element.
      Points corner;
      for (const Vec3& xi : corners(shape)) {
        corner.push_back(xi + 0.1 * testing::random_vector(generator));
      }
      Points nodes = straight_nodes(shape, p, corner);
      const std::vector<int>& is_corner = lattice_map(shape, p).corner;
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        if (std::count(is_corner.begin(), is_corner.end(), static_cast<int>(n)) == 0) {
          nodes[n] += 0.05 / p * testing::random_vector(generator);
        }
      }
      CertifyOptions sharp;
      sharp.sharpness = 0.05;

      const JacobianBounds bounds = certify(shape, p, nodes, sharp);
      const reference::SampledRange range = reference::sampled_ratio(shape, p, nodes, 8);

      EXPECT_LE(bounds.jacobian_ratio, range.minimum + 1e-12) << name(shape) << p;
      // Sampling misses a little of the minimum; the bound is within its sharpness of the truth.
      EXPECT_GE(bounds.jacobian_ratio, range.minimum - 0.15) << name(shape) << p;
    }
  }
}

TEST(Certify, FallsBackWhereTheStraightCopyIsInverted) {
  // A hexahedron whose top corners are turned over, with a Q2 node pattern on top: no Jc to divide
  // by.
  const Points nodes = mapped(Shape::hexahedron, 2, [](const Vec3& xi) {
    return Vec3(xi.x(), xi.y(), xi.z() * (1.0 - 2.0 * xi.x()));
  });

  const JacobianBounds bounds = certify(Shape::hexahedron, 2, nodes);

  EXPECT_EQ(bounds.verdict, Verdict::invalid);
  EXPECT_LE(bounds.jacobian_ratio, 0.0);
  EXPECT_EQ(bounds.jacobian_ratio, std::min(0.0, bounds.scaled_jacobian));
}

TEST(Certify, NodesThatAreNotNumbersAreUndecided) {
  for (double bad :
       {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), 1e200}) {
    for (Shape shape : volume_shapes()) {
      Points nodes = mapped(shape, 2, [](const Vec3& xi) { return xi; });
      nodes[3].y() = bad;

      EXPECT_NE(certify(shape, 2, nodes).verdict, Verdict::valid);
      EXPECT_NE(quick_verdict(shape, 2, nodes), Verdict::valid);
    }
  }
}

TEST(Certify, RejectsWhatIsNoElement) {
  const Points nodes(8, Vec3::Zero());

  EXPECT_THROW((void)certify(Shape::hexahedron, 2, nodes), std::invalid_argument);
  EXPECT_THROW((void)certify(Shape::quadrilateral, 1, nodes), std::invalid_argument);
  EXPECT_THROW((void)certify(Shape::hexahedron, 0, nodes), std::invalid_argument);
  EXPECT_THROW((void)certify(Shape::line, 1, nodes), std::invalid_argument);
  EXPECT_THROW((void)certify_face(Shape::tetrahedron, 1, nodes), std::invalid_argument);
}

}  // namespace
}  // namespace camber
