#include <camber/base/error.hpp>
#include <camber/io/gmsh/gmsh_reader.hpp>
#include <camber/io/gmsh/gmsh_writer.hpp>
#include <camber/io/gmsh/node_numbers.hpp>

#include <algorithm>
#include <cmath>
#include <cstring>

#include <gtest/gtest.h>

#include "sample_mesh.hpp"

namespace camber::io {
namespace {

/// A pyramid on surface 7 with its nodes on a vertex, a curve (with t), a surface (with u, v) and
/// in the volume; numbers have gaps.
constexpr const char* k_v41 =
    R"($MeshFormat
4.1 0 8
$EndMeshFormat
$Comments
$Nodes are not here
$EndComments
$PhysicalNames
2
2 3 "wall"
3 4 "fluid air"
$EndPhysicalNames
$Entities
1 1 1 1
5 0 0 0 0
6 0 0 0 1 0 0 0 2 5 -5
7 0 0 0 1 1 0 1 3 1 6
8 0 0 0 1 1 1 2 9 4 1 7
$EndEntities
$Nodes
4 5 10 1000000000000
0 5 0 1
10
0 0 0
1 6 1 1
20
1 0 0 0.25
2 7 1 2
30
40
1 1 0 0.5 0.75
0 1 0 +0.125 1e-1
3 8 0 1
1000000000000
0 0 1
$EndNodes
$Elements
2 2 1 2
2 7 3 1
1 10 20 30 40
3 8 7 1
2 10 20 30 40 1000000000000
$EndElements
$Periodic
0
$EndPeriodic
)";

TEST(GmshReader, ReadsWhatVersion41Says) {
  const MeshData mesh = parse_gmsh("pyramid.msh", k_v41);

  EXPECT_EQ(mesh.source, "pyramid.msh");
  EXPECT_EQ(mesh.point_tags, (std::vector<GlobalId>{10, 20, 30, 40, 1000000000000}));
  EXPECT_EQ(mesh.points[3], Vec3(0, 1, 0));
  EXPECT_EQ(mesh.point_entity[1], (EntityKey{1, 6}));
  EXPECT_EQ(mesh.point_entity[4], (EntityKey{3, 8}));
  EXPECT_TRUE(std::isnan(mesh.point_parameters[0].x()));
  EXPECT_EQ(mesh.point_parameters[1], Vec2(0.25, 0.0));
  EXPECT_EQ(mesh.point_parameters[3], Vec2(0.125, 0.1));
  EXPECT_TRUE(std::isnan(mesh.point_parameters[4].x()));
  ASSERT_EQ(mesh.blocks.size(), 2U);
  EXPECT_EQ(mesh.blocks[0].shape, Shape::quadrilateral);
  EXPECT_EQ(mesh.blocks[0].entity, 7);
  // Canonical order runs row by row: (0,0) (1,0) (0,1) (1,1).
  EXPECT_EQ(mesh.blocks[0].nodes, (std::vector<Index>{0, 1, 3, 2}));
  EXPECT_EQ(mesh.blocks[1].nodes, (std::vector<Index>{0, 1, 3, 2, 4}));
  EXPECT_EQ(mesh.blocks[1].tags, std::vector<GlobalId>{2});
  ASSERT_EQ(mesh.entities.size(), 4U);
  EXPECT_EQ(mesh.entities[2].name, "wall");
  EXPECT_EQ(mesh.entities[3].name, "fluid air");
  EXPECT_EQ(mesh.entities[3].physical_tags, (std::vector<int>{9, 4}));
  EXPECT_EQ(mesh.entities[3].box.upper, Vec3(1, 1, 1));
  EXPECT_EQ(mesh.physical_names.size(), 2U);
}

TEST(GmshReader, TakesWindowsLineEnds) {
  std::string text;
  for (const char c : std::string(k_v41))
    text += c == '\n' ? std::string("\r\n") : std::string(1, c);

  expect_same_mesh(parse_gmsh("a", k_v41), parse_gmsh("b", text), true);
}

/// Two tetrahedra and the face of one; each tetrahedron in its own volume.
std::string v22(const std::string& elements) {
  return "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$PhysicalNames\n2\n2 1 \"wall\"\n3 2 \"air\"\n"
         "$EndPhysicalNames\n$Nodes\n6\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 1 1 1\n6 9 9 9\n"
         "$EndNodes\n$Elements\n" +
         elements + "$EndElements\n";
}

TEST(GmshReader, ClassifiesNodesOfVersion22OnTheLowestEntityOfTheirElements) {
  const MeshData mesh =
      parse_gmsh("two.msh", v22("3\n1 2 2 1 10 1 2 3\n2 4 2 2 20 1 2 3 4\n3 4 2 2 21 2 3 4 5\n"));

  EXPECT_EQ(mesh.point_entity[0], (EntityKey{2, 10}));
  EXPECT_EQ(mesh.point_entity[1], (EntityKey{2, 10}));
  EXPECT_EQ(mesh.point_entity[3], (EntityKey{3, 20}));
  EXPECT_EQ(mesh.point_entity[4], (EntityKey{3, 21}));
  EXPECT_EQ(mesh.point_entity[5].dim, -1) << "no element uses it";
  ASSERT_EQ(mesh.entities.size(), 3U);
  EXPECT_EQ(mesh.entities[0].name, "wall");
  EXPECT_EQ(mesh.entities[2].name, "air");
}

TEST(GmshReader, TakesElementsThatVersion22RepeatsPerGroupOnce) {
  const MeshData mesh = parse_gmsh("twice.msh", v22("4\n1 4 2 2 20 1 2 3 4\n2 4 2 3 20 1 2 3 4\n"
                                                    "3 4 2 2 20 2 3 4 5\n4 4 2 3 20 2 3 4 5\n"));

  ASSERT_EQ(mesh.blocks.size(), 1U);
  EXPECT_EQ(mesh.blocks[0].size(), 2U);
  EXPECT_EQ(mesh.blocks[0].tags, (std::vector<GlobalId>{1, 3}));
  ASSERT_EQ(mesh.entities.size(), 1U);
  EXPECT_EQ(mesh.entities[0].physical_tags, (std::vector<int>{2, 3}));
}

TEST(GmshReader, SplitsAnElementaryTagThatSeveralGroupsShare) {
  // All in "entity 1", but patches 1, 5 and 6 differ; 5 also has a quadrilateral.
  const MeshData mesh =
      parse_gmsh("patches.msh",
                 v22("4\n1 2 2 1 1 1 2 3\n2 2 2 5 1 1 2 4\n3 3 2 5 1 1 2 5 4\n4 2 2 6 1 2 3 4\n"));

  ASSERT_EQ(mesh.blocks.size(), 4U);
  EXPECT_EQ(mesh.blocks[0].entity, 1);
  EXPECT_EQ(mesh.blocks[1].entity, 5);
  EXPECT_EQ(mesh.blocks[2].entity, 5);
  EXPECT_EQ(mesh.blocks[3].entity, 6);
  ASSERT_EQ(mesh.entities.size(), 3U);
  EXPECT_EQ(mesh.entities[1].physical_tags, std::vector<int>{5});
}

TEST(GmshReader, TakesElementsWithoutTagsOrWithPartitions) {
  const MeshData mesh = parse_gmsh("tags.msh", v22("2\n1 4 0 1 2 3 4\n2 4 4 2 20 1 7 2 3 4 5\n"));

  ASSERT_EQ(mesh.blocks.size(), 2U);
  EXPECT_EQ(mesh.blocks[0].entity, 0);
  EXPECT_EQ(mesh.blocks[1].entity, 20);
}

TEST(GmshReader, ReadsParametricNodesOfVersion22) {
  const MeshData mesh = parse_gmsh("parametric.msh",
                                   "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$ParametricNodes\n4\n"
                                   "1 0 0 0 0 11\n2 1 0 0 1 12 0.5\n3 0 1 0 2 13 0.25 0.75\n"
                                   "4 0 0 1 3 14\n$EndParametricNodes\n"
                                   "$Elements\n1\n1 4 2 0 14 1 2 3 4\n$EndElements\n");

  EXPECT_EQ(mesh.point_entity, (std::vector<EntityKey>{{0, 11}, {1, 12}, {2, 13}, {3, 14}}));
  EXPECT_EQ(mesh.point_parameters[1], Vec2(0.5, 0.0));
  EXPECT_EQ(mesh.point_parameters[2], Vec2(0.25, 0.75));
  EXPECT_TRUE(std::isnan(mesh.point_parameters[3].x()));
  EXPECT_EQ(mesh.entities.size(), 4U);
}

/// Swaps the bytes of binary numbers: a file as a machine of the other byte order writes it.
class Swapper {
 public:
  explicit Swapper(std::string bytes) : bytes_(std::move(bytes)) {}
  void go_past(const std::string& mark) { at_ = bytes_.find(mark, at_) + mark.size(); }
  std::int64_t swap_int() { return swap<std::int32_t>(); }
  std::int64_t swap_size() { return swap<std::int64_t>(); }
  void swap_reals(std::int64_t n) {
    for (; n > 0; --n) static_cast<void>(swap<double>());
  }
  [[nodiscard]] const std::string& bytes() const { return bytes_; }

 private:
  template <class T>
  std::int64_t swap() {
    T value;
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    std::reverse(bytes_.begin() + static_cast<std::ptrdiff_t>(at_),
                 bytes_.begin() + static_cast<std::ptrdiff_t>(at_ + sizeof(T)));
    at_ += sizeof(T);
    return static_cast<std::int64_t>(value);
  }
  std::string bytes_;
  std::size_t at_ = 0;
};

TEST(GmshReader, ReadsBinaryFilesOfTheOtherByteOrder) {
  const MeshData mesh = single(Shape::pyramid, 3);
  write_gmsh(mesh, scratch("native.msh"), {}, "native.msh");
  Swapper file(slurp(scratch("native.msh")));

  file.go_past("4.1 1 8\n");
  file.swap_int();
  file.go_past("$Entities\n");
  for (int i = 0; i < 4; ++i) file.swap_size();
  file.swap_int();
  file.swap_reals(6);
  EXPECT_EQ(file.swap_size(), 1);
  file.swap_int();
  file.swap_size();
  file.go_past("$Nodes\n");
  for (int i = 0; i < 4; ++i) file.swap_size();
  for (int i = 0; i < 3; ++i) file.swap_int();
  const std::int64_t nodes = file.swap_size();
  ASSERT_EQ(nodes, 30);
  for (std::int64_t i = 0; i < nodes; ++i) file.swap_size();
  file.swap_reals(3 * nodes);
  file.go_past("$Elements\n");
  for (int i = 0; i < 4; ++i) file.swap_size();
  for (int i = 0; i < 3; ++i) file.swap_int();
  for (int i = 0; i < 1 + 1 + 30; ++i) file.swap_size();

  expect_same_mesh(parse_gmsh("native.msh", slurp(scratch("native.msh"))),
                   parse_gmsh("swapped.msh", file.bytes()), true);
}

TEST(NodeNumbers, FindsDenseAndSparseNumbersAndNothingElse) {
  const std::vector<std::vector<GlobalId>> lists{
      {7, 5, 6, 9}, {1, std::numeric_limits<GlobalId>::max(), 1000000007, 42}, {3}};
  for (const std::vector<GlobalId>& list : lists) {
    const gmsh::NodeNumbers numbers(list);

    for (std::size_t i = 0; i < list.size(); ++i) {
      EXPECT_EQ(numbers.find(list[i]), static_cast<Index>(i));
    }
    for (const GlobalId other : {GlobalId{-4}, GlobalId{0}, GlobalId{8}, GlobalId{1} << 50,
                                 std::numeric_limits<GlobalId>::min()}) {
      EXPECT_EQ(numbers.find(other), k_none);
    }
    EXPECT_FALSE(numbers.duplicate().has_value());
  }
}

TEST(NodeNumbers, NamesTheFirstPlaceWhoseNumberOccurredBefore) {
  EXPECT_EQ(gmsh::NodeNumbers({4, 5, 6, 5, 4}).duplicate(), 3);
  EXPECT_EQ(gmsh::NodeNumbers({4, 5000000, 6, 5000000, 4}).duplicate(), 3);
  EXPECT_EQ(gmsh::NodeNumbers().find(1), k_none);
}

}  // namespace
}  // namespace camber::io
