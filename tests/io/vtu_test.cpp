#include <camber/base/error.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/io/vtu/vtu_cells.hpp>
#include <camber/io/vtu/vtu_writer.hpp>

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "sample_mesh.hpp"

namespace camber::io {
namespace {

std::vector<std::int64_t> nodes_of(const vtu::Cells& cells, std::size_t c) {
  const std::int64_t begin = c == 0 ? 0 : cells.offsets[c - 1];
  return {cells.connectivity.begin() + begin, cells.connectivity.begin() + cells.offsets[c]};
}

double volume_of(const vtu::Cells& cells, std::size_t c) {
  const std::vector<std::int64_t> nodes = nodes_of(cells, c);
  const auto x = [&](std::size_t i) { return cells.points[static_cast<std::size_t>(nodes[i])]; };
  const auto tet = [](const Vec3& a, const Vec3& b, const Vec3& p, const Vec3& q) {
    return (b - a).dot((p - a).cross(q - a)) / 6.0;
  };
  if (cells.types[c] == 10) return tet(x(0), x(1), x(2), x(3));
  return tet(x(0), x(1), x(2), x(4)) + tet(x(0), x(2), x(3), x(4));  // planar base
}

TEST(VtuCells, UseTheCellTypesOfEachShapeAndOrder) {
  const std::map<Shape, std::pair<int, int>> wanted{
      {Shape::triangle, {5, 69}},     {Shape::quadrilateral, {9, 70}},
      {Shape::tetrahedron, {10, 71}}, {Shape::hexahedron, {12, 72}},
      {Shape::prism, {13, 73}},       {Shape::pyramid, {14, 37}}};
  for (const auto& [shape, types] : wanted) {
    for (int order = 1; order <= k_max_order; ++order) {
      if (shape == Shape::pyramid && order > 2) continue;

      const vtu::Cells cells = vtu::make_cells(single(shape, order));

      ASSERT_EQ(cells.types.size(), 1U);
      EXPECT_EQ(cells.types[0], order == 1 ? types.first : types.second);
      const bool is_extended = shape == Shape::pyramid && order == 2;
      EXPECT_EQ(cells.offsets[0], is_extended ? 19 : node_count(shape, order));
    }
  }
}

TEST(VtuCells, LeaveOutPointsAndLinesButCountThem) {
  const vtu::Cells cells = vtu::make_cells(zoo());

  // One point and four lines come first.
  EXPECT_EQ(cells.cell2element.front(), 5U);
  EXPECT_EQ(cells.cell2element.back(), zoo().element_count() - 1);
}

TEST(VtuCells, QuadraticPyramidsPassThroughTheirAddedNodes) {
  const MeshData mesh = single(Shape::pyramid, 2);

  const vtu::Cells cells = vtu::make_cells(mesh);

  Points nodes;
  for (const Index n : mesh.blocks[0].nodes) nodes.push_back(mesh.points[at(n)]);
  // Centroid of triangle 014: corners (0,0,0), (1,0,0) and the apex (0,0,1) over corner 0.
  const Vec3 on_face = evaluate(Shape::pyramid, 2, nodes, Vec3(1.0 / 3.0, 0.0, 1.0 / 3.0));
  const Vec3 inside = evaluate(Shape::pyramid, 2, nodes, Vec3(0.375, 0.375, 0.25));
  const std::vector<std::int64_t> places = nodes_of(cells, 0);
  EXPECT_LT((cells.points[static_cast<std::size_t>(places[14])] - on_face).norm(), 1e-14);
  EXPECT_LT((cells.points[static_cast<std::size_t>(places[18])] - inside).norm(), 1e-14);
}

TEST(VtuCells, PyramidsOfHighOrderAreCutIntoPositiveCellsThatFillThem) {
  for (int order = 3; order <= k_max_order; ++order) {
    const vtu::Cells cells = vtu::make_cells(single(Shape::pyramid, order, 0.0));

    double sum = 0.0;
    for (std::size_t c = 0; c < cells.types.size(); ++c) {
      EXPECT_GT(volume_of(cells, c), 0.0);
      sum += volume_of(cells, c);
    }
    // Upright pyramids 1+4+..+p^2, hanging 1+..+(p-1)^2... : 14 + 5 + 16 tetrahedra for p = 3.
    EXPECT_EQ(cells.types.size(), order == 3 ? 35U : 84U);
    EXPECT_NEAR(sum, 1.0 / 3.0, 1e-14);
  }
}

TEST(VtuCells, PiecesOfAPyramidMeetFaceToFace) {
  for (int order = 3; order <= k_max_order; ++order) {
    const vtu::Cells cells = vtu::make_cells(single(Shape::pyramid, order, 0.0));
    std::map<std::vector<std::int64_t>, int> uses;
    for (std::size_t c = 0; c < cells.types.size(); ++c) {
      const std::vector<std::int64_t> nodes = nodes_of(cells, c);
      const std::vector<std::vector<std::size_t>> faces =
          cells.types[c] == 10
              ? std::vector<std::vector<std::size_t>>{{0, 1, 2}, {0, 1, 3}, {1, 2, 3}, {0, 2, 3}}
              : std::vector<std::vector<std::size_t>>{
                    {0, 1, 2, 3}, {0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}};
      for (const std::vector<std::size_t>& face : faces) {
        std::vector<std::int64_t> key;
        for (const std::size_t i : face) key.push_back(nodes[i]);
        std::sort(key.begin(), key.end());
        ++uses[key];
      }
    }

    // On the boundary: p^2 squares of the base and p^2 triangles of each side.
    int outer = 0;
    for (const auto& [face, count] : uses) {
      EXPECT_LE(count, 2);
      if (count == 1) ++outer;
    }
    EXPECT_EQ(outer, 5 * order * order);
  }
}

TEST(VtuWriter, SaysTheVersionThatFixesTheOrderOfHexahedra) {
  for (const bool binary : {true, false}) {
    write_mesh(zoo(), scratch("zoo.vtu"), {.binary = binary});

    const std::string bytes = slurp(scratch("zoo.vtu"));

    EXPECT_NE(bytes.find("type=\"UnstructuredGrid\" version=\"2.2\""), std::string::npos);
    EXPECT_EQ(bytes.find("AppendedData") != std::string::npos, binary);
    EXPECT_EQ(bytes.substr(bytes.size() - 11), "</VTKFile>\n");
  }
}

TEST(VtuWriter, WritesTheSameBytesAgain) {
  write_mesh(zoo(), scratch("a.vtu"));
  write_mesh(zoo(), scratch("b.vtu"));

  EXPECT_EQ(slurp(scratch("a.vtu")), slurp(scratch("b.vtu")));
}

TEST(VtuWriter, NoticesAChangeOnTheDisk) {
  const FileSummary summary = write_vtu(zoo(), scratch("zoo.vtu"), {}, "zoo.vtu");
  EXPECT_NO_THROW(check_file(scratch("zoo.vtu"), summary, "zoo.vtu"));

  std::string bytes = slurp(scratch("zoo.vtu"));
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] + 1);
  spill(scratch("zoo.vtu"), bytes);

  EXPECT_THROW(check_file(scratch("zoo.vtu"), summary, "zoo.vtu"), FileError);
}

}  // namespace
}  // namespace camber::io
