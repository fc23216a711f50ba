#include <camber/basis/lagrange.hpp>
#include <camber/basis/quadrature.hpp>
#include <camber/mesh/split_cells.hpp>
#include <camber/validity/element_validity.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include <gtest/gtest.h>

#include "../support/cube_mesh.hpp"

namespace camber {
namespace {

using testing::cube_mesh;
using testing::Filling;

Points straight_nodes(const LinearMesh& mesh, Index c) {
  const std::vector<int>& corner = lattice_map(mesh.cell_shape[at(c)], 1).corner;
  const std::span<const Index> v = mesh.cell(c);
  Points nodes(v.size());
  for (std::size_t i = 0; i < v.size(); ++i) {
    nodes[static_cast<std::size_t>(corner[i])] = mesh.vertices[at(v[i])];
  }
  return nodes;
}

double volume(const LinearMesh& mesh) {
  double sum = 0.0;
  for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
    const Shape shape = mesh.cell_shape[at(c)];
    const Points nodes = straight_nodes(mesh, c);
    const Quadrature& rule = gauss(shape, 4);
    std::vector<Vec3> dN(nodes.size());
    for (std::size_t q = 0; q < rule.points.size(); ++q) {
      lagrange_gradients(shape, 1, rule.points[q], dN);
      Mat3 J = Mat3::Zero();
      for (std::size_t n = 0; n < nodes.size(); ++n) J += nodes[n] * dN[n].transpose();
      sum += rule.weights[q] * J.determinant();
    }
  }
  return sum;
}

void expect_positive(const LinearMesh& mesh) {
  for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
    EXPECT_EQ(quick_verdict(mesh.cell_shape[at(c)], 1, straight_nodes(mesh, c)), Verdict::valid);
  }
}

std::size_t boundary_faces(const LinearMesh& mesh) {
  const Topology topology = build_topology(mesh);
  std::size_t n = 0;
  for (Index f = 0; at(f) < topology.face_count(); ++f) n += topology.is_boundary(f);
  return n;
}

TEST(SplitFromCentre, KeepsVolumeAndSurfaceForEveryShape) {
  std::mt19937 random(3);
  MeshData data = cube_mesh(Filling::hybrid, 2, 5);
  testing::transform(data, testing::random_affine(random));
  const LinearMesh mesh = build_linear_mesh(data);
  std::vector<Index> all(mesh.cell_count()), split;
  for (std::size_t c = 0; c < all.size(); ++c) all[c] = static_cast<Index>(c);

  const LinearMesh cut = split_from_centre(mesh, all, &split);

  EXPECT_EQ(split, all);
  EXPECT_EQ(cut.vertices.size(), mesh.vertices.size() + mesh.cell_count());
  EXPECT_NEAR(volume(cut), volume(mesh), 1e-13 * volume(mesh));
  EXPECT_EQ(boundary_faces(cut), boundary_faces(mesh));
  expect_positive(cut);
}

TEST(SplitFromCentre, LeavesOtherCellsAndTheirNumbersAlone) {
  const LinearMesh mesh = build_linear_mesh(cube_mesh(Filling::tets, 2, 1));

  const LinearMesh cut = split_from_centre(mesh, {3});

  EXPECT_EQ(cut.cell_count(), mesh.cell_count() + 3);
  EXPECT_EQ(cut.cell_tags[3], mesh.cell_tags[4]);
  std::vector<GlobalId> tags = cut.cell_tags;
  std::sort(tags.begin(), tags.end());
  EXPECT_EQ(std::adjacent_find(tags.begin(), tags.end()), tags.end());
}

/// n tets around the edge from vertex n (below) to n + 1 (above); the ring is no circle.
LinearMesh ring_mesh(int n, std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  MeshData data;
  data.source = "ring";
  for (int i = 0; i < n; ++i) {
    const double angle = 2.0 * std::numbers::pi * (i + 0.3 * uniform(random)) / n;
    const double radius = 1.0 + 0.2 * uniform(random);
    data.points.emplace_back(radius * std::cos(angle), radius * std::sin(angle),
                             0.2 * uniform(random));
  }
  data.points.emplace_back(0.0, 0.0, -1.0);
  data.points.emplace_back(0.0, 0.0, 1.0);
  ElementBlock tets{Shape::tetrahedron, 1, 1, {}, {}};
  for (Index i = 0; i < n; ++i) {
    tets.nodes.insert(tets.nodes.end(), {i, (i + 1) % n, n, n + 1});
  }
  const std::vector<int>& place = lattice_map(Shape::tetrahedron, 1).corner;
  std::vector<Index> nodes(tets.nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i / 4 * 4 + static_cast<std::size_t>(place[i % 4])] = tets.nodes[i];
  }
  // n is below n + 1, so (i, i + 1, below, above) is positive.
  tets.nodes = nodes;
  data.blocks = {tets};
  return build_linear_mesh(data);
}

double shape_of(const LinearMesh& mesh, const std::array<Index, 4>& tet) {
  std::array<Vec3, 4> x;
  for (std::size_t i = 0; i < 4; ++i) x[i] = mesh.vertices[at(tet[i])];
  const double v = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = 0; j < i; ++j) squares += (x[i] - x[j]).squaredNorm();
  }
  return v > 0.0 ? 12.0 * std::pow(3.0 * v, 2.0 / 3.0) / squares : 0.0;
}

double worst_shape(const LinearMesh& mesh) {
  double worst = 1.0;
  for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
    const std::span<const Index> v = mesh.cell(c);
    worst = std::min(worst, shape_of(mesh, {v[0], v[1], v[2], v[3]}));
  }
  return worst;
}

/// The best worst tet over every triangulation of corners first..last of the ring, tried one by
/// one.
double best_by_trying(const LinearMesh& mesh, Index n, Index first, Index last) {
  if (last < first + 2) return 1.0;
  double best = 0.0;
  for (Index k = first + 1; k < last; ++k) {
    best = std::max(
        best,
        std::min({shape_of(mesh, {first, k, last, n + 1}), shape_of(mesh, {last, k, first, n}),
                  best_by_trying(mesh, n, first, k), best_by_trying(mesh, n, k, last)}));
  }
  return best;
}

TEST(RemoveEdges, FindsTheBestTriangulationOfTheRing) {
  std::mt19937 random(11);
  for (int n = 4; n <= 8; ++n) {
    const LinearMesh mesh = ring_mesh(n, random);
    const Topology topology = build_topology(mesh);
    const std::vector<std::uint8_t> none(mesh.vertices.size(), 0);

    const auto [result, removed] =
        remove_edges(mesh, topology, {topology.find_edge(n, n + 1)}, none);

    ASSERT_EQ(removed, 1u) << n;
    EXPECT_EQ(result.cell_count(), static_cast<std::size_t>(2 * (n - 2)));
    EXPECT_NEAR(volume(result), volume(mesh), 1e-13);
    EXPECT_EQ(boundary_faces(result), boundary_faces(mesh));
    EXPECT_NEAR(worst_shape(result), best_by_trying(mesh, n, 0, n - 1), 1e-12) << n;
    expect_positive(result);
  }
}

TEST(RemoveEdges, PutsAVertexInsideWhereOtherwiseATetWouldHaveOnlyAvoidedCorners) {
  std::mt19937 random(12);
  const LinearMesh mesh = ring_mesh(5, random);
  const Topology topology = build_topology(mesh);
  const std::vector<std::uint8_t> all(mesh.vertices.size(), 1);

  const auto [result, removed] = remove_edges(mesh, topology, {topology.find_edge(5, 6)}, all);

  EXPECT_EQ(removed, 1u);
  EXPECT_EQ(result.cell_count(), 10u);
  EXPECT_EQ(result.vertices.size(), mesh.vertices.size() + 1);
  EXPECT_NEAR(volume(result), volume(mesh), 1e-13);
  EXPECT_EQ(boundary_faces(result), boundary_faces(mesh));
  expect_positive(result);
}

TEST(RemoveEdges, LeavesEdgesOnTheBoundaryAndEdgesOfOtherShapes) {
  for (const Filling filling : {Filling::tets, Filling::hybrid}) {
    const LinearMesh mesh = build_linear_mesh(cube_mesh(filling, 2, 4));
    const Topology topology = build_topology(mesh);
    std::vector<Index> edges;
    for (Index e = 0; at(e) < topology.edge_count(); ++e) {
      bool is_allowed = true;  // inside, all tets: those are not asked for
      for (Index c : topology.cells_of_edge(e)) {
        is_allowed = is_allowed && mesh.cell_shape[at(c)] == Shape::tetrahedron;
      }
      bool is_boundary = false;
      for (Index c : topology.cells_of_edge(e)) {
        for (Index f : topology.faces_of_cell(c)) {
          const auto& sides = topology.face2edge[at(f)];
          is_boundary = is_boundary || (topology.is_boundary(f) &&
                                        std::find(sides.begin(), sides.end(), e) != sides.end());
        }
      }
      if (is_boundary || !is_allowed) edges.push_back(e);
    }
    ASSERT_FALSE(edges.empty());

    const auto [result, removed] =
        remove_edges(mesh, topology, edges, std::vector<std::uint8_t>(mesh.vertices.size(), 0));

    EXPECT_EQ(removed, 0u);
    EXPECT_EQ(result.cell_vertices, mesh.cell_vertices);
  }
}

TEST(RemoveEdges, OfManyEdgesKeepsVolumeAndSurface) {
  std::mt19937 random(13);
  MeshData data = cube_mesh(Filling::tets, 3, 9);
  testing::transform(data, testing::random_affine(random));
  const LinearMesh mesh = build_linear_mesh(data);
  const Topology topology = build_topology(mesh);
  std::vector<Index> edges(topology.edge_count());
  for (std::size_t e = 0; e < edges.size(); ++e) edges[e] = static_cast<Index>(e);

  const auto [result, removed] =
      remove_edges(mesh, topology, edges, std::vector<std::uint8_t>(mesh.vertices.size(), 0));

  EXPECT_GT(removed, 0u);
  EXPECT_NEAR(volume(result), volume(mesh), 1e-12 * volume(mesh));
  EXPECT_EQ(boundary_faces(result), boundary_faces(mesh));
  expect_positive(result);
}

}  // namespace
}  // namespace camber
