#include <camber/basis/lagrange.hpp>
#include <camber/basis/quadrature.hpp>
#include <camber/mesh/curved_mesh.hpp>

#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "../support/cube_mesh.hpp"
#include "../support/random_nodes.hpp"

namespace camber {
namespace {

using testing::cube_mesh;
using testing::Filling;
using testing::k_fillings;
using testing::random_affine;
using testing::random_orders;
using testing::random_xi;
using testing::shake;
using testing::transform;

/// Largest distance between the nodes that the two cells of a face have on it at order q.
double face_gap(const CurvedMesh& curved, Index f, int q) {
  const Topology& topology = curved.topology();
  const Shape shape = topology.face_shape[at(f)];
  std::array<Points, 2> seen;
  for (std::size_t side = 0; side < 2; ++side) {
    const Index c = topology.face2cell[at(f)][side];
    Points nodes;
    curved.gather(c, q, nodes);
    const std::span<const Index> cell_faces = topology.faces_of_cell(c);
    const std::size_t i = static_cast<std::size_t>(
        std::find(cell_faces.begin(), cell_faces.end(), f) - cell_faces.begin());
    const int view = topology.cell2face_view[at(topology.cell2face_offset[at(c)]) + i];
    const std::vector<int>& on_face = lattice_map(curved.linear().cell_shape[at(c)], q).face[i];
    const std::span<const int> in_frame = face_view_nodes(shape, view, q);
    seen[side].resize(on_face.size());
    for (std::size_t n = 0; n < on_face.size(); ++n) {
      seen[side][static_cast<std::size_t>(in_frame[n])] =
          nodes[static_cast<std::size_t>(on_face[n])];
    }
  }
  double gap = 0.0;
  for (std::size_t n = 0; n < seen[0].size(); ++n)
    gap = std::max(gap, (seen[0][n] - seen[1][n]).norm());
  return gap;
}

double volume_of(const CurvedMesh& curved, Index c, int q) {
  const Shape shape = curved.linear().cell_shape[at(c)];
  Points nodes;
  curved.gather(c, q, nodes);
  const Quadrature& rule = gauss(shape, 3 * q);
  double volume = 0.0;
  for (std::size_t g = 0; g < rule.points.size(); ++g) {
    volume += rule.weights[g] * jacobian(shape, q, nodes, rule.points[g]).determinant();
  }
  return volume;
}

TEST(MinimumRule, GivesEntitiesTheLowestOrderOfTheirCells) {
  const LinearMesh mesh = build_linear_mesh(cube_mesh(Filling::hybrid, 2, 1));
  const Topology topology = build_topology(mesh);
  std::mt19937 random(1);

  const OrderField orders = minimum_rule(topology, random_orders(mesh.cell_count(), 4, random));

  std::vector<int> edge(topology.edge_count(), 9), face(topology.face_count(), 9);
  for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
    for (Index e : topology.edges_of_cell(c))
      edge[at(e)] = std::min<int>(edge[at(e)], orders.cell[at(c)]);
    for (Index f : topology.faces_of_cell(c))
      face[at(f)] = std::min<int>(face[at(f)], orders.cell[at(c)]);
  }
  EXPECT_TRUE(std::equal(edge.begin(), edge.end(), orders.edge.begin()));
  EXPECT_TRUE(std::equal(face.begin(), face.end(), orders.face.begin()));
}

TEST(CurvedMesh, StoresOneHexOfOrderThreeAsEdgesFacesAndInside) {
  MeshData data = cube_mesh(Filling::hexes, 1, 1);
  const LinearMesh mesh = build_linear_mesh(data);
  const Topology topology = build_topology(mesh);

  const CurvedMesh curved(mesh, topology, minimum_rule(topology, {3}));

  // 4^3 nodes less 8 corners.
  EXPECT_EQ(curved.high_order_node_count(), 56u);
  EXPECT_EQ(curved.edge_nodes(0).size(), 2u);
  EXPECT_EQ(curved.face_nodes(0).size(), 4u);
  EXPECT_EQ(curved.cell_nodes(0).size(), 8u);
}

TEST(CurvedMesh, StartsAsTheStraightCopy) {
  std::mt19937 random(2);
  for (Filling filling : k_fillings) {
    MeshData data = cube_mesh(filling, 2, 7);
    transform(data, testing::warp);
    const LinearMesh mesh = build_linear_mesh(data);
    const Topology topology = build_topology(mesh);
    const CurvedMesh curved(mesh, topology,
                            minimum_rule(topology, random_orders(mesh.cell_count(), 4, random)));

    for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
      for (int q = curved.cell_order(c); q <= k_max_order; ++q) {
        Points nodes, straight;
        curved.gather(c, q, nodes);
        curved.gather_straight(c, q, straight);
        ASSERT_EQ(nodes.size(), straight.size());
        for (std::size_t n = 0; n < nodes.size(); ++n)
          EXPECT_LT((nodes[n] - straight[n]).norm(), 5e-15);
      }
    }
  }
}

TEST(CurvedMesh, HasNoGapBetweenNeighboursOfAnyOrderInAnyView) {
  std::mt19937 random(3);
  std::set<std::tuple<Shape, int, int>> views;
  double worst = 0.0;
  for (unsigned seed = 1; seed <= 16; ++seed) {
    for (Filling filling : k_fillings) {
      MeshData data = cube_mesh(filling, 2, seed);
      transform(data, random_affine(random));
      const LinearMesh mesh = build_linear_mesh(data);
      const Topology topology = build_topology(mesh);
      CurvedMesh curved(mesh, topology,
                        minimum_rule(topology, random_orders(mesh.cell_count(), 4, random)));
      shake(curved, 0.1, random);

      for (Index f = 0; at(f) < topology.face_count(); ++f) {
        if (topology.is_boundary(f)) continue;
        const std::array<Index, 2>& cells = topology.face2cell[at(f)];
        std::array<int, 2> view{};
        for (std::size_t side = 0; side < 2; ++side) {
          const std::span<const Index> own = topology.faces_of_cell(cells[side]);
          const auto i = std::find(own.begin(), own.end(), f) - own.begin();
          view[side] = topology.cell2face_view[at(topology.cell2face_offset[at(cells[side])]) +
                                               static_cast<std::size_t>(i)];
        }
        views.insert({topology.face_shape[at(f)], view[0], view[1]});
        const int lowest = std::max(curved.cell_order(cells[0]), curved.cell_order(cells[1]));
        for (int q = lowest; q <= k_max_order; ++q) worst = std::max(worst, face_gap(curved, f, q));
      }
    }
  }

  EXPECT_LE(worst, 1e-14);
  // One side walks the face forwards, the other backwards: 2 x 3 x 3 and 2 x 4 x 4 pairs.
  EXPECT_EQ(views.size(), 18u + 32u);
}

TEST(CurvedMesh, GathersTheSamePolynomialAtEveryHigherOrder) {
  std::mt19937 random(4);
  for (Filling filling : {Filling::hybrid, Filling::pyramids_and_tets}) {
    const LinearMesh mesh = build_linear_mesh(cube_mesh(filling, 2, 9));
    const Topology topology = build_topology(mesh);
    CurvedMesh curved(mesh, topology,
                      minimum_rule(topology, random_orders(mesh.cell_count(), 4, random)));
    shake(curved, 0.1, random);

    for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
      const Shape shape = mesh.cell_shape[at(c)];
      const int p = curved.cell_order(c);
      Points own, raised;
      curved.gather(c, p, own);
      for (int q = p + 1; q <= k_max_order; ++q) {
        curved.gather(c, q, raised);
        for (int k = 0; k < 4; ++k) {
          const Vec3 xi = random_xi(shape, random);
          EXPECT_LT((evaluate(shape, p, own, xi) - evaluate(shape, q, raised, xi)).norm(), 2e-14);
        }
      }
    }
  }
}

TEST(CurvedMesh, CarriesEdgesAndFacesOfLowerOrderIntoACellExactly) {
  const LinearMesh mesh = build_linear_mesh(cube_mesh(Filling::hybrid, 2, 10));
  const Topology topology = build_topology(mesh);
  std::mt19937 random(5);
  CurvedMesh curved(mesh, topology,
                    minimum_rule(topology, random_orders(mesh.cell_count(), 4, random)));
  shake(curved, 0.1, random);

  for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
    const int p = curved.cell_order(c);
    const LatticeMap& map = lattice_map(mesh.cell_shape[at(c)], p);
    Points nodes;
    curved.gather(c, p, nodes);
    for (std::size_t i = 0; i < topology.edges_of_cell(c).size(); ++i) {
      const Index e = topology.edges_of_cell(c)[i];
      const int r = curved.edge_order(e);
      Points own(static_cast<std::size_t>(r) + 1);
      curved.edge_lattice(e, r, own);
      const bool reversed =
          topology.cell2edge_reversed[at(topology.cell2edge_offset[at(c)]) + i] != 0;
      for (int k = 0; k <= p; ++k) {
        const double s = static_cast<double>(reversed ? p - k : k) / p;
        const Vec3 expected = evaluate(Shape::line, r, own, Vec3(s, 0, 0));
        EXPECT_LT(
            (nodes[static_cast<std::size_t>(map.edge[i][static_cast<std::size_t>(k)])] - expected)
                .norm(),
            1e-14);
      }
    }
  }
}

TEST(CurvedMesh, KeepsEveryVolumeWhenElevated) {
  std::mt19937 random(6);
  std::set<Shape> seen;
  for (Filling filling : {Filling::hybrid, Filling::prisms}) {
    MeshData data = cube_mesh(filling, 2, 11);
    transform(data, testing::warp);
    const LinearMesh mesh = build_linear_mesh(data);
    const Topology topology = build_topology(mesh);
    CurvedMesh curved(mesh, topology,
                      minimum_rule(topology, random_orders(mesh.cell_count(), 4, random)));
    shake(curved, 0.01, random);
    for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
      seen.insert(mesh.cell_shape[at(c)]);
      const double volume = volume_of(curved, c, curved.cell_order(c));
      for (int q = curved.cell_order(c); q <= k_max_order; ++q) {
        EXPECT_NEAR(volume_of(curved, c, q), volume, 1e-15);
      }
    }
  }
  EXPECT_EQ(seen.size(), 4u);
}

TEST(CurvedMesh, FillsTheCubeWhateverItsInsideLooksLike) {
  std::mt19937 random(7);
  for (Filling filling : k_fillings) {
    const LinearMesh mesh = build_linear_mesh(cube_mesh(filling, 2, 12));
    const Topology topology = build_topology(mesh);
    CurvedMesh curved(mesh, topology,
                      minimum_rule(topology, random_orders(mesh.cell_count(), 4, random)));
    // The boundary stays: moving nodes inside only shifts volume from cell to cell.
    shake(curved, 0.02, random);
    const CurvedMesh straight(mesh, topology, curved.orders());
    for (Index f = 0; at(f) < topology.face_count(); ++f) {
      if (!topology.is_boundary(f)) continue;
      std::copy(straight.face_nodes(f).begin(), straight.face_nodes(f).end(),
                curved.face_nodes(f).begin());
      for (int i = 0; i < topology.corners_of_face(f); ++i) {
        const Index e = topology.face2edge[at(f)][static_cast<std::size_t>(i)];
        std::copy(straight.edge_nodes(e).begin(), straight.edge_nodes(e).end(),
                  curved.edge_nodes(e).begin());
      }
    }

    double volume = 0.0;
    for (Index c = 0; at(c) < mesh.cell_count(); ++c)
      volume += volume_of(curved, c, curved.cell_order(c));

    EXPECT_NEAR(volume, 1.0, 1e-13);
  }
}

}  // namespace
}  // namespace camber
