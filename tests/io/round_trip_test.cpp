#include <camber/base/error.hpp>
#include <camber/io/gmsh/gmsh_reader.hpp>
#include <camber/io/mesh_file.hpp>

#include <algorithm>
#include <tuple>

#include <gtest/gtest.h>

#include "sample_mesh.hpp"

namespace camber::io {
namespace {

struct Flavour {
  double version;
  bool binary;
};

std::string flavour_name(const testing::TestParamInfo<Flavour>& info) {
  return std::string(info.param.version > 3.0 ? "v41" : "v22") +
         (info.param.binary ? "binary" : "text");
}

class RoundTrip : public testing::TestWithParam<Flavour> {
 protected:
  [[nodiscard]] WriteOptions options() const {
    WriteOptions options;
    options.binary = GetParam().binary;
    options.gmsh_version = GetParam().version;
    return options;
  }
  [[nodiscard]] bool keeps_classification() const { return GetParam().version > 3.0; }
};

TEST_P(RoundTrip, KeepsEveryBitOfEveryShapeAndOrder) {
  const MeshData mesh = zoo();

  write_mesh(mesh, scratch("zoo.msh"), options());
  const MeshData read = read_mesh(scratch("zoo.msh"));

  expect_same_mesh(mesh, read, keeps_classification());
}

TEST_P(RoundTrip, WritesTheSameBytesAgain) {
  write_mesh(zoo(), scratch("first.msh"), options());

  write_mesh(read_mesh(scratch("first.msh")), scratch("second.msh"), options());

  EXPECT_EQ(slurp(scratch("first.msh")), slurp(scratch("second.msh")));
}

TEST_P(RoundTrip, GivesEachElementItsOwnNodesInItsOwnOrder) {
  for (int s = 1; s < k_shape_count; ++s) {
    for (int order = 1; order <= k_max_order; ++order) {
      const MeshData mesh = single(static_cast<Shape>(s), order);

      write_mesh(mesh, scratch("one.msh"), options());
      const MeshData read = read_mesh(scratch("one.msh"));

      ASSERT_EQ(read.blocks.size(), 1U);
      ASSERT_EQ(read.blocks[0].nodes.size(), mesh.blocks[0].nodes.size());
      for (std::size_t n = 0; n < mesh.blocks[0].nodes.size(); ++n) {
        EXPECT_EQ(read.points[at(read.blocks[0].nodes[n])],
                  mesh.points[at(mesh.blocks[0].nodes[n])]);
      }
    }
  }
}

TEST_P(RoundTrip, ExtremeCoordinatesSurvive) {
  MeshData mesh = single(Shape::tetrahedron, 1);
  mesh.points = {{0.0, -0.0, 5e-324},
                 {1.7976931348623157e308, -2.2250738585072014e-308, 0.1},
                 {1.0 / 3.0, -1e-17, 1e22},
                 {123456789.123456789, 0.30000000000000004, -1.0}};

  write_mesh(mesh, scratch("extreme.msh"), options());

  expect_same_mesh(mesh, read_mesh(scratch("extreme.msh")), keeps_classification());
}

TEST_P(RoundTrip, MeshesWithoutNumbersOrClassificationGetThem) {
  MeshData mesh = single(Shape::hexahedron, 2);
  mesh.point_tags.clear();
  mesh.point_entity.clear();
  mesh.point_parameters.clear();
  mesh.entities.clear();
  mesh.physical_names.clear();
  mesh.blocks[0].tags.clear();

  write_mesh(mesh, scratch("bare.msh"), options());
  const MeshData read = read_mesh(scratch("bare.msh"));

  const EntityKey volume{3, mesh.blocks[0].entity};
  ASSERT_EQ(read.point_entity.size(), 27U);
  EXPECT_EQ(std::count(read.point_entity.begin(), read.point_entity.end(), volume), 27);
  EXPECT_EQ(read.point_tags.front(), 1);
  EXPECT_EQ(read.point_tags.back(), 27);
  EXPECT_EQ(read.blocks[0].tags, std::vector<GlobalId>{1});
  ASSERT_EQ(read.entities.size(), 1U);
  EXPECT_EQ(read.entities[0].key, volume);
}

TEST_P(RoundTrip, AnEmptyMeshStaysEmpty) {
  write_mesh(MeshData{}, scratch("empty.msh"), options());

  const MeshData read = read_mesh(scratch("empty.msh"));

  EXPECT_TRUE(read.points.empty());
  EXPECT_EQ(read.element_count(), 0U);
}

INSTANTIATE_TEST_SUITE_P(Gmsh, RoundTrip,
                         testing::Values(Flavour{4.1, false}, Flavour{4.1, true},
                                         Flavour{2.2, false}, Flavour{2.2, true}),
                         flavour_name);

TEST(GmshWriter, KeepsWhatVersion41CanSay) {
  MeshData mesh = single(Shape::triangle, 1);
  mesh.entities[0].physical_tags = {7, -9};
  mesh.physical_names = {{2, 9, "a \"quoted\" name"}, {2, 11, "unused"}};
  mesh.entities[0].name = "a \"quoted\" name";
  mesh.entities.push_back({{0, 4}, "", {}, Box{Vec3(1, 2, 3), Vec3(1, 2, 3)}});

  write_mesh(mesh, scratch("named.msh"), {.binary = false});
  const MeshData read = read_mesh(scratch("named.msh"));

  ASSERT_EQ(read.entities.size(), 2U);
  EXPECT_EQ(read.entities[0].box.lower, Vec3(1, 2, 3));
  EXPECT_EQ(read.entities[1].physical_tags, (std::vector<int>{7, -9}));
  EXPECT_EQ(read.entities[1].name, "a \"quoted\" name");
  EXPECT_EQ(read.entities[1].box.lower, mesh.entities[0].box.lower);
  EXPECT_EQ(read.entities[1].box.upper, mesh.entities[0].box.upper);
  ASSERT_EQ(read.physical_names.size(), 2U);
  EXPECT_EQ(read.physical_names[1].name, "unused");
}

TEST(GmshWriter, RefusesCoordinatesThatAreNotFinite) {
  MeshData mesh = single(Shape::tetrahedron, 1);
  mesh.points[2].y() = std::numeric_limits<double>::quiet_NaN();

  EXPECT_THROW(write_mesh(mesh, scratch("nan.msh")), FileError);
  EXPECT_TRUE(slurp(scratch("nan.msh")).empty());
}

TEST(GmshWriter, RefusesNumbersThatVersion22CannotHold) {
  MeshData mesh = single(Shape::tetrahedron, 1);
  mesh.point_tags[3] = GlobalId{1} << 40;

  EXPECT_THROW(write_mesh(mesh, scratch("large.msh"), {.gmsh_version = 2.2}), FileError);

  write_mesh(mesh, scratch("large.msh"), {.gmsh_version = 4.1});
  expect_same_mesh(mesh, read_mesh(scratch("large.msh")), true);
}

TEST(GmshWriter, RefusesArraysThatContradictEachOther) {
  MeshData mesh = single(Shape::tetrahedron, 1);
  mesh.blocks[0].nodes.pop_back();
  EXPECT_THROW(write_mesh(mesh, scratch("bad.msh")), std::invalid_argument);

  mesh = single(Shape::tetrahedron, 1);
  mesh.blocks[0].nodes[0] = 99;
  EXPECT_THROW(write_mesh(mesh, scratch("bad.msh")), std::invalid_argument);

  mesh = single(Shape::tetrahedron, 1);
  mesh.point_entity.pop_back();
  EXPECT_THROW(write_mesh(mesh, scratch("bad.msh")), std::invalid_argument);
}

}  // namespace
}  // namespace camber::io
