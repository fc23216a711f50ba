#include <camber/base/error.hpp>
#include <camber/io/stl/stl_reader.hpp>

#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <unistd.h>

#include <gtest/gtest.h>

namespace camber::io {
namespace {

class Stl : public ::testing::Test {
 protected:
  Stl()
      : path_(std::filesystem::temp_directory_path() /
              ("camber_stl_" + std::to_string(::getpid()) + ".stl")) {}
  ~Stl() override { std::filesystem::remove(path_); }

  MeshData read(const std::string& bytes) {
    std::ofstream(path_, std::ios::binary) << bytes;
    return read_stl(path_.string());
  }

 private:
  std::filesystem::path path_;
};

/// Two triangles of the unit square.
const std::string k_ascii = R"(solid a square
 facet normal 0 0 1
  outer loop
   vertex 0 0 0
   vertex 1 0 0
   vertex 1 1 0
  endloop
 endfacet
 facet normal 0 0 1
  outer loop
   vertex 0 0 0
   vertex 1.0e0 1 0
   vertex 0 1 0.5
  endloop
 endfacet
endsolid a square
)";

std::string binary_square(std::uint32_t count = 2) {
  const float v[2][12] = {{0, 0, 1, 0, 0, 0, 1, 0, 0, 1, 1, 0},
                          {0, 0, 1, 0, 0, 0, 1, 1, 0, 0, 1, 0.5F}};
  std::string bytes = "solid in name only";
  bytes.resize(80, ' ');
  bytes.append(reinterpret_cast<const char*>(&count), 4);
  for (const auto& triangle : v) {
    bytes.append(reinterpret_cast<const char*>(triangle), 48);
    bytes.append(2, '\0');
  }
  return bytes;
}

void expect_square(const MeshData& mesh) {
  ASSERT_EQ(mesh.blocks.size(), 1u);
  EXPECT_EQ(mesh.blocks[0].shape, Shape::triangle);
  EXPECT_EQ(mesh.blocks[0].nodes, (std::vector<Index>{0, 1, 2, 0, 2, 3}));
  ASSERT_EQ(mesh.points.size(), 4u);
  EXPECT_EQ(mesh.points[2], Vec3(1.0, 1.0, 0.0));
  EXPECT_EQ(mesh.points[3], Vec3(0.0, 1.0, 0.5));
}

TEST_F(Stl, JoinsEqualCornersOfBothKindsOfFile) {
  expect_square(read(k_ascii));
  expect_square(read(binary_square()));
}

TEST_F(Stl, IsAMeshOrOneErrorWhereverItIsCut) {
  for (const std::string& whole : {k_ascii, binary_square()}) {
    for (std::size_t n = 1; n < whole.size(); n += 3) {
      try {
        EXPECT_LE(read(whole.substr(0, n)).blocks[0].size(), 2u);
      } catch (const FileError& error) {
        EXPECT_NE(error.where().find(".stl"), std::string::npos);
      }
    }
  }
}

TEST_F(Stl, RefusesWhatIsNoSurface) {
  EXPECT_THROW((void)read("solid empty\nendsolid\n"), FileError);
  EXPECT_THROW((void)read(binary_square(3)), FileError);
  EXPECT_THROW((void)read("v 0 0 0"), FileError);
  std::string quad = k_ascii;
  quad.insert(quad.find("endloop"), "vertex 0 1 0\n");
  EXPECT_THROW((void)read(quad), FileError);
  std::string word = k_ascii;
  word.replace(word.find("1.0e0"), 5, "1.0x0");
  EXPECT_THROW((void)read(word), FileError);
  std::string bytes = binary_square();
  const float nan = std::numeric_limits<float>::quiet_NaN();
  std::memcpy(bytes.data() + 84 + 16, &nan, 4);
  EXPECT_THROW((void)read(bytes), FileError);
}

}  // namespace
}  // namespace camber::io
