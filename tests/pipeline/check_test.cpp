#include <camber/base/error.hpp>
#include <camber/base/parallel.hpp>
#include <camber/mesh/elevate_data.hpp>
#include <camber/pipeline/check.hpp>
#include <camber/pipeline/text_report.hpp>

#include <algorithm>
#include <utility>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../mesh/hybrid_mesh.hpp"

namespace camber {
namespace {

using testing::bend;
using ::testing::Contains;
using ::testing::HasSubstr;
using testing::hybrid_mesh;
using testing::linear_block;

constexpr std::size_t k_cube = 5, k_pyramid = 6, k_prism = 7;  // blocks of hybrid_mesh

/// The hybrid mesh at one order, or with the cube alone at an order of its own.
MeshData with_cube_at(int order) {
  MeshData data = hybrid_mesh();
  MeshData cube = data;
  cube.blocks = {data.blocks[k_cube]};
  cube = at_order(cube, order);
  const Index shift = static_cast<Index>(data.points.size()) - 8;
  data.points.insert(data.points.end(), cube.points.begin() + 8, cube.points.end());
  data.point_tags.clear();
  data.blocks[k_cube] = cube.blocks[0];
  for (Index& node : data.blocks[k_cube].nodes) {
    if (node >= 8) node += shift;
  }
  return data;
}

/// Node of the cube in the middle of its top, which the pyramid stands on.
Index middle_of_top(const MeshData& data) {
  const ElementBlock& cube = data.blocks[k_cube];
  const int node = lattice_index(Shape::hexahedron, 2, {1, 1, 2});
  return cube.nodes[static_cast<std::size_t>(node)];
}

TEST(Check, CertifiesALinearMeshOfAllShapes) {
  const Report report = check(hybrid_mesh(), nullptr);

  EXPECT_EQ(report.status, "ok");
  EXPECT_EQ(report.exit_code, 0);
  EXPECT_EQ(report.validity.certified, 4u);
  EXPECT_EQ(report.validity.worst.size(), 4u);
  EXPECT_EQ(report.input.nodes, 12u);
  EXPECT_EQ(report.output.cells_by_order.at(1), 4u);
  EXPECT_EQ(report.conformity.max_gap, 0.0);
  EXPECT_EQ(report.quality.minimum, 1.0);
  // 14 boundary faces, 4 of them with a surface element.
  EXPECT_THAT(report.warnings,
              Contains(HasSubstr("10 of 14 boundary faces have no surface element")));
  // Box 2 x 2 x 2: x from 0 to 2, y from -1 to 1, z from 0 to 2.
  EXPECT_NEAR(report.conformity.model_size, std::sqrt(12.0), 1e-15);
}

TEST(Check, FindsNoGapInAConformingCurvedMesh) {
  for (int p = 2; p <= k_max_order; ++p) {
    MeshData data = at_order(hybrid_mesh(), p);
    bend(data);

    const Report report = check(data, nullptr);

    EXPECT_EQ(report.status, "ok") << p;
    EXPECT_EQ(report.conformity.max_gap, 0.0) << p;
    EXPECT_EQ(report.conformity.max_order_jump, 0) << p;
    EXPECT_LT(report.quality.minimum, 1.0) << p;
    EXPECT_GT(report.quality.minimum, 0.5) << p;
  }
}

TEST(Check, SeesOnePolynomialThroughDifferentOrders) {
  for (int p = 2; p <= k_max_order; ++p) {
    const Report report = check(with_cube_at(p), nullptr);

    EXPECT_EQ(report.status, "ok") << p;
    EXPECT_LT(report.conformity.max_gap, 1e-15) << p;
    EXPECT_EQ(report.conformity.max_order_jump, p - 1) << p;
  }
}

TEST(Check, MeasuresAPlantedGapAtTheLatticeOfTheHigherOrder) {
  MeshData data = with_cube_at(2);
  data.points[at(middle_of_top(data))].z() += 0.01;

  const Report report = check(data, nullptr);

  // The bubble 16 x (1-x) y (1-y) is 1 in the middle of the face.
  EXPECT_NEAR(report.conformity.max_gap, 0.01, 1e-15);
  EXPECT_EQ(report.status, "not_watertight");
  EXPECT_EQ(report.exit_code, 3);
  EXPECT_THAT(report.warnings, Contains(HasSubstr("near (0.5, 0.5, 1) are 0.01 apart")));
}

TEST(Check, FindsAGapBetweenACellAndItsSurfaceElement) {
  MeshData data = at_order(hybrid_mesh(), 2);
  ElementBlock& quad = data.blocks[3];
  const int middle = lattice_map(Shape::quadrilateral, 2).interior[0];
  const Index own = static_cast<Index>(data.points.size());
  data.points.push_back(data.points[at(quad.nodes[static_cast<std::size_t>(middle)])] +
                        Vec3(0, 0, 0.02));
  data.point_tags.push_back(99999);
  quad.nodes[static_cast<std::size_t>(middle)] = own;

  EXPECT_NEAR(check(data, nullptr).conformity.max_gap, 0.02, 1e-15);
}

TEST(Check, NamesAnInvertedElementAsTheWorst) {
  MeshData data = at_order(hybrid_mesh(), 2);
  // The node inside the cube is pushed out through its top.
  const int inner = lattice_map(Shape::hexahedron, 2).interior[0];
  data.points[at(data.blocks[k_cube].nodes[static_cast<std::size_t>(inner)])].z() += 1.0;

  const Report report = check(data, nullptr);

  EXPECT_EQ(report.status, "not_certified");
  EXPECT_EQ(report.exit_code, 3);
  EXPECT_EQ(report.validity.invalid, 1u);
  EXPECT_EQ(report.validity.certified, 3u);
  ASSERT_FALSE(report.validity.worst.empty());
  EXPECT_EQ(report.validity.worst[0].shape, Shape::hexahedron);
  EXPECT_EQ(report.validity.worst[0].cell, 106);
  EXPECT_LT(report.validity.worst[0].lower_bound, 0.0);
  EXPECT_LT(report.validity.min_jacobian_ratio, 0.0);
  EXPECT_LE(report.quality.minimum, 0.0);
}

TEST(Check, CountsFacesOfMoreThanTwoCells) {
  MeshData data = hybrid_mesh();
  data.points.emplace_back(0.5, 0.5, 3.0);
  data.point_tags.push_back(5000);
  data.blocks.push_back(linear_block(Shape::pyramid, 5, 200, {4, 5, 6, 7, 12}));

  const Report report = check(data, nullptr);

  EXPECT_EQ(report.status, "not_watertight");
  EXPECT_THAT(report.warnings, Contains(HasSubstr("1 faces have more than two cells")));
}

TEST(Check, CountsQuadrilateralsWhoseSidesWalkTheirCornersDifferently) {
  MeshData data = hybrid_mesh();
  // Crosses the surface element on the cube's bottom.
  std::swap(data.blocks[3].nodes[0], data.blocks[3].nodes[1]);

  const Report report = check(data, nullptr);

  EXPECT_EQ(report.status, "not_watertight");
  EXPECT_THAT(report.warnings, Contains(HasSubstr("walk in different orders")));
}

TEST(Check, CountsSurfaceElementsThatAreNoFace) {
  MeshData data = hybrid_mesh();
  data.blocks.push_back(linear_block(Shape::triangle, 7, 300, {0, 6, 8}));

  const Report report = check(data, nullptr);

  EXPECT_EQ(report.status, "ok");
  EXPECT_THAT(report.warnings, Contains("1 surface elements are no face of any cell"));
}

TEST(Check, RefusesAMeshWithoutCells) {
  MeshData data = hybrid_mesh();
  data.blocks.resize(k_cube);
  EXPECT_THROW(static_cast<void>(check(data, nullptr)), MeshError);
}

TEST(Check, GivesTheSameBitsForAnyNumberOfThreads) {
  MeshData data = at_order(hybrid_mesh(), 3);
  bend(data);
  const auto text = [&](int threads) {
    const ThreadLimit limit(threads);
    Report report = check(data, nullptr);
    report.stages_s.clear();
    report.total_s = 0.0;
    report.threads = 0;
    return json_report(report);
  };

  EXPECT_EQ(text(1), text(4));
}

TEST(VerifyWritten, AcceptsOtherOrdersOfNodesAndBlocks) {
  MeshData data = at_order(hybrid_mesh(), 2);
  bend(data);
  MeshData other = data;
  std::reverse(other.points.begin(), other.points.end());
  const Index last = static_cast<Index>(data.points.size()) - 1;
  for (ElementBlock& block : other.blocks) {
    for (Index& node : block.nodes) node = last - node;
  }
  std::swap(other.blocks[k_cube], other.blocks[k_prism]);

  EXPECT_NO_THROW(verify_written(data, other, true));
}

TEST(VerifyWritten, FindsEveryKindOfChange) {
  const MeshData data = at_order(hybrid_mesh(), 2);
  const auto refuses = [&](const auto& change) {
    MeshData other = data;
    change(other);
    EXPECT_THROW(verify_written(data, other, false), FileError);
  };
  refuses([](MeshData& m) { m.points[3].x() = std::nextafter(m.points[3].x(), 2.0); });
  refuses([](MeshData& m) { m.points.push_back(m.points[0]); });
  refuses([](MeshData& m) { m.blocks.pop_back(); });
  refuses([](MeshData& m) { m.blocks[k_pyramid].entity = 9; });
  refuses([](MeshData& m) { m.blocks[k_pyramid].tags[0] = 9; });
  refuses([](MeshData& m) { std::swap(m.blocks[k_cube].nodes[0], m.blocks[k_cube].nodes[2]); });
}

TEST(VerifyWritten, WantsCertifiedElementsOnlyIfTold) {
  MeshData data = at_order(hybrid_mesh(), 2);
  const int inner = lattice_map(Shape::hexahedron, 2).interior[0];
  data.points[at(data.blocks[k_cube].nodes[static_cast<std::size_t>(inner)])].z() += 1.0;

  EXPECT_NO_THROW(verify_written(data, data, false));
  EXPECT_THROW(verify_written(data, data, true), FileError);
}

}  // namespace
}  // namespace camber
