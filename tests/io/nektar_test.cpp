// Nektar++ geometries, read by a second reader that follows that format's own rules
// (read_nektar.py).
#include <camber/base/error.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/io/nektar/vertex_order.hpp>
#include <camber/mesh/elevate_data.hpp>

#include <algorithm>

#include <gtest/gtest.h>

#include "hybrid_mesh.hpp"
#include "run_script.hpp"
#include "sample_mesh.hpp"

namespace camber::io {
namespace {

int judge(const MeshData& uniform, int order, const std::string& path) {
  return judged_by("read_nektar.py", uniform, order, path);
}

class NektarOrder : public testing::TestWithParam<int> {};

TEST_P(NektarOrder, EveryCellFaceAndNodeIsWhereItWas) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const MeshData mesh = hybrid(GetParam(), seed);

    write_mesh(mesh, scratch("m.xml"));

    const int code = judge(mesh, GetParam(), scratch("m.xml"));
    if (code == k_not_installed) GTEST_SKIP() << "no NumPy";
    EXPECT_EQ(code, 0) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, NektarOrder, testing::Range(1, 5));

TEST(Nektar, MixedOrdersAreRaisedExactlyToTheHighest) {
  const MeshData mesh = hybrid_of_mixed_order(4);

  write_mesh(mesh, scratch("m.xml"));

  const int code = judge(at_order(mesh, 4), 4, scratch("m.xml"));
  if (code == k_not_installed) GTEST_SKIP() << "no NumPy";
  EXPECT_EQ(code, 0);
}

TEST(Nektar, StraightFacesOfHighOrderGetNoPoints) {
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}};
  ElementBlock block;
  block.shape = Shape::tetrahedron;
  block.entity = 1;
  block.nodes = {0, 1, 2, 3};
  mesh.blocks = {block};

  write_mesh(at_order(mesh, 3), scratch("tet.xml"));

  const std::string text = slurp(scratch("tet.xml"));
  EXPECT_EQ(text.find("EDGEID"), std::string::npos);
  EXPECT_EQ(text.find("FACEID"), std::string::npos);
  EXPECT_NE(text.find("<A ID=\"0\">0 1 2 3</A>"), std::string::npos) << text;
}

/// Appends a straight cell of given points.
void add(MeshData& mesh, Shape shape, std::vector<Index> corners) {
  ElementBlock block;
  block.shape = shape;
  block.entity = 1;
  const std::vector<int>& place = lattice_map(shape, 1).corner;
  block.nodes.resize(corners.size());
  for (std::size_t c = 0; c < corners.size(); ++c) {
    block.nodes[static_cast<std::size_t>(place[c])] = corners[c];
  }
  mesh.blocks.push_back(block);
}

TEST(VertexOrder, PutsApexesAboveBasesAndKeepsColumnsTogether) {
  MeshData mesh;
  mesh.points.resize(11, Vec3::Zero());
  add(mesh, Shape::prism, {8, 1, 2, 0, 5, 6});  // columns {0,8} {1,5} {2,6}
  add(mesh, Shape::pyramid, {1, 2, 6, 5, 0});   // the column of its apex comes last
  const std::vector<Index> number = nektar::number_vertices(mesh, "m.xml");

  const auto n = [&](Index i) { return number[at(i)]; };
  EXPECT_EQ(n(3), k_none);
  EXPECT_EQ(std::max({n(1), n(2), n(5), n(6)}), 3);
  EXPECT_EQ(n(0), 4);
  EXPECT_EQ(n(8), 5);
}

TEST(VertexOrder, RefusesPyramidsThatStandOnEachOthersApexes) {
  MeshData mesh;
  mesh.points.resize(8, Vec3::Zero());
  add(mesh, Shape::pyramid, {0, 1, 2, 3, 4});
  add(mesh, Shape::pyramid, {4, 5, 6, 7, 0});

  EXPECT_THROW(static_cast<void>(nektar::number_vertices(mesh, "m.xml")), FileError);
}

TEST(VertexOrder, RefusesAStackOfPrismsThatMeetsItself) {
  MeshData mesh;
  mesh.points.resize(6, Vec3::Zero());
  // The upper triangle is the lower one, turned: all three columns become one.
  add(mesh, Shape::prism, {0, 1, 2, 3, 4, 5});
  add(mesh, Shape::prism, {3, 4, 5, 1, 2, 0});

  EXPECT_THROW(static_cast<void>(nektar::number_vertices(mesh, "m.xml")), FileError);
}

}  // namespace
}  // namespace camber::io
