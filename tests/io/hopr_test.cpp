// HOPR meshes, read by a second reader that follows that format's own rules (read_hopr.py).
#include <camber/base/error.hpp>
#include <camber/io/hopr/hilbert_order.hpp>
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

TEST(HilbertOrder, VisitsEveryCellOnceInStepsOverFaces) {
  for (const int bits : {1, 2, 3, 4}) {
    const std::uint32_t side = std::uint32_t{1} << bits;
    std::vector<std::array<std::uint32_t, 3>> cell_at(std::size_t{side} * side * side);
    std::vector<bool> is_taken(cell_at.size(), false);
    for (std::uint32_t i = 0; i < side; ++i) {
      for (std::uint32_t j = 0; j < side; ++j) {
        for (std::uint32_t k = 0; k < side; ++k) {
          const std::uint64_t place = hopr::hilbert_place({i, j, k}, bits);
          ASSERT_LT(place, cell_at.size());
          EXPECT_FALSE(is_taken[place]);
          is_taken[place] = true;
          cell_at[place] = {i, j, k};
        }
      }
    }
    for (std::size_t p = 1; p < cell_at.size(); ++p) {
      int steps = 0;
      for (std::size_t d = 0; d < 3; ++d) {
        steps += std::abs(static_cast<int>(cell_at[p][d]) - static_cast<int>(cell_at[p - 1][d]));
      }
      EXPECT_EQ(steps, 1) << "bits " << bits << ", place " << p;
    }
  }
}

TEST(HilbertOrder, KeepsTheOrderOfEqualPoints) {
  EXPECT_THAT(hopr::hilbert_order({{1, 1, 1}, {0, 0, 0}, {0, 0, 0}}),
              testing::ElementsAre(1, 2, 0));
  EXPECT_THAT(hopr::hilbert_order({{2, 2, 2}, {2, 2, 2}}), testing::ElementsAre(0, 1));
}

TEST(HoprArrays, ElementsFollowTheCurve) {
  // A row of tets along x, numbered in leaps of 3.
  constexpr std::size_t k_count = 8;
  MeshData mesh;
  ElementBlock cells;
  cells.shape = Shape::tetrahedron;
  cells.entity = 1;
  for (std::size_t e = 0; e < k_count; ++e) {
    const auto x = static_cast<double>(3 * e % k_count);
    for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(0.5, 0, 0), Vec3(0, 0.5, 0), Vec3(0, 0, 0.5)}) {
      cells.nodes.push_back(static_cast<Index>(mesh.points.size()));
      mesh.points.emplace_back(corner + Vec3(x, 0, 0));
    }
  }
  mesh.blocks = {cells};

  const hopr::Arrays arrays = hopr::make_arrays(by_names(mesh, hopr_name_rules()), "row.h5");

  Points centres;
  for (std::size_t e = 0; e < k_count; ++e) {
    const double* const x = &arrays.barycenters[3 * e];
    centres.emplace_back(x[0], x[1], x[2]);
    // Each element's package is its own: the first node is at the first corner.
    EXPECT_NEAR(arrays.node_coords[3 * 4 * e] + 0.125, x[0], 1e-15);
  }
  EXPECT_THAT(hopr::hilbert_order(centres), testing::ElementsAre(0, 1, 2, 3, 4, 5, 6, 7));
  EXPECT_NE(centres[1].x() - centres[0].x(), 3.0);  // not as numbered
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
