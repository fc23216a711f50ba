#include <camber/basis/lagrange.hpp>
#include <camber/basis/quadrature.hpp>
#include <camber/metric/cost.hpp>
#include <camber/metric/element_quality.hpp>

#include <algorithm>
#include <cmath>
#include <random>
#include <stdexcept>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

namespace camber {
namespace {

constexpr std::array k_shapes{Shape::triangle, Shape::quadrilateral, Shape::tetrahedron,
                              Shape::pyramid,  Shape::prism,         Shape::hexahedron};

template <class Map>
Points mapped(Shape shape, int p, const Map& x) {
  Points nodes;
  for (const Vec3& xi : lattice_xi(shape, p)) nodes.push_back(x(xi));
  return nodes;
}

TEST(ElementCost, OfEveryStraightElementIsOne) {
  std::mt19937 generator(1);
  std::uniform_real_distribution<double> uniform(-0.1, 0.1);
  for (Shape shape : k_shapes) {
    for (int p = 1; p <= 4; ++p) {
      Points corner;
      for (const Vec3& xi : corners(shape)) {
        // Thin and far away, but straight.
        const Vec3 x = xi + Vec3(uniform(generator), uniform(generator), uniform(generator));
        corner.push_back(Vec3(100.0 + x.x(), x.y(), 1e-4 * x.z()));
      }

      const ElementCost cost = element_cost(shape, p, straight_nodes(shape, p, corner));

      EXPECT_NEAR(cost.minimum, 1.0, 1e-6) << name(shape) << p;
      EXPECT_NEAR(cost.average, 1.0, 1e-6) << name(shape) << p;
      EXPECT_LE(cost.minimum, 1.0 + 1e-12);
    }
  }
}

TEST(ElementCost, OfAShearByHand) {
  // y moved by x (1 - x): A = [1 0; 1-2x 1] in the plane, tau = 1, WCN = (2 + (1-2x)^2) / 2 in 2D.
  // Gauss points of three per direction: x = 1/2 and 1/2 -+ sqrt(0.15); (1-2x)^2 = 0.6 at worst.
  const Points nodes = mapped(Shape::quadrilateral, 2, [](const Vec3& xi) {
    return Vec3(xi.x(), xi.y() + xi.x() * (1.0 - xi.x()), 0.0);
  });

  const ElementCost cost = element_cost(Shape::quadrilateral, 2, nodes);

  EXPECT_NEAR(cost.minimum, 1.0 / 1.3, 1e-12);
  EXPECT_NEAR(cost.average, (2.0 / 1.3 + 1.0) / 3.0, 1e-12);
}

TEST(ElementCost, IsNegativeTauWhereInverted) {
  // x'(s) = 1 - 1.2 (1 - 2s) is -0.2 at s = 0; at the first of three Gauss points s = 1/2 -
  // sqrt(0.15): 1 - 2.4 sqrt(0.15).
  const double at_gauss = 1.0 - 2.4 * std::sqrt(0.15);
  const Points nodes = mapped(Shape::hexahedron, 2, [](const Vec3& xi) {
    return Vec3(xi.x() - 1.2 * xi.x() * (1.0 - xi.x()), xi.y(), xi.z());
  });
  EXPECT_NEAR(element_cost(Shape::hexahedron, 2, nodes).minimum,
              at_gauss / ((std::sqrt(2.0 + at_gauss * at_gauss) *
                           std::sqrt(2.0 + 1.0 / (at_gauss * at_gauss))) /
                          3.0),
              1e-12);

  // Folded further, x' = 1 - 2 (1 - 2s): tau = 1 - 4 sqrt(0.15) < 0 there, and that is the cost.
  const Points folded = mapped(Shape::hexahedron, 2, [](const Vec3& xi) {
    return Vec3(xi.x() - 2.0 * xi.x() * (1.0 - xi.x()), xi.y(), xi.z());
  });
  EXPECT_NEAR(element_cost(Shape::hexahedron, 2, folded).minimum, 1.0 - 4.0 * std::sqrt(0.15),
              1e-12);
}

TEST(ElementCost, DoesNotChangeWithRotationScaleAndPlace) {
  std::mt19937 generator(2);
  std::uniform_real_distribution<double> uniform(-0.02, 0.02);
  const Mat3 R = Eigen::AngleAxisd(0.8, Vec3(3, 1, 2).normalized()).matrix();
  for (Shape shape : k_shapes) {
    Points nodes = mapped(shape, 3, [&](const Vec3& xi) {
      return Vec3(xi + Vec3(uniform(generator), uniform(generator), uniform(generator)));
    });
    const ElementCost before = element_cost(shape, 3, nodes);
    for (Vec3& x : nodes) x = 7.0 * (R * x) + Vec3(1, 2, 3);

    const ElementCost after = element_cost(shape, 3, nodes);

    EXPECT_NEAR(after.minimum, before.minimum, 1e-11) << name(shape);
    EXPECT_NEAR(after.average, before.average, 1e-11) << name(shape);
    EXPECT_LT(before.minimum, 1.0);
    EXPECT_LE(before.minimum, before.average);
  }
}

TEST(ElementCost, WithoutAnIdealIsZero) {
  const Points flat =
      mapped(Shape::hexahedron, 2, [](const Vec3& xi) { return Vec3(xi.x(), xi.y(), 0.0); });
  EXPECT_EQ(element_cost(Shape::hexahedron, 2, flat).minimum, 0.0);
}

TEST(ElementCosts, AreThoseOfEveryElementAloneToTheBit) {
  std::mt19937 generator(3);
  std::uniform_real_distribution<double> uniform(-0.3, 0.3);  // some of them inverted
  for (Shape shape : {Shape::tetrahedron, Shape::pyramid, Shape::prism, Shape::hexahedron}) {
    for (int p = 1; p <= 4; ++p) {
      const std::size_t n = static_cast<std::size_t>(node_count(shape, p));
      std::vector<ElementCost> costs(19);  // full lanes and a rest
      Points nodes;
      for (std::size_t e = 0; e < costs.size(); ++e) {
        for (const Vec3& xi : lattice_xi(shape, p)) {
          nodes.push_back(xi +
                          Vec3(uniform(generator), uniform(generator), uniform(generator)) / p);
        }
      }

      element_costs(shape, p, nodes, costs);

      for (std::size_t e = 0; e < costs.size(); ++e) {
        const ElementCost alone =
            element_cost(shape, p, std::span<const Vec3>(nodes).subspan(e * n, n));
        EXPECT_EQ(costs[e].minimum, alone.minimum) << name(shape) << p;
        EXPECT_EQ(costs[e].average, alone.average) << name(shape) << p;
      }
    }
  }
}

TEST(ElementCosts, AreTheFormulaAtTheGaussPoints) {
  std::mt19937 generator(4);
  std::uniform_real_distribution<double> uniform(-0.02, 0.02);
  for (Shape shape : {Shape::tetrahedron, Shape::pyramid, Shape::prism, Shape::hexahedron}) {
    const Points nodes = mapped(shape, 2, [&](const Vec3& xi) {
      return Vec3(xi + Vec3(uniform(generator), uniform(generator), uniform(generator)));
    });
    Points corner(static_cast<std::size_t>(corner_count(shape)));
    for (std::size_t c = 0; c < corner.size(); ++c) {
      corner[static_cast<std::size_t>(lattice_map(shape, 1).corner[c])] =
          nodes[static_cast<std::size_t>(lattice_map(shape, 2).corner[c])];
    }
    double lowest = 1.0;
    for (const Vec3& xi : gauss(shape, 5).points) {
      const Mat3 W_inverse = jacobian(shape, 1, corner, xi).inverse();
      lowest = std::min(lowest, camber::cost<double, 3>(jacobian(shape, 2, nodes, xi), W_inverse));
    }

    // Up to the order in which the Jacobians are summed.
    EXPECT_NEAR(element_cost(shape, 2, nodes).minimum, lowest, 1e-13) << name(shape);
  }
}

TEST(ElementCost, RejectsWhatIsNoElement) {
  const Points nodes(8, Vec3::Zero());
  EXPECT_THROW((void)element_cost(Shape::hexahedron, 2, nodes), std::invalid_argument);
  EXPECT_THROW((void)element_cost(Shape::line, 7, nodes), std::invalid_argument);
  EXPECT_THROW((void)element_cost(Shape::hexahedron, 0, nodes), std::invalid_argument);
}

}  // namespace
}  // namespace camber
