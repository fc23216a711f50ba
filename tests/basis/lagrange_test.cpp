#include <camber/basis/lagrange.hpp>

#include <gtest/gtest.h>

#include "samples.hpp"

namespace camber {
namespace {

std::vector<double> values(Shape shape, int p, const Vec3& xi) {
  std::vector<double> N(static_cast<std::size_t>(node_count(shape, p)));
  lagrange_values(shape, p, xi, N);
  return N;
}

std::vector<Vec3> gradients(Shape shape, int p, const Vec3& xi) {
  std::vector<Vec3> dN(static_cast<std::size_t>(node_count(shape, p)));
  lagrange_gradients(shape, p, xi, dN);
  return dN;
}

TEST(Lagrange, IsTheTextbookQuadraticOnTheLine) {
  // At x = 1/4: (1-x)(1-2x), 4x(1-x), x(2x-1); slopes 4x-3, 4-8x, 4x-1.
  const Vec3 xi(0.25, 0, 0);

  const std::vector<double> N = values(Shape::line, 2, xi);
  const std::vector<Vec3> dN = gradients(Shape::line, 2, xi);

  EXPECT_DOUBLE_EQ(N[0], 0.375);
  EXPECT_DOUBLE_EQ(N[1], 0.75);
  EXPECT_DOUBLE_EQ(N[2], -0.125);
  EXPECT_DOUBLE_EQ(dN[0][0], -2.0);
  EXPECT_DOUBLE_EQ(dN[1][0], 2.0);
  EXPECT_DOUBLE_EQ(dN[2][0], 0.0);
}

TEST(Lagrange, IsTheRationalBasisOnTheLinearPyramid) {
  // r = xy/(1-z): nodes (0,0) 1-x-y-z+r, (1,0) x-r, (0,1) y-r, (1,1) r, apex z.
  const std::vector<double> N = values(Shape::pyramid, 1, Vec3(0.25, 0.125, 0.5));

  const double r = 0.0625;
  EXPECT_NEAR(N[0], 0.125 + r, 1e-15);
  EXPECT_NEAR(N[1], 0.25 - r, 1e-15);
  EXPECT_NEAR(N[2], 0.125 - r, 1e-15);
  EXPECT_NEAR(N[3], r, 1e-15);
  EXPECT_NEAR(N[4], 0.5, 1e-15);
}

TEST(Lagrange, SumsToOneAndItsGradientsToZero) {
  for (Shape shape : test::k_shapes) {
    for (int p = 0; p <= k_max_tested_order; ++p) {
      for (const Vec3& xi : test::inner_points(shape, 5)) {
        double sum = -1.0;
        Vec3 slope = Vec3::Zero();
        for (double N : values(shape, p, xi)) sum += N;
        for (const Vec3& dN : gradients(shape, p, xi)) slope += dN;
        EXPECT_LT(std::abs(sum), 1e-13) << name(shape) << p;
        EXPECT_LT(slope.norm(), 1e-12) << name(shape) << p;
      }
    }
  }
}

TEST(Lagrange, IsOneAtItsNodeAndZeroAtTheOthers) {
  for (Shape shape : test::k_shapes) {
    for (int p = 1; p <= k_max_tested_order; ++p) {
      const auto xi = lattice_xi(shape, p);
      for (std::size_t n = 0; n < xi.size(); ++n) {
        const std::vector<double> N = values(shape, p, xi[n]);
        for (std::size_t m = 0; m < N.size(); ++m) {
          EXPECT_NEAR(N[m], m == n ? 1.0 : 0.0, 1e-13) << name(shape) << p;
        }
      }
    }
  }
}

TEST(Lagrange, GradientIsTheLimitOfCentralDifferences) {
  // The error of central differences is h^2/6 times a third derivative, at most 1e5 here.
  constexpr double h = 1e-5;
  constexpr double k_tolerance = 1e-5;
  for (Shape shape : test::k_shapes) {
    for (int p = 1; p <= k_max_tested_order; ++p) {
      for (const Vec3& xi : test::inner_points(shape, 2)) {
        const std::vector<Vec3> dN = gradients(shape, p, xi);
        for (Eigen::Index d = 0; d < 3; ++d) {
          if (d >= dimension(shape)) {
            for (const Vec3& g : dN) EXPECT_EQ(g[d], 0.0);
            continue;
          }
          const Vec3 step = h * Vec3::Unit(d);
          const std::vector<double> plus = values(shape, p, xi + step);
          const std::vector<double> minus = values(shape, p, xi - step);
          for (std::size_t n = 0; n < dN.size(); ++n) {
            EXPECT_NEAR((plus[n] - minus[n]) / (2 * h), dN[n][d], k_tolerance) << name(shape) << p;
          }
        }
      }
    }
  }
}

TEST(Lagrange, IsThatOfTheFaceOnEveryFace) {
  for (Shape shape : test::k_volumes) {
    for (int p = 1; p <= k_max_tested_order; ++p) {
      const LatticeMap& map = lattice_map(shape, p);
      for (std::size_t f = 0; f < map.face.size(); ++f) {
        const LocalFace& face = faces(shape)[f];
        const auto corner = [&](std::size_t c) {
          return corners(shape)[static_cast<std::size_t>(face.corners[c])];
        };
        const Vec3 u = corner(1) - corner(0);
        const Vec3 v = corner(face.shape == Shape::triangle ? 2 : 3) - corner(0);
        for (const Vec3& t : test::inner_points(face.shape, 3)) {
          std::vector<double> N = values(shape, p, corner(0) + t[0] * u + t[1] * v);
          const std::vector<double> M = values(face.shape, p, t);
          for (std::size_t m = 0; m < M.size(); ++m) {
            N[static_cast<std::size_t>(map.face[f][m])] -= M[m];
          }
          for (double difference : N) EXPECT_LT(std::abs(difference), 1e-13) << name(shape) << p;
        }
      }
    }
  }
}

TEST(Lagrange, TakesTheAxialLimitAtThePyramidsApex) {
  for (int p = 1; p <= k_max_tested_order; ++p) {
    const std::vector<Vec3> apex = gradients(Shape::pyramid, p, Vec3(0, 0, 1));
    constexpr double s = 1e-9;  // distance to the apex
    const std::vector<Vec3> close = gradients(Shape::pyramid, p, Vec3(0.5 * s, 0.5 * s, 1 - s));
    for (std::size_t n = 0; n < apex.size(); ++n) {
      EXPECT_TRUE(apex[n].allFinite());
      EXPECT_LT((apex[n] - close[n]).norm(), 1e-4) << p;
    }
    EXPECT_NEAR(values(Shape::pyramid, p, Vec3(0, 0, 1)).back(), 1.0, 1e-13);
  }
}

TEST(Lagrange, TabulatesWhatItEvaluates) {
  for (Shape shape : test::k_shapes) {
    const Points xi = test::inner_points(shape, 2);
    const Tabulation table = tabulate(shape, 3, xi);
    ASSERT_EQ(table.values.rows(), std::ssize(xi));
    for (std::size_t r = 0; r < xi.size(); ++r) {
      const std::vector<double> N = values(shape, 3, xi[r]);
      const std::vector<Vec3> dN = gradients(shape, 3, xi[r]);
      for (std::size_t n = 0; n < N.size(); ++n) {
        const auto row = static_cast<Eigen::Index>(r), column = static_cast<Eigen::Index>(n);
        EXPECT_EQ(table.values(row, column), N[n]);
        for (std::size_t d = 0; d < 3; ++d) {
          if (static_cast<int>(d) < dimension(shape)) {
            EXPECT_EQ(table.gradient[d](row, column), dN[n][static_cast<Eigen::Index>(d)]);
          } else {
            EXPECT_EQ(table.gradient[d].size(), 0);
          }
        }
      }
    }
  }
}

}  // namespace
}  // namespace camber
