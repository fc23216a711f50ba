#include <camber/base/error.hpp>
#include <camber/mesh/linear_mesh.hpp>
#include <camber/mesh/sew.hpp>
#include <camber/mesh/topology.hpp>

#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../support/cube_mesh.hpp"
#include "hybrid_mesh.hpp"

namespace camber {
namespace {

using testing::cube_mesh;
using testing::Filling;
using testing::hybrid_mesh;
using testing::linear_block;

/// What build_linear_mesh says against the mesh.
std::string refusal(const MeshData& data) {
  try {
    static_cast<void>(build_linear_mesh(data));
  } catch (const MeshError& error) {
    return error.what();
  }
  return "";
}

/// Gives the elements of one block own copies of all their points.
void tear_off(MeshData& data, std::size_t b) {
  std::map<Index, Index> copy;
  for (Index& node : data.blocks[b].nodes) {
    const auto [found, is_new] = copy.try_emplace(node, static_cast<Index>(data.points.size()));
    if (is_new) {
      data.points.push_back(Vec3(data.points[at(node)]));
      data.point_tags.push_back(static_cast<GlobalId>(1000 + data.points.size()));
    }
    node = found->second;
  }
}

/// Two unit cubes side by side in x that do not share vertices; with or without surface elements on
/// both sides of the square between them.
MeshData two_cubes(bool with_baffle) {
  MeshData data;
  for (double x : {0.0, 1.0}) {
    for (const Vec3& corner : corners(Shape::hexahedron))
      data.points.emplace_back(corner + Vec3(x, 0, 0));
  }
  data.blocks = {linear_block(Shape::hexahedron, 1, 1, {0, 1, 2, 3, 4, 5, 6, 7}),
                 linear_block(Shape::hexahedron, 1, 2, {8, 9, 10, 11, 12, 13, 14, 15})};
  const std::array<std::array<Index, 4>, 6> sides{
      {{0, 1, 2, 3}, {4, 5, 6, 7}, {0, 1, 5, 4}, {3, 2, 6, 7}, {0, 3, 7, 4}, {1, 2, 6, 5}}};
  for (Index first : {0, 8}) {
    for (std::size_t s = 0; s < sides.size(); ++s) {
      const bool is_between = s == (first == 0 ? 5u : 4u);
      if (is_between && !with_baffle) continue;
      const std::array<Index, 4>& v = sides[s];
      data.blocks.push_back(linear_block(Shape::quadrilateral, is_between ? 9 : 1, 10,
                                         {v[0] + first, v[1] + first, v[2] + first, v[3] + first}));
    }
  }
  return data;
}

TEST(BuildLinearMesh, KeepsCornersNumbersAndEntities) {
  const LinearMesh mesh = build_linear_mesh(hybrid_mesh());

  ASSERT_EQ(mesh.cell_count(), 4u);
  EXPECT_EQ(mesh.cell_shape,
            (std::vector{Shape::hexahedron, Shape::pyramid, Shape::prism, Shape::tetrahedron}));
  EXPECT_EQ(mesh.cell_tags, (std::vector<GlobalId>{106, 107, 108, 109}));
  const std::span<const Index> prism = mesh.cell(2);
  EXPECT_EQ(std::vector<Index>(prism.begin(), prism.end()),
            (std::vector<Index>{1, 5, 9, 2, 6, 10}));
  EXPECT_EQ(mesh.patch_face_entity, (std::vector{1, 1, 2, 2}));
  EXPECT_EQ(mesh.patch_face_vertices[0], (std::array<Index, 4>{8, 4, 7, -1}));
  ASSERT_EQ(mesh.lines.size(), 1u);
  EXPECT_EQ(mesh.lines[0].curve, 3);
  EXPECT_EQ(mesh.box.upper, Vec3(2, 1, 2));
}

TEST(BuildLinearMesh, LeavesVerticesBehindThatNoCellUses) {
  MeshData data = hybrid_mesh();
  data.points.insert(data.points.begin(), Vec3(50, 0, 0));
  data.point_tags.insert(data.point_tags.begin(), 777);
  for (ElementBlock& block : data.blocks) {
    for (Index& node : block.nodes) ++node;
  }
  data.blocks.push_back(linear_block(Shape::triangle, 5, 200, {0, 1, 2}));

  const LinearMesh mesh = build_linear_mesh(data);

  EXPECT_EQ(mesh.vertices.size(), 12u);
  EXPECT_EQ(mesh.vertex_tags[0], 1);
  EXPECT_EQ(mesh.patch_face_shape.size(), 4u);  // the construction triangle is gone
  EXPECT_EQ(mesh.box.upper.x(), 2.0);
}

TEST(BuildLinearMesh, ClassifiesAVertexByItsPointElement) {
  MeshData data = hybrid_mesh();
  data.point_entity.assign(data.points.size(), EntityKey{2, 4});
  data.blocks.push_back({Shape::point, 1, 6, {3}, {300}});

  const LinearMesh mesh = build_linear_mesh(data);

  EXPECT_EQ(mesh.vertex_entity[3], (EntityKey{0, 6}));
  EXPECT_EQ(mesh.vertex_entity[4], (EntityKey{2, 4}));
}

TEST(BuildLinearMesh, ListsInvertedCellsWithNumberShapeAndCentre) {
  MeshData data = hybrid_mesh();
  data.blocks[8] = linear_block(Shape::tetrahedron, 1, 109, {1, 5, 9, 11});

  const std::string message = refusal(data);

  EXPECT_THAT(message, ::testing::HasSubstr("1 of 4 linear cells are inverted or degenerate"));
  // Centre of (1,0,0) (1,0,1) (2,0,.5) (1.4,-1,.5).
  EXPECT_THAT(message, ::testing::HasSubstr("tet 109 at (1.35, -0.25, 0.5)"));
}

TEST(BuildLinearMesh, ListsTenInvertedCellsAtMost) {
  MeshData data = cube_mesh(Filling::tets, 2, 1);
  for (Vec3& x : data.points) x.z() = -x.z();

  const std::string message = refusal(data);

  EXPECT_THAT(message, ::testing::HasSubstr("96 of 96"));
  std::size_t listed = 0;
  for (std::size_t i = message.find("tet "); i != std::string::npos;
       i = message.find("tet ", i + 1))
    ++listed;
  EXPECT_EQ(listed, 10u);
}

TEST(BuildLinearMesh, RefusesCurvedCellsAndMeshesWithoutCells) {
  MeshData curved = hybrid_mesh();
  curved.blocks[8].order = 2;
  curved.blocks[8].nodes.resize(10, 0);
  EXPECT_THAT(refusal(curved), ::testing::HasSubstr("already curved"));

  MeshData surface = hybrid_mesh();
  surface.blocks.resize(5);
  EXPECT_THAT(refusal(surface), ::testing::HasSubstr("no volume cells"));
}

TEST(LinearMesh, NamesEntitiesByTheirPhysicalName) {
  MeshData data = hybrid_mesh();
  data.entities = {{{2, 1}, "wing", {4}, {}}};

  const LinearMesh mesh = build_linear_mesh(data);

  EXPECT_EQ(mesh.entity_name({2, 1}), "wing");
  EXPECT_EQ(mesh.entity_name({2, 2}), "surface 2");
  EXPECT_EQ(mesh.entity_name({3, 1}), "volume 1");
}

TEST(Sew, JoinsPartsThatTouchWithoutSharingVertices) {
  for (unsigned seed = 1; seed <= 5; ++seed) {
    const MeshData whole = cube_mesh(Filling::hybrid, 2, seed);
    MeshData torn = whole;
    std::vector<std::size_t> volume_blocks;
    for (std::size_t b = 0; b < torn.blocks.size(); ++b) {
      if (dimension(torn.blocks[b].shape) == 3) volume_blocks.push_back(b);
    }
    ASSERT_EQ(volume_blocks.size(), 4u);
    // One part keeps the points of the surface elements: else those would have lost their cells.
    for (ElementBlock& block : torn.blocks) {
      if (dimension(block.shape) < 3) block.nodes.clear();
    }
    for (std::size_t i = 1; i < volume_blocks.size(); ++i) tear_off(torn, volume_blocks[i]);

    const LinearMesh reference = build_linear_mesh(whole);
    const LinearMesh mesh = build_linear_mesh(torn);
    const Topology topology = build_topology(mesh);

    EXPECT_GT(mesh.sewn_vertices, 0u);
    EXPECT_EQ(mesh.vertices.size(), reference.vertices.size());
    EXPECT_EQ(topology.face_count(), build_topology(reference).face_count());
    EXPECT_EQ(topology.edge_count(), build_topology(reference).edge_count());
  }
}

TEST(Sew, JoinsTwoCubesAtTheirUnlistedFace) {
  const LinearMesh mesh = build_linear_mesh(two_cubes(false));

  EXPECT_EQ(mesh.sewn_vertices, 4u);
  EXPECT_EQ(mesh.vertices.size(), 12u);
  EXPECT_EQ(build_topology(mesh).face_count(), 11u);
}

TEST(Sew, LeavesABaffleOpenWhoseTwoSidesAreListed) {
  const LinearMesh mesh = build_linear_mesh(two_cubes(true));

  EXPECT_EQ(mesh.sewn_vertices, 0u);
  EXPECT_EQ(mesh.vertices.size(), 16u);
  EXPECT_EQ(build_topology(mesh).face_count(), 12u);
}

TEST(Sew, LeavesVerticesApartThatDifferInTheLastBit) {
  MeshData data = two_cubes(false);
  for (std::size_t i = 8; i < 16; ++i) {
    if (data.points[i].x() == 1.0) data.points[i].x() = std::nextafter(1.0, 2.0);
  }
  EXPECT_EQ(build_linear_mesh(data).sewn_vertices, 0u);
}

TEST(Sew, KeepsTheBetterClassificationOfAJoinedVertex) {
  MeshData data = two_cubes(false);
  data.point_entity.assign(16, EntityKey{3, 1});
  data.point_entity[8] = {1, 5};  // at (1,0,0), as is vertex 1

  const LinearMesh mesh = build_linear_mesh(data);

  EXPECT_EQ(mesh.vertex_entity[1], (EntityKey{1, 5}));
}

TEST(Sew, KeepsTheSurfaceElementsOfBothParts) {
  const LinearMesh mesh = build_linear_mesh(two_cubes(false));
  const Topology topology = build_topology(mesh);

  ASSERT_EQ(mesh.patch_face_shape.size(), 10u);
  std::set<Index> faces(topology.patch_face2face.begin(), topology.patch_face2face.end());
  EXPECT_EQ(faces.size(), 10u);
  for (Index f : faces) EXPECT_TRUE(topology.is_boundary(f));
}

}  // namespace
}  // namespace camber
