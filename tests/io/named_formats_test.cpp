// CGNS, SU2 and UGRID: written, read back, judged.
#include <camber/base/error.hpp>
#include <camber/io/detail/named_mesh.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/io/su2/su2_reader.hpp>
#include <camber/io/ugrid/ugrid_reader.hpp>
#include <camber/mesh/elevate_data.hpp>

#include <cstdlib>
#include <filesystem>
#include <random>

#include <gtest/gtest.h>

#include "sample_mesh.hpp"

namespace camber::io {
namespace {

/// The zoo's surface and volume elements up to an order; what formats with names keep.
MeshData surfaces_and_volumes(int highest_order) {
  MeshData mesh = zoo();
  std::erase_if(mesh.blocks, [&](const ElementBlock& b) {
    return dimension(b.shape) < 2 || b.order > highest_order;
  });
  return mesh;
}

struct NamedFormat {
  const char* name;
  const char* file;
  int highest_order;
};

class NamedRoundTrip : public testing::TestWithParam<NamedFormat> {};

TEST_P(NamedRoundTrip, KeepsEveryBitOfEveryShapeAndOrder) {
  const MeshData mesh = surfaces_and_volumes(GetParam().highest_order);
  const std::string path = scratch(GetParam().file);
  bool was_verified = false;

  write_mesh(mesh, path, {}, [&](const MeshData& read) {
    was_verified = true;
    ASSERT_EQ(read.points.size(), mesh.points.size());
    for (std::size_t i = 0; i < mesh.points.size(); ++i) EXPECT_EQ(read.points[i], mesh.points[i]);
    ASSERT_EQ(read.blocks.size(), mesh.blocks.size());
    for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
      EXPECT_EQ(read.blocks[b].nodes, mesh.blocks[b].nodes);
    }
  });

  EXPECT_TRUE(was_verified);
}

TEST_P(NamedRoundTrip, JoinsEntitiesOfOneNameAndKeepsNames) {
  const MeshData mesh = surfaces_and_volumes(GetParam().highest_order);
  const std::string path = scratch(GetParam().file);

  write_mesh(mesh, path);
  const MeshData read = read_mesh(path);

  EXPECT_EQ(read.element_count(), mesh.element_count());
  std::size_t patches = 0;
  for (const EntityRecord& e : read.entities) {
    if (e.key.dim != 2) continue;
    ++patches;
    EXPECT_TRUE(e.name == "all tris" || e.name == "all quads" || e.name == "all_tris" ||
                e.name == "all_quads")
        << e.name;
  }
  EXPECT_EQ(patches, 2U);
}

TEST_P(NamedRoundTrip, WritesTheSameMeshAgain) {
  write_mesh(surfaces_and_volumes(GetParam().highest_order), scratch("first.msh"));
  const std::string a = scratch("a_" + std::string(GetParam().file)),
                    b = scratch("b_" + std::string(GetParam().file));

  write_mesh(read_mesh(scratch("first.msh")), a);
  write_mesh(read_mesh(a), b);

  const MeshData of_a = read_mesh(a), of_b = read_mesh(b);
  EXPECT_EQ(of_a.points, of_b.points);
  ASSERT_EQ(of_a.blocks.size(), of_b.blocks.size());
  for (std::size_t k = 0; k < of_a.blocks.size(); ++k) {
    EXPECT_EQ(of_a.blocks[k].nodes, of_b.blocks[k].nodes);
  }
}

TEST_P(NamedRoundTrip, ATruncatedFileIsOneError) {
  const std::string path = scratch(GetParam().file);
  write_mesh(surfaces_and_volumes(1), path);
  const std::string whole = slurp(path);
  ASSERT_GT(whole.size(), 200U);

  for (std::size_t k = 1; k < 40; ++k) {
    const std::string part = scratch("cut_" + std::string(GetParam().file));
    spill(part, whole.substr(0, whole.size() * k / 41));
    EXPECT_THROW(static_cast<void>(read_mesh(part)), FileError) << k;
  }
}

INSTANTIATE_TEST_SUITE_P(Formats, NamedRoundTrip,
                         testing::Values(NamedFormat{"Cgns", "m.cgns", 4},
                                         NamedFormat{"Su2", "m.su2", 4},
                                         NamedFormat{"UgridText", "m.ugrid", 1},
                                         NamedFormat{"UgridB8", "m.b8.ugrid", 1},
                                         NamedFormat{"UgridLb8", "m.lb8.ugrid", 1},
                                         NamedFormat{"UgridR8", "m.r8.ugrid", 1},
                                         NamedFormat{"UgridLr8", "m.lr8.ugrid", 1}),
                         [](const auto& p) { return std::string(p.param.name); });

TEST(Cgns, CgnscheckFindsNothingWrong) {
  if (std::system("command -v cgnscheck > /dev/null") != 0) GTEST_SKIP() << "no cgnscheck";
  const std::string path = scratch("judged.cgns"), log = scratch("cgnscheck.log");
  write_mesh(surfaces_and_volumes(4), path, {.geometry = "body.step"});

  const int status = std::system(("cgnscheck -w1 " + path + " > " + log + " 2>&1").c_str());

  const std::string said = slurp(log);
  EXPECT_EQ(status, 0) << said;
  EXPECT_EQ(said.find("ERROR"), std::string::npos) << said;
}

TEST(Su2, PrismsAreTurnedIfMostAreMirroredAndLeftIfFewAre) {
  const std::string points = "NPOIN= 6\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n1 0 1\n0 1 1\n";
  const std::string up = "13 0 1 2 3 4 5\n", down = "13 0 2 1 3 5 4\n";
  const auto volumes = [&](const std::string& cells) {
    return measures(parse_su2("a.su2", "NDIME= 3\nNELEM= 3\n" + cells + points));
  };

  for (const double v : volumes(down + down + down)) EXPECT_NEAR(v, 0.5, 1e-14);
  const std::vector<double> mixed = volumes(up + down + up);
  EXPECT_NEAR(mixed[0], 0.5, 1e-14);
  EXPECT_NEAR(mixed[1], -0.5, 1e-14);
}

TEST(Ugrid, ACurvedMeshIsRefusedWithAdvice) {
  try {
    write_mesh(surfaces_and_volumes(2), scratch("curved.lb8.ugrid"));
    FAIL();
  } catch (const FileError& error) {
    EXPECT_NE(error.remedy().find("--order 1"), std::string::npos);
  }
}

TEST(Ugrid, NamesGoThroughTheSameSafeWriteAsTheMesh) {
  const std::string names = scratch("real.mapbc");
  spill(names, "edited by hand");
  std::filesystem::create_symlink(names, scratch("m.mapbc"));

  EXPECT_THROW(write_mesh(surfaces_and_volumes(2), scratch("m.lb8.ugrid")), FileError);
  EXPECT_EQ(slurp(names), "edited by hand");
  write_mesh(surfaces_and_volumes(1), scratch("m.lb8.ugrid"));

  // Replaced in one step: a link stays a link, and no temporary is left.
  EXPECT_TRUE(std::filesystem::is_symlink(scratch("m.mapbc")));
  EXPECT_EQ(slurp(names), "2\n1 5000 all_tris\n2 5000 all_quads\n");
  const std::filesystem::directory_iterator files(std::filesystem::path(names).parent_path());
  EXPECT_EQ(std::distance(begin(files), end(files)), 3);
}

TEST(Ugrid, ATagForEachFaceIsRefusedBeforeItFillsTheMemory) {
  const std::size_t count = NamedMeshBuilder::k_most_entities + 1;
  std::string text = "4 " + std::to_string(count) + " 0 1 0 0 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n";
  for (std::size_t f = 0; f < count; ++f) text += "1 3 2\n";
  for (std::size_t f = 0; f < count; ++f) text += std::to_string(f + 1) + "\n";
  text += "1 2 3 4\n";

  EXPECT_THROW(static_cast<void>(parse_ugrid("a.ugrid", text, "")), FileError);
}

TEST(Ugrid, ConditionsOfTheUserStayWhereTheNamesAreRight) {
  const std::string edited = "2\n1 4000 all_tris viscous\n2 6662 all_quads\n";
  spill(scratch("m.mapbc"), edited);
  write_mesh(surfaces_and_volumes(1), scratch("m.lb8.ugrid"));
  EXPECT_EQ(slurp(scratch("m.mapbc")), edited);

  spill(scratch("m.mapbc"), "2\n1 4000 all_quads\n2 6662 all_tris\n");  // names of another mesh
  write_mesh(surfaces_and_volumes(1), scratch("m.lb8.ugrid"));
  EXPECT_EQ(slurp(scratch("m.mapbc")), "2\n1 5000 all_tris\n2 5000 all_quads\n");
}

TEST(Ugrid, TheApexOfAPyramidIsItsThirdNode) {
  const std::string text =
      "5 0 1 0 1 0 0\n0 0 0\n1 0 0\n0 0 1\n1 1 0\n0 1 0\n1 2 4 5\n7\n1 5 3 2 4\n";
  // Nodes 1 2 4 5 are the base seen from below the apex 3; the file lists them as u0 u3 u4 u1 u2.
  const MeshData mesh = parse_ugrid("pyramid.ugrid", text, "1\n7 3000 wall\n");

  double volume = 0.0;
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    if (mesh.blocks[b].shape == Shape::pyramid) volume = measures(mesh)[b];
  }
  EXPECT_NEAR(std::abs(volume), 1.0 / 3.0, 1e-12);
}

/// Every change of a few bytes gives a mesh or one FileError; nothing else, never a crash.
class Mutated : public testing::TestWithParam<NamedFormat> {};

TEST_P(Mutated, IsAMeshOrOneError) {
  const std::string path = scratch(GetParam().file);
  write_mesh(surfaces_and_volumes(GetParam().highest_order), path);
  const std::string whole = slurp(path);
  const std::string alphabet = "0123456789-.eE =%\n\t\xff";
  std::mt19937 random(7);
  const auto pick = [&](std::size_t n) {
    return std::uniform_int_distribution<std::size_t>(0, n - 1)(random);
  };
  std::size_t refused = 0;
  for (int k = 0; k < 2000; ++k) {
    std::string bytes = whole;
    for (std::size_t changes = 1 + pick(4); changes > 0; --changes) {
      // Half of the changes hit the first bytes, where the counts are.
      const std::size_t place = pick(2) == 0 ? pick(bytes.size()) : pick(64);
      bytes[place] = pick(2) == 0 ? alphabet[pick(alphabet.size())] : static_cast<char>(pick(256));
      if (pick(8) == 0) bytes.erase(pick(bytes.size()), 1 + pick(16));
    }
    try {
      static_cast<void>(GetParam().highest_order > 1 ? parse_su2(path, bytes)
                                                     : parse_ugrid(path, bytes, ""));
    } catch (const FileError&) {
      ++refused;
    }
  }
  EXPECT_GT(refused, 100U);
}

INSTANTIATE_TEST_SUITE_P(Formats, Mutated,
                         testing::Values(NamedFormat{"Su2", "m.su2", 2},
                                         NamedFormat{"UgridText", "m.ugrid", 1},
                                         NamedFormat{"UgridLb8", "m.lb8.ugrid", 1},
                                         NamedFormat{"UgridR8", "m.r8.ugrid", 1}),
                         [](const auto& p) { return std::string(p.param.name); });

struct Hostile {
  const char* name;
  const char* text;
  const char* what;
};

class HostileSu2 : public testing::TestWithParam<Hostile> {};

TEST_P(HostileSu2, IsOneErrorThatSaysWhat) {
  try {
    static_cast<void>(parse_su2("bad.su2", GetParam().text));
    FAIL() << "accepted";
  } catch (const FileError& error) {
    EXPECT_NE(error.message().find(GetParam().what), std::string::npos) << error.message();
  }
}

INSTANTIATE_TEST_SUITE_P(
    Su2, HostileSu2,
    testing::Values(
        Hostile{"Flat", "NDIME= 2\n", "dimension 3"},
        Hostile{"HugeCount", "NDIME= 3\nNELEM= 999999999999\n10 0 1 2 3\n", "fits into"},
        Hostile{"NegativeCount", "NELEM= -1\n", "found -1"},
        Hostile{"BadType", "NELEM= 1\n11 0 1 2 3\n", "a cell: VTK type"},
        Hostile{"NodeOutOfRange", "NELEM= 1\n10 0 1 2 4\nNPOIN= 4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n",
                "a node below 4"},
        Hostile{"NegativeNode", "NELEM= 1\n10 0 1 2 -3\n", "a node number"},
        Hostile{"Nan", "NPOIN= 1\n0 nan 0\n", "a finite y"},
        Hostile{"NoPoints", "NELEM= 1\n10 0 1 2 3\n", "NPOIN="},
        Hostile{"Words", "hello\n", "a key and '='"},
        Hostile{"Partitioned", "MARKER_TAG= SEND_RECEIVE\nMARKER_ELEMS= 1\nSEND_TO= 1\n",
                "partitioned"}),
    [](const auto& p) { return std::string(p.param.name); });

TEST(Formats, TheDocumentationHoldsTheTableOfTheRegistry) {
  const std::string docs = slurp(std::string(CAMBER_SOURCE_DIR) + "/docs/formats.md");

  EXPECT_NE(docs.find(format_table()), std::string::npos)
      << "docs/formats.md differs from `camber info --formats`";
}

}  // namespace
}  // namespace camber::io
