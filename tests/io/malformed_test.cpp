// Damaged and hostile .msh files: each ends in one FileError that says where and what.
#include <camber/base/error.hpp>
#include <camber/io/gmsh/gmsh_reader.hpp>
#include <camber/io/gmsh/gmsh_writer.hpp>
#include <camber/io/mesh_file.hpp>

#include <filesystem>
#include <limits>
#include <random>
#include <sys/stat.h>

#include <gtest/gtest.h>

#include "sample_mesh.hpp"

namespace camber::io {
namespace {

using testing::TestWithParam;

const std::string k_head41 = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string k_head22 = "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n";
const std::string k_nodes41 =
    "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n";
const std::string k_nodes22 = "$Nodes\n4\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n$EndNodes\n";
const std::string k_elements41 = "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";
const std::string k_elements22 = "$Elements\n1\n1 4 2 1 1 1 2 3 4\n$EndElements\n";

std::string elements41(const std::string& content) {
  return k_head41 + k_nodes41 + "$Elements\n" + content + "$EndElements\n";
}
std::string elements22(const std::string& content) {
  return k_head22 + k_nodes22 + "$Elements\n" + content + "$EndElements\n";
}
std::string nodes41(const std::string& content) {
  return k_head41 + "$Nodes\n" + content + "$EndNodes\n" + k_elements41;
}
std::string nodes22(const std::string& content) {
  return k_head22 + "$Nodes\n" + content + "$EndNodes\n" + k_elements22;
}

struct Case {
  const char* name;
  std::string text;
  std::string where;  // end of Error::where
  std::string what;   // part of Error::message
};

std::vector<Case> cases() {
  return {
      {"NotAMesh", "solid cube\n", "line 1", "found 'solid', expected a Gmsh mesh"},
      {"OnlyBlanks", " \n\n", "line 3", "no $MeshFormat"},
      {"Version1", "$NOD\n1\n1 0 0 0\n$ENDNOD\n", "line 1", "$EndNOD"},
      {"Version4", "$MeshFormat\n4 0 8\n$EndMeshFormat\n", "line 2", "version 4, expected"},
      {"Version3", "$MeshFormat\n3.0 0 8\n$EndMeshFormat\n", "line 2", "version 3, expected"},
      {"VersionIsAWord", "$MeshFormat\nfour 0 8\n", "line 2", "'four', expected a version"},
      {"FlagIs2", "$MeshFormat\n4.1 2 8\n", "line 2", "0 (text) or 1 (binary)"},
      {"DataSizeIs4", "$MeshFormat\n4.1 0 4\n", "line 2", "data size of 4, expected 8"},
      {"SaysBinaryIsText", "$MeshFormat\n4.1 1 8\n$EndMeshFormat\n", "byte 20",
       "as the header says the file is binary"},
      {"SaysTextIsBinary", std::string("$MeshFormat\n4.1 0 8\n\1\0\0\0\n$EndMeshFormat\n", 41),
       "line 3", "'\\x01\\x00\\x00\\x00', expected $EndMeshFormat"},
      {"NoFormat", k_nodes41 + k_elements41, "line 1", "$MeshFormat before any other"},
      {"TwoFormats", k_head41 + k_head41, "line 4", "a second $MeshFormat"},
      {"TwoNodes", k_head41 + k_nodes41 + k_nodes41, "line 16", "a second $Nodes"},
      {"NoNodes", k_head41 + k_elements41, "line 4", "$Elements before any $Nodes"},
      {"NoElements", k_head41 + k_nodes41, "line 16", "expected a $Elements section"},
      {"UnknownWithoutEnd", k_head41 + "$Strange\n1 2 3\n", "line 4", "expected $EndStrange"},
      {"NotASection", k_head41 + "Nodes\n", "line 4", "'Nodes', expected the $Name"},
      {"EndWithoutStart", k_head41 + "$EndNodes\n", "line 4", "'$EndNodes', expected the $Name"},
      {"Partitioned", k_head41 + "$PartitionedEntities\n", "line 4", "partitioned mesh"},
      {"EntitiesIn22", k_head22 + "$Entities\n0 0 0 0\n", "line 4",
       "$Entities in a file of version 2"},
      {"ParametricIn41", k_head41 + "$ParametricNodes\n4\n", "line 4",
       "$ParametricNodes in a file"},

      {"NameWithoutQuotes", k_head41 + "$PhysicalNames\n1\n2 1 wall\n$EndPhysicalNames\n", "line 6",
       "'wall', expected the name of a physical group"},
      {"NameWithOneQuote", k_head41 + "$PhysicalNames\n1\n2 1 \"wall\n$EndPhysicalNames\n",
       "line 6", "expected the name of a physical group"},
      {"NameDimension", k_head41 + "$PhysicalNames\n1\n4 1 \"a\"\n$EndPhysicalNames\n", "line 6",
       "found 4, expected a dimension"},
      {"NameTag", k_head41 + "$PhysicalNames\n1\n3 -9223372036854775808 \"a\"\n", "line 6",
       "at most 32 bits"},
      {"NamesNegative", k_head41 + "$PhysicalNames\n-1\n", "line 5", "found -1"},
      {"NamesAbsurd", k_head41 + "$PhysicalNames\n9000000000000000000\n$EndPhysicalNames\n",
       "line 5", "fits into the"},

      {"EntitiesAbsurd", k_head41 + "$Entities\n0 0 4000000000 0\n$EndEntities\n", "line 5",
       "found 4000000000, expected the number of entities"},
      {"EntityGroupsAbsurd", k_head41 + "$Entities\n1 0 0 0\n1 0 0 0 99999999\n$EndEntities\n",
       "line 6", "the number of physical groups"},
      {"EntityBoundsNegative", k_head41 + "$Entities\n0 1 0 0\n1 0 0 0 1 1 1 0 -2\n$EndEntities\n",
       "line 6", "found -2, expected the number of bounding entities"},
      {"EntityBoxNan", k_head41 + "$Entities\n0 1 0 0\n1 0 0 nan 1 1 1 0 0\n", "line 6", "'nan'"},
      {"EntityTagHuge", k_head41 + "$Entities\n1 0 0 0\n99999999999 0 0 0 0\n", "line 6",
       "of at most 32 bits"},

      {"NodesNegative", nodes41("1 -4 1 4\n"), "line 5", "found -4, expected the number of nodes"},
      {"NodesAbsurd", nodes41("1 1000000000000000 1 4\n"), "line 5", "fits into the"},
      {"NodesBeyond64Bits", nodes41("1 99999999999999999999 1 4\n"), "line 5",
       "'99999999999999999999', expected the number of nodes"},
      {"BlocksAbsurd", nodes41("99999999 4 1 4\n"), "line 5", "the number of blocks"},
      {"BlockNodesAbsurd", nodes41("1 1 1 1\n3 1 0 88888888\n"), "line 6", "the number of nodes"},
      {"NodesFewerThanStated", nodes41("1 2 1 4\n3 1 0 1\n1\n0 0 0\n"), "line 5",
       "a total of 2 nodes, expected 1"},
      {"NodesMoreThanStated", nodes41("1 1 1 2\n3 1 0 2\n1\n2\n0 0 0\n1 1 1\n"), "line 5",
       "a total of 1 nodes, expected 2"},
      {"NodeDimension", nodes41("1 1 1 1\n4 1 0 1\n1\n0 0 0\n"), "line 6", "from 0 to 3"},
      {"NodeParametric", nodes41("1 1 1 1\n2 1 2 1\n1\n0 0 0 0 0\n"), "line 6", "0 or 1"},
      {"NodeNan", nodes41("1 1 1 1\n3 1 0 1\n1\n0 nan 0\n"), "line 8",
       "'nan', expected a finite y coordinate"},
      {"NodeInfinite", nodes41("1 1 1 1\n3 1 0 1\n1\n0 0 -inf\n"), "line 8",
       "'-inf', expected a finite z coordinate"},
      {"NodeOverflow", nodes41("1 1 1 1\n3 1 0 1\n1\n1e999 0 0\n"), "line 8",
       "'1e999', expected a finite x coordinate"},
      {"NodeComma", nodes41("1 1 1 1\n3 1 0 1\n1\n0,5 0 0\n"), "line 8", "'0,5'"},
      {"NodeParameterNan", nodes41("1 1 1 1\n2 1 1 1\n1\n0 0 0 0 nan\n"), "line 8",
       "a finite parameter"},
      {"NodeZero", nodes41("1 1 1 1\n3 1 0 1\n0\n0 0 0\n"), "line 7", "a node number of 1 or more"},
      {"NodeTwice", nodes41("1 3 1 2\n3 1 0 3\n1\n2\n1\n0 0 0\n1 1 1\n2 2 2\n"), "line 9",
       "node number 1 again"},
      {"NodeTwiceSparse", nodes41("1 3 1 2\n3 1 0 3\n1\n9999999999\n1\n0 0 0\n1 1 1\n2 2 2\n"),
       "line 9", "node number 1 again"},
      {"NodesEndEarly", nodes41("1 2 1 2\n3 1 0 2\n1\n2\n0 0 0\n"), "line 10",
       "'$EndNodes', expected a finite x coordinate"},
      {"NodesEndLate", nodes41("1 1 1 1\n3 1 0 1\n1\n0 0 0\n7 7 7\n"), "line 9",
       "'7', expected $EndNodes"},

      {"Nodes22Negative", nodes22("-1\n"), "line 5", "found -1, expected the number of nodes"},
      {"Nodes22Absurd", nodes22("2000000000\n1 0 0 0\n"), "line 5", "fits into the"},
      {"Nodes22Nan", nodes22("1\n1 0 0 NaN\n"), "line 6", "'NaN', expected a finite z"},
      {"Nodes22Twice", nodes22("2\n5 0 0 0\n5 1 1 1\n"), "line 7", "node number 5 again"},
      {"Nodes22TwoOnALine", nodes22("1 7\n1 0 0 0\n"), "line 5",
       "'7', expected the end of the line"},

      {"ElementsNegative", elements41("1 -1 1 1\n"), "line 17", "found -1"},
      {"ElementsAbsurd", elements41("1 4611686018427387904 1 1\n"), "line 17", "fits into the"},
      {"BlockElementsAbsurd", elements41("1 1 1 1\n3 1 4 77777777\n1 1 2 3 4\n"), "line 18",
       "the number of elements that fits"},
      {"ElementsFewer", elements41("1 2 1 1\n3 1 4 1\n1 1 2 3 4\n"), "line 17",
       "a total of 2 elements, expected 1"},
      {"ElementDimension", elements41("1 1 1 1\n2 1 4 1\n1 1 2 3 4\n"), "line 18",
       "elements of shape tet on an entity of dimension 2"},
      {"ElementNumberNegative", elements41("1 1 1 1\n3 1 4 1\n-1 1 2 3 4\n"), "line 19",
       "found -1, expected an element number of 1 or more"},
      {"ElementUnknownNode", elements41("1 1 1 1\n3 1 4 1\n1 1 2 3 5\n"), "line 19",
       "unknown node 5, expected a node of $Nodes"},
      {"ElementNegativeNode", elements41("1 1 1 1\n3 1 4 1\n1 1 2 3 -4\n"), "line 19",
       "unknown node -4"},
      {"ElementNodeTwice", elements41("1 1 1 1\n3 1 4 1\n1 1 2 3 2\n"), "line 19",
       "node 2 twice in one element, expected 4 different nodes (tet of order 1)"},
      {"ElementShort", elements41("1 1 1 1\n3 1 4 1\n1 1 2 3\n"), "line 20",
       "'$EndElements', expected a node number of the element"},
      {"ElementSerendipity", elements41("1 1 1 1\n2 1 16 1\n1 1 2 3 4\n"), "line 18",
       "element type 16 (8-node quadrilateral, serendipity)"},
      {"ElementOrder5", elements41("1 1 1 1\n3 1 31 1\n1 1 2 3 4\n"), "line 18",
       "element type 31 (order 5 or higher)"},
      {"ElementPolygon", elements41("1 1 1 1\n2 1 34 1\n1 1 2 3 4\n"), "line 18", "polygon"},
      {"ElementTypeAbsurd", elements41("1 1 1 1\n3 1 -7 1\n1 1 2 3 4\n"), "line 18",
       "element type -7, which is no mesh element"},

      {"Elements22Negative", elements22("-3\n"), "line 12", "found -3"},
      {"Elements22Absurd", elements22("99999999\n"), "line 12", "fits into the"},
      {"Elements22TagsNegative", elements22("1\n1 4 -1 1 2 3 4\n"), "line 13", "found -1"},
      {"Elements22TagsAbsurd", elements22("1\n1 4 123456789 1 2 3 4\n"), "line 13",
       "the number of tags that fits"},
      {"Elements22NumberZero", elements22("1\n0 4 2 1 1 1 2 3 4\n"), "line 13",
       "found 0, expected an element number of 1 or more"},
      {"Elements22UnknownNode", elements22("1\n1 4 2 1 1 1 2 3 9\n"), "line 13", "unknown node 9"},
      {"Elements22Serendipity", elements22("1\n1 17 2 1 1 1 2 3 4\n"), "line 13",
       "20-node hexahedron, serendipity"},
      {"Elements22Long", elements22("1\n1 4 2 1 1 1 2 3 4 5\n"), "line 13",
       "'5', expected $EndElements"},
  };
}

class Malformed : public TestWithParam<Case> {};

TEST_P(Malformed, GivesOneErrorWithPlaceAndReason) {
  const Case& c = GetParam();
  try {
    static_cast<void>(parse_gmsh("bad.msh", c.text));
    FAIL() << "was accepted";
  } catch (const FileError& error) {
    EXPECT_EQ(error.where(), "bad.msh, " + c.where) << error.what();
    EXPECT_NE(error.message().find(c.what), std::string::npos) << error.what();
    EXPECT_FALSE(error.remedy().empty());
  }
}

INSTANTIATE_TEST_SUITE_P(Gmsh, Malformed, testing::ValuesIn(cases()),
                         [](const auto& p) { return p.param.name; });

TEST(MalformedCases, TheirUndamagedRelativesAreAccepted) {
  EXPECT_EQ(parse_gmsh("good.msh", k_head41 + k_nodes41 + k_elements41).element_count(), 1U);
  EXPECT_EQ(parse_gmsh("good.msh", k_head22 + k_nodes22 + k_elements22).element_count(), 1U);
}

struct Flavour {
  const char* name;
  double version;
  bool binary;
};

class Damaged : public TestWithParam<Flavour> {
 protected:
  static std::string bytes(const MeshData& mesh) {
    write_gmsh(mesh, scratch("whole.msh"),
               {.binary = GetParam().binary, .version = GetParam().version}, "whole.msh");
    return slurp(scratch("whole.msh"));
  }
};

TEST_P(Damaged, EveryTruncationIsNamed) {
  const std::string whole = bytes(single(Shape::prism, 2));
  ASSERT_NO_THROW(static_cast<void>(parse_gmsh("whole", whole)));

  // The last byte is the line feed behind the last section, which nobody needs.
  for (std::size_t size = 0; size + 1 < whole.size(); ++size) {
    EXPECT_THROW(static_cast<void>(parse_gmsh("cut", whole.substr(0, size))), FileError) << size;
  }
}

TEST_P(Damaged, ChangedBytesGiveAMeshOrAnError) {
  const std::string whole = bytes(single(Shape::pyramid, 2));
  std::mt19937 random(20220707);  // fixed: the same files every time
  std::uniform_int_distribution<std::size_t> place(0, whole.size() - 1);
  std::uniform_int_distribution<int> byte(0, 255);
  std::uniform_int_distribution<int> times(1, 4);
  int refused = 0;

  for (int i = 0; i < 4000; ++i) {
    std::string changed = whole;
    for (int k = times(random); k > 0; --k)
      changed[place(random)] = static_cast<char>(byte(random));
    try {
      const MeshData mesh = parse_gmsh("changed", changed);
      for (const ElementBlock& b : mesh.blocks) {
        for (const Index n : b.nodes) ASSERT_LT(at(n), mesh.points.size());
      }
    } catch (const FileError& error) {
      ASSERT_FALSE(error.where().empty());
      ++refused;
    }
  }

  EXPECT_GT(refused, 1000);
}

TEST_P(Damaged, RemovedAndRepeatedPiecesGiveAMeshOrAnError) {
  const std::string whole = bytes(single(Shape::triangle, 2));
  std::mt19937 random(4711);
  std::uniform_int_distribution<std::size_t> place(0, whole.size() - 1);
  int refused = 0;

  for (int i = 0; i < 2000; ++i) {
    const std::size_t a = place(random);
    const std::size_t b = place(random);
    const std::string changed = whole.substr(0, a) + whole.substr(b);
    try {
      static_cast<void>(parse_gmsh("changed", changed));
    } catch (const FileError&) {
      ++refused;
    }
  }

  EXPECT_GT(refused, 1900);
}

INSTANTIATE_TEST_SUITE_P(Gmsh, Damaged,
                         testing::Values(Flavour{"v41text", 4.1, false},
                                         Flavour{"v41binary", 4.1, true},
                                         Flavour{"v22text", 2.2, false},
                                         Flavour{"v22binary", 2.2, true}),
                         [](const auto& p) { return p.param.name; });

TEST(DamagedBinary, NotFiniteCoordinatesAreNamed) {
  MeshData mesh = single(Shape::tetrahedron, 1);
  mesh.points[2].y() = 1234.5678;
  const auto bytes_of = [](double value) {
    return std::string(reinterpret_cast<const char*>(&value), sizeof(value));
  };
  for (const double version : {4.1, 2.2}) {
    write_gmsh(mesh, scratch("whole.msh"), {.version = version}, "whole.msh");
    std::string whole = slurp(scratch("whole.msh"));
    // The box of the entity holds the same bits: the coordinate stands later.
    const std::size_t place = whole.find(bytes_of(1234.5678), whole.find("$Nodes"));
    ASSERT_NE(place, std::string::npos);
    whole.replace(place, 8, bytes_of(std::numeric_limits<double>::infinity()));

    try {
      static_cast<void>(parse_gmsh("inf.msh", whole));
      FAIL() << "was accepted";
    } catch (const FileError& error) {
      EXPECT_EQ(error.where(), "inf.msh, byte " + std::to_string(place));
      EXPECT_NE(error.message().find("found inf, expected a finite y"), std::string::npos);
    }
  }
}

std::string error_of_reading(const std::string& path) {
  try {
    static_cast<void>(read_mesh(path));
  } catch (const FileError& error) {
    EXPECT_EQ(error.where(), path);
    return error.message();
  }
  return "no error";
}

TEST(ReadMesh, NamesFilesThatAreNoMesh) {
  const std::string folder = scratch("folder.msh");
  std::filesystem::create_directory(folder);
  spill(scratch("empty.msh"), "");
  ASSERT_EQ(::mkfifo(scratch("pipe.msh").c_str(), 0600), 0);

  EXPECT_NE(error_of_reading(scratch("missing.msh")).find("No such file"), std::string::npos);
  EXPECT_NE(error_of_reading(folder).find("a folder"), std::string::npos);
  EXPECT_NE(error_of_reading(scratch("empty.msh")).find("an empty file"), std::string::npos);
  EXPECT_NE(error_of_reading(scratch("pipe.msh")).find("a device or a pipe"), std::string::npos);
  EXPECT_NE(error_of_reading(scratch("mesh.stl")).find("'.stl'"), std::string::npos);
  EXPECT_NE(error_of_reading(scratch("mesh")).find("no extension"), std::string::npos);
  EXPECT_NE(error_of_reading(scratch("mesh.xml")).find("only be written"), std::string::npos);
}

}  // namespace
}  // namespace camber::io
