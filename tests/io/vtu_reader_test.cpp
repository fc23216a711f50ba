// .vtu in: our own files, those that VTK writes, and damaged ones.
#include <camber/base/error.hpp>
#include <camber/io/base64.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/io/vtu/vtu_reader.hpp>

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "hybrid_mesh.hpp"
#include "run_script.hpp"
#include "sample_mesh.hpp"

namespace camber::io {
namespace {

/// Everything that a .vtu holds as it is: no points and lines, no pyramids above order 2.
MeshData readable_zoo() {
  MeshData mesh = zoo();
  std::erase_if(mesh.blocks, [](const ElementBlock& b) {
    return dimension(b.shape) < 2 || (b.shape == Shape::pyramid && b.order > 2);
  });
  return mesh;
}

/// Same shapes, orders and positions of all nodes, element by element.
void expect_same_elements(const MeshData& a, const MeshData& b) {
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t k = 0; k < a.blocks.size(); ++k) {
    ASSERT_EQ(a.blocks[k].shape, b.blocks[k].shape);
    ASSERT_EQ(a.blocks[k].order, b.blocks[k].order);
    ASSERT_EQ(a.blocks[k].nodes.size(), b.blocks[k].nodes.size());
    for (std::size_t n = 0; n < a.blocks[k].nodes.size(); ++n) {
      EXPECT_EQ(a.points[at(a.blocks[k].nodes[n])], b.points[at(b.blocks[k].nodes[n])])
          << name(a.blocks[k].shape) << " of order " << a.blocks[k].order << ", node " << n;
    }
  }
}

TEST(VtuReader, FindsEveryNodeOfWhatWasWritten) {
  for (const bool binary : {true, false}) {
    write_mesh(readable_zoo(), scratch("zoo.vtu"), {.binary = binary});

    expect_same_elements(readable_zoo(), read_mesh(scratch("zoo.vtu")));
  }
}

class RewrittenByVtk : public testing::TestWithParam<const char*> {};

TEST_P(RewrittenByVtk, IsTheSameMesh) {
  write_mesh(readable_zoo(), scratch("zoo.vtu"));
  const int code = run_script("rewrite_with_vtk.py",
                              scratch("zoo.vtu") + " " + scratch("again.vtu") + " " + GetParam());
  if (code == k_not_installed) GTEST_SKIP() << "VTK for Python is not installed";
  ASSERT_EQ(code, 0);

  const MeshData again = read_mesh(scratch("again.vtu"));

  // Text of VTK has fewer digits than the numbers.
  if (std::string(GetParam()) != "ascii") {
    expect_same_elements(readable_zoo(), again);
    return;
  }
  const std::vector<double> wanted = measures(readable_zoo()), found = measures(again);
  ASSERT_EQ(wanted.size(), found.size());
  for (std::size_t e = 0; e < wanted.size(); ++e) EXPECT_NEAR(found[e], wanted[e], 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Modes, RewrittenByVtk, testing::Values("ascii", "binary", "base64", "raw"),
                         [](const auto& p) { return std::string(p.param); });

TEST(VtuReader, KeepsAHybridMeshOfMixedOrders) {
  const MeshData mesh = hybrid_of_mixed_order(5);
  write_mesh(mesh, scratch("m.vtu"));

  const MeshData read = read_mesh(scratch("m.vtu"));

  // Pyramids of order 2 have five more points in such a file.
  ASSERT_EQ(read.points.size(), mesh.points.size() + 10);
  for (std::size_t i = 0; i < mesh.points.size(); ++i) EXPECT_EQ(read.points[i], mesh.points[i]);
  std::vector<std::string> names;
  for (const EntityRecord& e : read.entities) names.push_back(e.name);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"surface_5", "surface_7", "volume_3", "volume_4"}));
}

std::string error_of(const std::string& bytes) {
  try {
    static_cast<void>(parse_vtu("bad.vtu", bytes));
  } catch (const FileError& error) {
    return error.message();
  }
  return "accepted";
}

/// A grid of text with these points and one cell.
std::string grid(const std::string& points, std::size_t count, int type, const std::string& nodes,
                 const std::string& version = "2.2") {
  std::size_t size = 1;
  for (const char c : nodes) size += c == ' ' ? 1 : 0;
  return "<VTKFile type=\"UnstructuredGrid\" version=\"" + version +
         "\" byte_order=\"LittleEndian\"><UnstructuredGrid><Piece NumberOfPoints=\"" +
         std::to_string(count) +
         "\" NumberOfCells=\"1\"><Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" "
         "format=\"ascii\">" +
         points +
         "</DataArray></Points><Cells><DataArray type=\"Int64\" Name=\"connectivity\" "
         "format=\"ascii\">" +
         nodes + "</DataArray><DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\">" +
         std::to_string(size) +
         "</DataArray><DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\">" +
         std::to_string(type) + "</DataArray></Cells></Piece></UnstructuredGrid></VTKFile>";
}

TEST(VtuReader, TakesLinearWedgesBothWays) {
  const std::string points = "0 0 0  1 0 0  0 1 0  0 0 1  1 0 1  0 1 1";

  for (const char* nodes : {"0 1 2 3 4 5", "0 2 1 3 5 4"}) {
    EXPECT_NEAR(measures(parse_vtu("w.vtu", grid(points, 6, 13, nodes)))[0], 0.5, 1e-14) << nodes;
  }
}

TEST(VtuReader, KnowsTheOldOrderOfHexahedra) {
  // The nodes of a bent hexahedron of order 2 as they stood before version 2.1: the last two of the
  // upright edges changed places.
  const MeshData mesh = single(Shape::hexahedron, 2);
  write_mesh(mesh, scratch("h.vtu"), {.binary = false});
  std::string text = slurp(scratch("h.vtu"));
  const MeshData now = parse_vtu("h.vtu", text);
  const std::string old = "version=\"0.1\"";
  text.replace(text.find("version=\"2.2\""), old.size(), old);
  const MeshData before = parse_vtu("h.vtu", text);

  int moved = 0;
  for (std::size_t n = 0; n < now.blocks[0].nodes.size(); ++n) {
    moved += now.blocks[0].nodes[n] != before.blocks[0].nodes[n] ? 1 : 0;
  }
  EXPECT_EQ(moved, 2);
}

TEST(VtuReader, RefusesWhatItCannotRepresentAndSaysWhy) {
  const std::string tet = "0 0 0 1 0 0 0 1 0 0 0 1";
  EXPECT_EQ(error_of(grid(tet, 4, 10, "0 1 2 3")), "accepted");
  EXPECT_NE(error_of(grid(tet, 4, 42, "0 1 2 3")).find("VTK type 42"), std::string::npos);
  EXPECT_NE(error_of(grid(tet, 4, 10, "0 1 2 4")).find("node 4 of 4"), std::string::npos);
  EXPECT_NE(error_of(grid(tet, 4, 10, "0 1 2 -3")).find("node -3"), std::string::npos);
  EXPECT_NE(error_of(grid(tet, 4, 5, "0 1 2")).find("no cells of a volume"), std::string::npos);
  EXPECT_NE(error_of(grid(tet, 3, 10, "0 1 2 3")).find("12 coordinates"), std::string::npos);
  EXPECT_NE(error_of(grid("0 0 nan 1 0 0 0 1 0 0 0 1", 4, 10, "0 1 2 3")).find("not finite"),
            std::string::npos);
  EXPECT_NE(error_of("hello").find("no VTK file"), std::string::npos);

  write_mesh(single(Shape::pyramid, 3), scratch("cut.vtu"));
  EXPECT_NE(error_of(slurp(scratch("cut.vtu"))).find("cut into pieces"), std::string::npos);
  const int code = run_script("rewrite_with_vtk.py",
                              scratch("cut.vtu") + " " + scratch("zip.vtu") + " compressed");
  if (code != 0) return;
  EXPECT_NE(error_of(slurp(scratch("zip.vtu"))).find("compressed"), std::string::npos);
}

TEST(VtuReader, DamagedFilesAreAMeshOrOneError) {
  std::mt19937 random(11);
  for (const bool binary : {true, false}) {
    write_mesh(readable_zoo(), scratch("zoo.vtu"), {.binary = binary});
    const std::string whole = slurp(scratch("zoo.vtu"));
    int refused = 0;
    for (int k = 0; k < 400; ++k) {
      std::string bytes = whole;
      for (int changes = 0; changes < 3; ++changes) {
        const std::size_t place = random() % (k % 2 == 0 ? bytes.size() : 1500);
        bytes[place] = static_cast<char>(random() % 256);
      }
      if (k % 5 == 0) bytes.resize(random() % bytes.size());
      try {
        static_cast<void>(parse_vtu("zoo.vtu", bytes));
      } catch (const FileError&) {
        ++refused;
      }
    }
    EXPECT_GT(refused, 100);
  }
}

TEST(Base64, DecodesPiecesThatFollowEachOther) {
  EXPECT_EQ(decode_base64_bytes(encode_base64("a") + encode_base64("bcde")), "abcde");
  EXPECT_EQ(decode_base64_bytes("YWJj\nZA=="), "abcd");
  EXPECT_FALSE(decode_base64_bytes("YWJjZ"));
  EXPECT_FALSE(decode_base64_bytes("Y=Jj"));
  EXPECT_FALSE(decode_base64_bytes("Y!Jj"));
}

}  // namespace
}  // namespace camber::io
