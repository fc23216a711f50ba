// MFEM meshes, read by a second reader that follows that format's own rules (read_mfem.py).
#include <camber/base/error.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/io/mfem/mfem_nodes.hpp>
#include <camber/mesh/elevate_data.hpp>

#include <gtest/gtest.h>

#include "hybrid_mesh.hpp"
#include "run_script.hpp"
#include "sample_mesh.hpp"

namespace camber::io {
namespace {

int judge(const MeshData& uniform, int order, const std::string& path) {
  return judged_by("read_mfem.py", uniform, order, path);
}

class MfemOrder : public testing::TestWithParam<int> {};

TEST_P(MfemOrder, EveryCellFaceAndNodeIsWhereItWas) {
  for (const unsigned seed : {1U, 2U}) {
    const MeshData mesh = hybrid(GetParam(), seed);

    write_mesh(mesh, scratch("m.mesh"));

    const int code = judge(mesh, GetParam(), scratch("m.mesh"));
    if (code == k_not_installed) GTEST_SKIP() << "no NumPy";
    EXPECT_EQ(code, 0) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, MfemOrder, testing::Range(1, 5));

TEST(Mfem, MixedOrdersAreRaisedExactlyToTheHighest) {
  const MeshData mesh = hybrid_of_mixed_order(4);
  ASSERT_EQ(raised_order(mesh, "m.mesh"), 4);
  EXPECT_EQ(raised_order(mesh, "m.cgns"), 0);

  write_mesh(mesh, scratch("m.mesh"));

  const int code = judge(at_order(mesh, 4), 4, scratch("m.mesh"));
  if (code == k_not_installed) GTEST_SKIP() << "no NumPy";
  EXPECT_EQ(code, 0);
}

TEST(Mfem, AttributesAreNumbersOfNamesAndCommentsTellThem) {
  write_mesh(hybrid(1, 1), scratch("m.mesh"));
  const std::string text = slurp(scratch("m.mesh"));

  EXPECT_NE(text.find("# attribute 1: left\n"), std::string::npos);
  EXPECT_NE(text.find("# attribute 2: right\n"), std::string::npos);
  EXPECT_NE(text.find("# boundary attribute 1: wall\n"), std::string::npos);
  EXPECT_NE(text.find("# boundary attribute 2: far & <away>\n"), std::string::npos);
}

TEST(Mfem, ALinearTetIsThisText) {
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 2}};
  ElementBlock block;
  block.shape = Shape::tetrahedron;
  block.entity = 1;
  block.nodes = {0, 1, 2, 3};
  mesh.blocks = {block};

  write_mesh(mesh, scratch("tet.mesh"));

  EXPECT_EQ(
      slurp(scratch("tet.mesh")),
      "MFEM mesh v1.0\n\n# attribute 1: volume_1\n\ndimension\n3\n\nelements\n1\n1 4 0 1 2 3\n\n"
      "boundary\n0\n\nvertices\n4\n3\n0 0 0\n1 0 0\n0 1 0\n0 0 2\n");
}

std::string message_of(const MeshData& mesh) {
  try {
    write_mesh(mesh, scratch("bad.mesh"));
  } catch (const FileError& error) {
    return error.message();
  }
  return "no error";
}

TEST(Mfem, AGapBetweenNeighboursIsRefused) {
  MeshData mesh = hybrid(3, 1);
  for (ElementBlock& b : mesh.blocks) {
    if (b.shape != Shape::prism) continue;
    // The prism gets a node of its own inside the square face that it shares with the hex.
    Index& node = b.nodes[static_cast<std::size_t>(lattice_map(b.shape, 3).edge[0][1])];
    mesh.points.push_back(mesh.points[at(node)] + Vec3(1e-4, 0, 0));
    node = static_cast<Index>(mesh.points.size() - 1);
  }

  EXPECT_NE(message_of(mesh).find("neighbours make different shapes of"), std::string::npos);
}

TEST(Mfem, ALooseSurfaceIsRefused) {
  MeshData mesh = hybrid(2, 1);
  MeshData loose = single(Shape::triangle, 2);
  const auto shift = static_cast<Index>(mesh.points.size());
  for (Index& n : loose.blocks[0].nodes) n += shift;
  mesh.points.insert(mesh.points.end(), loose.points.begin(), loose.points.end());
  loose.blocks[0].tags.clear();
  mesh.blocks.push_back(loose.blocks[0]);

  EXPECT_NE(message_of(mesh).find("no face of any cell"), std::string::npos);
}

TEST(Mfem, CannotBeReadAndSaysSo) {
  spill(scratch("m.mesh"), "MFEM mesh v1.0\n");
  try {
    static_cast<void>(read_mesh(scratch("m.mesh")));
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(error.message().find("can only be written"), std::string::npos);
  }
}

TEST(MfemNodes, AreAsManyAsTheSpaceHasDimensions) {
  for (int p = 1; p <= k_max_order; ++p) {
    for (const Shape shape : {Shape::triangle, Shape::quadrilateral, Shape::tetrahedron,
                              Shape::prism, Shape::hexahedron}) {
      EXPECT_EQ(mfem::element_nodes(shape, p).xi.size(),
                static_cast<std::size_t>(node_count(shape, p)));
    }
    EXPECT_EQ(mfem::element_nodes(Shape::pyramid, p).xi.size(),
              static_cast<std::size_t>(p * (p * p + 3) + 1));
  }
}

}  // namespace
}  // namespace camber::io
