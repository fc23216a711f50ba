#include <camber/basis/node_order.hpp>

#include <algorithm>
#include <fstream>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>

#include <gtest/gtest.h>

#include "samples.hpp"

namespace camber {
namespace {

constexpr NodeConvention k_conventions[] = {NodeConvention::gmsh, NodeConvention::cgns,
                                            NodeConvention::vtk, NodeConvention::su2};

bool exists(NodeConvention convention, Shape shape, int p) {
  return convention != NodeConvention::vtk || shape != Shape::pyramid || p == 1;
}

TEST(NodeOrder, HoldsEveryLatticePointOnce) {
  for (NodeConvention convention : k_conventions) {
    for (Shape shape : test::k_shapes) {
      for (int p = 1; p <= k_max_tested_order; ++p) {
        if (!exists(convention, shape, p)) continue;
        const auto order = node_order(convention, shape, p);
        const std::set<LatticePoint> once(order.begin(), order.end());
        const auto canonical = lattice(shape, p);
        EXPECT_EQ(order.size(), canonical.size()) << name(shape) << p;
        EXPECT_EQ(once, std::set<LatticePoint>(canonical.begin(), canonical.end()))
            << static_cast<int>(convention) << name(shape) << p;
      }
    }
  }
}

TEST(NodeOrder, NumbersFileNodesByTheirLatticePoints) {
  for (NodeConvention convention : k_conventions) {
    for (Shape shape : test::k_shapes) {
      for (int p = 1; p <= 4; ++p) {
        if (!exists(convention, shape, p)) continue;
        const auto order = node_order(convention, shape, p);
        const auto map = file_to_canonical(convention, shape, p);
        ASSERT_EQ(map.size(), order.size());
        for (std::size_t n = 0; n < map.size(); ++n) {
          EXPECT_EQ(lattice(shape, p)[static_cast<std::size_t>(map[n])], order[n]);
        }
      }
    }
  }
}

TEST(NodeOrder, StartsWithTheCorners) {
  for (NodeConvention convention : k_conventions) {
    for (Shape shape : test::k_shapes) {
      for (int p = 1; p <= 4; ++p) {
        if (!exists(convention, shape, p) || (convention == NodeConvention::su2 && p > 1)) continue;
        const auto map = file_to_canonical(convention, shape, p);
        const std::vector<int>& corner = lattice_map(shape, p).corner;
        EXPECT_TRUE(std::equal(corner.begin(), corner.end(), map.begin())) << name(shape) << p;
      }
    }
  }
}

TEST(NodeOrder, AgreesWithFiguresOfTheCgnsStandard) {
  // 1-based node numbers of the SIDS figures.
  const auto hexahedron = node_order(NodeConvention::cgns, Shape::hexahedron, 4);
  EXPECT_EQ(hexahedron[81 - 1], (LatticePoint{0, 3, 1}));
  EXPECT_EQ(hexahedron[83 - 1], (LatticePoint{0, 1, 1}));
  EXPECT_EQ(hexahedron[117 - 1], (LatticePoint{1, 1, 3}));
  EXPECT_EQ(node_order(NodeConvention::cgns, Shape::prism, 4)[41 - 1], (LatticePoint{3, 0, 3}));
  EXPECT_EQ(node_order(NodeConvention::cgns, Shape::pyramid, 4)[55 - 1], (LatticePoint{1, 1, 2}));
}

TEST(NodeOrder, AgreesWithGmshVtkAndCgnsFilesOfOthers) {
  const std::map<std::string, NodeConvention> convention_of{
      {"gmsh", NodeConvention::gmsh}, {"cgns", NodeConvention::cgns}, {"vtk", NodeConvention::vtk}};
  std::map<std::string, Shape> shape_of;
  for (Shape shape : test::k_shapes) shape_of[std::string(name(shape))] = shape;
  std::ifstream file(CAMBER_SOURCE_DIR "/tests/basis/data/node_order_reference.txt");
  std::string line;
  int compared = 0;

  while (std::getline(file, line)) {
    if (line.starts_with('#')) continue;
    std::istringstream words(line);
    std::string convention, shape, digits;
    int p = 0;
    words >> convention >> shape >> p;
    std::vector<LatticePoint> expected;
    while (words >> digits) expected.push_back({digits[0] - '0', digits[1] - '0', digits[2] - '0'});
    const auto order = node_order(convention_of.at(convention), shape_of.at(shape), p);
    EXPECT_EQ(std::vector<LatticePoint>(order.begin(), order.end()), expected) << line;
    ++compared;
  }

  EXPECT_EQ(compared, 28 + 36 + 17);  // gmsh, vtk, cgns
}

TEST(NodeOrder, OfSu2IsTheLatticeItselfFromTheSecondOrderOn) {
  const auto order = node_order(NodeConvention::su2, Shape::pyramid, 3);
  const auto canonical = lattice(Shape::pyramid, 3);
  EXPECT_TRUE(std::equal(order.begin(), order.end(), canonical.begin(), canonical.end()));
  EXPECT_EQ(node_order(NodeConvention::su2, Shape::quadrilateral, 1)[2], (LatticePoint{1, 1, 0}));
}

TEST(NodeOrder, RefusesWhatTheFormatDoesNotHave) {
  EXPECT_THROW(static_cast<void>(node_order(NodeConvention::vtk, Shape::pyramid, 2)),
               std::invalid_argument);
  EXPECT_THROW(static_cast<void>(node_order(NodeConvention::cgns, Shape::line, 0)),
               std::invalid_argument);
  EXPECT_EQ(node_order(NodeConvention::vtk, Shape::pyramid, 1).size(), 5U);
}

}  // namespace
}  // namespace camber
