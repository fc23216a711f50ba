// HOPR meshes, read by a second reader that follows that format's own rules (read_hopr.py).
#include <camber/base/error.hpp>
#include <camber/io/hopr/hopr_arrays.hpp>
#include <camber/io/hopr/hopr_file.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/mesh/elevate_data.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "hybrid_mesh.hpp"
#include "run_script.hpp"
#include "sample_mesh.hpp"

namespace camber::io {
namespace {

int judge(const MeshData& uniform, int order, const std::string& path) {
  return judged_by("read_hopr.py", uniform, order, path);
}

class HoprOrder : public testing::TestWithParam<int> {};

TEST_P(HoprOrder, EveryCellSideAndNodeIsWhereItWas) {
  for (const unsigned seed : {1U, 2U}) {
    const MeshData mesh = hybrid(GetParam(), seed);

    write_mesh(mesh, scratch("m.h5"));

    const int code = judge(mesh, GetParam(), scratch("m.h5"));
    if (code == k_not_installed) GTEST_SKIP() << "no NumPy or no HDF5 for Python";
    EXPECT_EQ(code, 0) << "seed " << seed;
  }
}

INSTANTIATE_TEST_SUITE_P(Orders, HoprOrder, testing::Range(1, 5));

TEST(Hopr, MixedOrdersAreRaisedExactlyToTheHighest) {
  const MeshData mesh = hybrid_of_mixed_order(4);

  write_mesh(mesh, scratch("m.h5"));

  const int code = judge(at_order(mesh, 4), 4, scratch("m.h5"));
  if (code == k_not_installed) GTEST_SKIP() << "no NumPy or no HDF5 for Python";
  EXPECT_EQ(code, 0);
}

TEST(Hopr, WritesTheSameBytesAgain) {
  write_mesh(hybrid(2, 1), scratch("a.h5"));
  write_mesh(hybrid(2, 1), scratch("b.h5"));

  EXPECT_TRUE(slurp(scratch("a.h5")) == slurp(scratch("b.h5")));
}

/// Two tets on a common face; the first has the corners 0 1 2 3, the second 2 3 1 4.
MeshData two_tets() {
  MeshData mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  ElementBlock cells;
  cells.shape = Shape::tetrahedron;
  cells.entity = 1;
  cells.nodes = {0, 1, 2, 3, 2, 3, 1, 4};
  mesh.blocks = {cells};
  return mesh;
}

TEST(HoprArrays, OfTwoTetsAreThese) {
  const hopr::Arrays arrays = hopr::make_arrays(by_names(two_tets(), hopr_name_rules()), "two.h5");

  EXPECT_THAT(arrays.elem_info, testing::ElementsAre(104, 1, 0, 4, 0, 4, 104, 1, 4, 8, 4, 8));
  // Side 3 of the first tet (corners 1 2 3) is side 1 of the second (corners 2 1 3): the first
  // corner of the one is the second of the other.
  EXPECT_THAT(arrays.side_info, testing::ElementsAre(3, 1, 0, 0, 1,    //
                                                     3, 2, 0, 0, 1,    //
                                                     3, 3, 2, 12, 0,   //
                                                     3, 4, 0, 0, 1,    //
                                                     3, -3, 1, 32, 0,  //
                                                     3, 5, 0, 0, 1,    //
                                                     3, 6, 0, 0, 1,    //
                                                     3, 7, 0, 0, 1));
  EXPECT_THAT(arrays.bc_names, testing::ElementsAre("boundary"));
  EXPECT_THAT(arrays.node_ids, testing::ElementsAre(1, 2, 3, 4, 3, 4, 2, 5));
}

TEST(HoprArrays, APatchInsideOfTheMeshHasConditionsOnBothSides) {
  MeshData mesh = two_tets();
  ElementBlock patch;
  patch.shape = Shape::triangle;
  patch.entity = 9;
  patch.nodes = {1, 2, 3};
  mesh.blocks.push_back(patch);

  const hopr::Arrays arrays = hopr::make_arrays(by_names(mesh, hopr_name_rules()), "two.h5");

  EXPECT_THAT(arrays.bc_names, testing::ElementsAre("surface_9", "boundary"));
  EXPECT_THAT(arrays.bc_types, testing::ElementsAre(100, 0, 0, 0, 0, 0, 0, 0));
  EXPECT_EQ(arrays.side_info[2 * 5 + 4], 1);
  EXPECT_EQ(arrays.side_info[4 * 5 + 4], 1);
  EXPECT_EQ(arrays.side_info[4], 2);
}

TEST(HoprArrays, AFaceOfThreeCellsIsRefused) {
  MeshData mesh = two_tets();
  mesh.points.emplace_back(2, 2, 2);
  mesh.blocks[0].nodes.insert(mesh.blocks[0].nodes.end(), {2, 3, 1, 5});

  EXPECT_THROW(static_cast<void>(hopr::make_arrays(by_names(mesh, hopr_name_rules()), "three.h5")),
               FileError);
}

TEST(Hopr, NoticesAChangeOnTheDisk) {
  hopr::Arrays arrays = hopr::make_arrays(by_names(two_tets(), hopr_name_rules()), "two.h5");
  write_hopr(arrays, scratch("two.h5"), "two.h5");
  EXPECT_NO_THROW(check_hopr(arrays, scratch("two.h5"), "two.h5"));

  arrays.node_coords[3] = 1.0000001;

  EXPECT_THROW(check_hopr(arrays, scratch("two.h5"), "two.h5"), FileError);
}

}  // namespace
}  // namespace camber::io
