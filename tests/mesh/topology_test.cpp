#include <camber/base/error.hpp>
#include <camber/mesh/topology.hpp>

#include <algorithm>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../support/cube_mesh.hpp"

namespace camber {
namespace {

using testing::cube_mesh;
using testing::Filling;
using testing::k_fillings;

struct Counts {
  long vertices, edges, faces, cells;
};

Counts counts(const LinearMesh& mesh, const Topology& topology) {
  return {static_cast<long>(mesh.vertices.size()), static_cast<long>(topology.edge_count()),
          static_cast<long>(topology.face_count()), static_cast<long>(mesh.cell_count())};
}

std::vector<Index> face_corners(const LinearMesh& mesh, Index c, std::size_t local) {
  std::vector<Index> corners;
  for (int i : faces(mesh.cell_shape[at(c)])[local].corners) {
    if (i >= 0) corners.push_back(mesh.cell(c)[static_cast<std::size_t>(i)]);
  }
  return corners;
}

/// Cells made by hand, without the checks of build_linear_mesh.
LinearMesh cells_of(const std::vector<std::pair<Shape, std::vector<Index>>>& cells) {
  LinearMesh mesh;
  mesh.cell_offset.push_back(0);
  for (const auto& [shape, corners] : cells) {
    mesh.cell_shape.push_back(shape);
    mesh.cell_vertices.insert(mesh.cell_vertices.end(), corners.begin(), corners.end());
    mesh.cell_offset.push_back(static_cast<Index>(mesh.cell_vertices.size()));
    mesh.cell_tags.push_back(static_cast<GlobalId>(mesh.cell_shape.size() + 40));
    mesh.cell_region.push_back(1);
  }
  const Index highest = *std::max_element(mesh.cell_vertices.begin(), mesh.cell_vertices.end());
  mesh.vertices.assign(at(highest) + 1, Vec3::Zero());
  return mesh;
}

TEST(Topology, CountsTheCubeOfEightHexes) {
  const LinearMesh mesh = build_linear_mesh(cube_mesh(Filling::hexes, 2, 1));
  const Counts n = counts(mesh, build_topology(mesh));

  // 3^3 vertices; 3 directions x 2 edges x 9 lines; 3 directions x 4 faces x 3 layers.
  EXPECT_EQ(n.vertices, 27);
  EXPECT_EQ(n.edges, 54);
  EXPECT_EQ(n.faces, 36);
  EXPECT_EQ(n.cells, 8);
}

TEST(Topology, CountsOnePyramidByHand) {
  const LinearMesh mesh = cells_of({{Shape::pyramid, {0, 1, 2, 3, 4}}});
  const Counts n = counts(mesh, build_topology(mesh));

  EXPECT_EQ(n.edges, 8);
  EXPECT_EQ(n.faces, 5);
}

TEST(Topology, OfACubeHasTheEulerNumberOfABall) {
  for (Filling filling : k_fillings) {
    for (int size : {2, 3}) {
      const LinearMesh mesh = build_linear_mesh(cube_mesh(filling, size, 2));
      const Topology topology = build_topology(mesh);
      const Counts n = counts(mesh, topology);
      long boundary_faces = 0;
      std::set<Index> edges, vertices;
      for (Index f = 0; at(f) < topology.face_count(); ++f) {
        if (!topology.is_boundary(f)) continue;
        ++boundary_faces;
        for (int i = 0; i < topology.corners_of_face(f); ++i) {
          edges.insert(topology.face2edge[at(f)][static_cast<std::size_t>(i)]);
          vertices.insert(topology.face2vertex[at(f)][static_cast<std::size_t>(i)]);
        }
      }

      EXPECT_EQ(n.vertices - n.edges + n.faces - n.cells, 1);
      EXPECT_EQ(
          static_cast<long>(vertices.size()) - static_cast<long>(edges.size()) + boundary_faces, 2);
    }
  }
}

TEST(Topology, ShowsEveryFaceToBothItsCellsThroughTheirViews) {
  for (Filling filling : k_fillings) {
    const LinearMesh mesh = build_linear_mesh(cube_mesh(filling, 3, 3));
    const Topology topology = build_topology(mesh);
    std::vector<std::vector<bool>> senses(topology.face_count());

    for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
      for (std::size_t i = 0; i < topology.faces_of_cell(c).size(); ++i) {
        const Index f = topology.faces_of_cell(c)[i];
        const int view = topology.cell2face_view[at(topology.cell2face_offset[at(c)]) + i];
        const Shape shape = topology.face_shape[at(f)];
        const std::vector<Index> corners = face_corners(mesh, c, i);
        ASSERT_EQ(corners.size(), at(topology.corners_of_face(f)));
        for (std::size_t k = 0; k < corners.size(); ++k) {
          const int in_frame = face_views(shape)[static_cast<std::size_t>(view)][k];
          EXPECT_EQ(corners[k], topology.face2vertex[at(f)][static_cast<std::size_t>(in_frame)]);
        }
        const std::array<Index, 2>& cells = topology.face2cell[at(f)];
        EXPECT_TRUE(cells[0] == c || cells[1] == c);
        senses[at(f)].push_back(view < topology.corners_of_face(f));
      }
    }

    for (Index f = 0; at(f) < topology.face_count(); ++f) {
      ASSERT_EQ(senses[at(f)].size(), topology.is_boundary(f) ? 1u : 2u);
      // Outward from one cell is inward to the other.
      if (!topology.is_boundary(f)) {
        EXPECT_NE(senses[at(f)][0], senses[at(f)][1]);
      }
    }
  }
}

TEST(Topology, StartsFramesAtTheSmallestVertexTowardsTheSmallerNeighbour) {
  const LinearMesh mesh = build_linear_mesh(cube_mesh(Filling::hybrid, 2, 4));
  const Topology topology = build_topology(mesh);

  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    const std::array<Index, 4>& v = topology.face2vertex[at(f)];
    const std::size_t n = at(topology.corners_of_face(f));
    EXPECT_EQ(v[0], *std::min_element(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(n)));
    EXPECT_LT(v[1], v[n - 1]);
    for (std::size_t i = 0; i < n; ++i) {
      EXPECT_EQ(topology.face2edge[at(f)][i], topology.find_edge(v[i], v[(i + 1) % n]));
    }
  }
}

TEST(Topology, KnowsCellsOfEdgesAndEdgesOfCells) {
  const LinearMesh mesh = build_linear_mesh(cube_mesh(Filling::hybrid, 2, 5));
  const Topology topology = build_topology(mesh);
  std::vector<std::set<Index>> expected(topology.edge_count());

  for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
    const std::span<const std::array<int, 2>> local = edges(mesh.cell_shape[at(c)]);
    ASSERT_EQ(topology.edges_of_cell(c).size(), local.size());
    for (std::size_t i = 0; i < local.size(); ++i) {
      const Index a = mesh.cell(c)[static_cast<std::size_t>(local[i][0])];
      const Index b = mesh.cell(c)[static_cast<std::size_t>(local[i][1])];
      const Index e = topology.edges_of_cell(c)[i];
      EXPECT_EQ(topology.edge2vertex[at(e)], (std::array{std::min(a, b), std::max(a, b)}));
      EXPECT_EQ(topology.cell2edge_reversed[at(topology.cell2edge_offset[at(c)]) + i] != 0, a > b);
      expected[at(e)].insert(c);
    }
  }

  for (Index e = 0; at(e) < topology.edge_count(); ++e) {
    const std::span<const Index> cells = topology.cells_of_edge(e);
    EXPECT_EQ(std::set<Index>(cells.begin(), cells.end()), expected[at(e)]);
    EXPECT_EQ(cells.size(), expected[at(e)].size());
  }
  EXPECT_EQ(topology.find_edge(0, 0), k_none);
}

TEST(Topology, LinksEverySurfaceElementToTheFaceWithItsCorners) {
  const LinearMesh mesh = build_linear_mesh(cube_mesh(Filling::hybrid, 3, 6));
  const Topology topology = build_topology(mesh);
  std::size_t boundary = 0;
  for (Index f = 0; at(f) < topology.face_count(); ++f)
    boundary += topology.is_boundary(f) ? 1u : 0u;

  ASSERT_EQ(mesh.patch_face_shape.size(), boundary);
  for (std::size_t b = 0; b < boundary; ++b) {
    const Index f = topology.patch_face2face[b];
    const std::size_t n = at(topology.corners_of_face(f));
    EXPECT_TRUE(topology.is_boundary(f));
    EXPECT_EQ(topology.face2patch_face[at(f)], static_cast<Index>(b));
    EXPECT_EQ(corner_key(std::span(mesh.patch_face_vertices[b]).first(n)),
              corner_key(std::span(topology.face2vertex[at(f)]).first(n)));
  }
}

TEST(Topology, KeepsTheFirstEntityOfAFaceListedTwice) {
  LinearMesh mesh = cells_of({{Shape::tetrahedron, {0, 1, 2, 3}}});
  mesh.patch_face_shape = {Shape::triangle, Shape::triangle};
  mesh.patch_face_vertices = {{0, 1, 2, -1}, {2, 0, 1, -1}};
  mesh.patch_face_entity = {7, 8};

  const Topology topology = build_topology(mesh);

  EXPECT_EQ(topology.patch_face2face[0], topology.patch_face2face[1]);
  EXPECT_EQ(topology.face2patch_face[at(topology.patch_face2face[0])], 0);
}

TEST(Topology, RefusesThreeCellsOnOneFaceByTheirNumbers) {
  const LinearMesh mesh = cells_of({{Shape::tetrahedron, {0, 1, 2, 3}},
                                    {Shape::tetrahedron, {0, 2, 1, 4}},
                                    {Shape::tetrahedron, {0, 1, 2, 5}}});
  try {
    static_cast<void>(build_topology(mesh));
    FAIL() << "three cells share a face";
  } catch (const MeshError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("cells 41, 42 and 43 share one face"));
  }
}

TEST(Topology, RefusesASurfaceElementOnNoCell) {
  LinearMesh mesh =
      cells_of({{Shape::tetrahedron, {0, 1, 2, 3}}, {Shape::tetrahedron, {1, 2, 3, 4}}});
  mesh.patch_face_shape = {Shape::triangle};
  mesh.patch_face_vertices = {{0, 1, 4, -1}};
  mesh.patch_face_entity = {7};
  try {
    static_cast<void>(build_topology(mesh));
    FAIL() << "no cell has the face 0 1 4";
  } catch (const MeshError& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("surface 7 is not a face of any cell"));
  }
}

TEST(Topology, RefusesCellsThatWalkTheirCommonQuadDifferently) {
  const LinearMesh mesh =
      cells_of({{Shape::pyramid, {0, 1, 2, 3, 4}}, {Shape::pyramid, {0, 2, 1, 3, 5}}});
  EXPECT_THROW(static_cast<void>(build_topology(mesh)), MeshError);
}

TEST(Topology, RefusesASurfaceQuadThatWalksItsCornersDifferentlyFromItsCell) {
  LinearMesh mesh = cells_of({{Shape::pyramid, {0, 1, 2, 3, 4}}});
  mesh.patch_face_shape = {Shape::quadrilateral};
  mesh.patch_face_vertices = {{0, 2, 1, 3}};
  mesh.patch_face_entity = {7};
  EXPECT_THROW(static_cast<void>(build_topology(mesh)), MeshError);
}

TEST(FaceViews, PermuteNodesAsTheyPermuteCorners) {
  for (Shape shape : {Shape::triangle, Shape::quadrilateral}) {
    const std::span<const Vec3> corner = corners(shape);
    ASSERT_EQ(face_views(shape).size(), shape == Shape::triangle ? 6u : 8u);
    for (std::size_t w = 0; w < face_views(shape).size(); ++w) {
      const std::array<int, 4>& view = face_views(shape)[w];
      const Vec3 origin = corner[static_cast<std::size_t>(view[0])];
      const Vec3 along_i = corner[static_cast<std::size_t>(view[1])] - origin;
      const Vec3 along_j = corner[static_cast<std::size_t>(view[corner.size() - 1])] - origin;
      for (int p = 1; p <= k_max_tested_order; ++p) {
        const std::span<const int> nodes = face_view_nodes(shape, static_cast<int>(w), p);
        const std::span<const Vec3> xi = lattice_xi(shape, p);
        for (std::size_t n = 0; n < xi.size(); ++n) {
          const Vec3 seen = origin + xi[n].x() * along_i + xi[n].y() * along_j;
          EXPECT_LT((seen - xi[static_cast<std::size_t>(nodes[n])]).norm(), 1e-14);
        }
      }
    }
  }
}

}  // namespace
}  // namespace camber
