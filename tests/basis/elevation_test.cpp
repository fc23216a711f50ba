#include <camber/basis/lagrange.hpp>

#include <stdexcept>
#include <thread>

#include <gtest/gtest.h>

#include "samples.hpp"

namespace camber {
namespace {

/// Nodes of a curved element of no symmetry: any numbers do, these are smooth and repeatable.
Points bent_nodes(Shape shape, int p) {
  Points nodes;
  for (const Vec3& xi : lattice_xi(shape, p)) {
    nodes.push_back(xi + 0.2 * Vec3(std::sin(3 * xi[1] + xi[2]), std::cos(2 * xi[0] - xi[2]),
                                    std::sin(xi[0] + 2 * xi[1])));
  }
  return nodes;
}

Points apply(const MatX& E, const Points& nodes) {
  Points result(static_cast<std::size_t>(E.rows()), Vec3::Zero());
  for (Eigen::Index r = 0; r < E.rows(); ++r) {
    for (Eigen::Index c = 0; c < E.cols(); ++c) {
      result[static_cast<std::size_t>(r)] += E(r, c) * nodes[static_cast<std::size_t>(c)];
    }
  }
  return result;
}

TEST(Elevation, PutsTheMidpointOfALineWhereItIs) {
  const MatX& E = elevation_matrix(Shape::line, 1, 2);
  MatX expected(3, 2);
  expected << 1, 0, 0.5, 0.5, 0, 1;
  EXPECT_EQ(E, expected);
}

TEST(Elevation, LeavesTheShapeUnchanged) {
  for (Shape shape : test::k_shapes) {
    for (int p = 1; p <= k_max_tested_order; ++p) {
      const Points nodes = bent_nodes(shape, p);
      for (int q = p; q <= k_max_tested_order; ++q) {
        const Points raised = apply(elevation_matrix(shape, p, q), nodes);
        for (const Vec3& xi : test::inner_points(shape, 2)) {
          EXPECT_LT((evaluate(shape, q, raised, xi) - evaluate(shape, p, nodes, xi)).norm(), 1e-13)
              << name(shape) << p << q;
        }
      }
    }
  }
}

TEST(Elevation, AndSamplingBackGiveTheNodes) {
  for (Shape shape : test::k_shapes) {
    for (int p = 1; p <= 4; ++p) {
      for (int q = p; q <= 4; ++q) {
        const MatX round_trip = elevation_matrix(shape, q, p) * elevation_matrix(shape, p, q);
        const MatX identity = MatX::Identity(node_count(shape, p), node_count(shape, p));
        EXPECT_LT((round_trip - identity).cwiseAbs().maxCoeff(), 1e-13) << name(shape) << p << q;
      }
    }
  }
}

TEST(Elevation, SeesOnlyTheNodesOfAFaceOnThatFace) {
  for (Shape shape : test::k_volumes) {
    for (int p = 1; p <= 4; ++p) {
      for (int q = 1; q <= 4; ++q) {
        const MatX& E = elevation_matrix(shape, p, q);
        for (std::size_t f = 0; f < faces(shape).size(); ++f) {
          const std::vector<int>& from = lattice_map(shape, p).face[f];
          const std::vector<int>& to = lattice_map(shape, q).face[f];
          const MatX& face = elevation_matrix(faces(shape)[f].shape, p, q);
          std::vector<bool> of_face(static_cast<std::size_t>(E.cols()), false);
          for (int m : from) of_face[static_cast<std::size_t>(m)] = true;
          for (std::size_t n = 0; n < to.size(); ++n) {
            for (Eigen::Index c = 0; c < E.cols(); ++c) {
              const bool free = !of_face[static_cast<std::size_t>(c)];
              EXPECT_TRUE(!free || E(to[n], c) == 0.0) << name(shape) << p << q;
            }
            for (std::size_t m = 0; m < from.size(); ++m) {
              EXPECT_NEAR(E(to[n], from[m]),
                          face(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(m)), 1e-15);
            }
          }
        }
      }
    }
  }
}

TEST(Elevation, OfAnyOrderToItselfIsTheIdentity) {
  for (Shape shape : test::k_shapes) {
    EXPECT_EQ(elevation_matrix(shape, 4, 4),
              MatX::Identity(node_count(shape, 4), node_count(shape, 4)));
  }
  EXPECT_THROW(static_cast<void>(elevation_matrix(Shape::line, 0, 2)), std::invalid_argument);
}

TEST(Elevation, IsOneMatrixForAllThreads) {
  std::vector<const MatX*> seen(8, nullptr);
  {
    std::vector<std::jthread> threads;
    for (const MatX*& matrix : seen) {
      threads.emplace_back([&matrix] { matrix = &elevation_matrix(Shape::pyramid, 3, 5); });
    }
  }
  for (const MatX* matrix : seen) EXPECT_EQ(matrix, seen.front());
}

TEST(StraightNodes, InterpolateTheCornersLinearlyAlongEdges) {
  for (Shape shape : test::k_shapes) {
    const Points corner = [&] {
      const Points bent = bent_nodes(shape, 1);
      Points in_corner_order;
      for (int n : lattice_map(shape, 1).corner) {
        in_corner_order.push_back(bent[static_cast<std::size_t>(n)]);
      }
      return in_corner_order;
    }();
    for (int p = 1; p <= k_max_tested_order; ++p) {
      const Points nodes = straight_nodes(shape, p, corner);
      const LatticeMap& map = lattice_map(shape, p);
      for (std::size_t e = 0; e < map.edge.size(); ++e) {
        const Vec3 a = corner[static_cast<std::size_t>(edges(shape)[e][0])];
        const Vec3 b = corner[static_cast<std::size_t>(edges(shape)[e][1])];
        for (int i = 0; i <= p; ++i) {
          const Vec3 expected = a + (b - a) * i / p;
          const auto node = static_cast<std::size_t>(map.edge[e][static_cast<std::size_t>(i)]);
          EXPECT_LT((nodes[node] - expected).norm(), 1e-14) << name(shape) << p;
        }
      }
    }
  }
}

}  // namespace
}  // namespace camber
