// MeshLink files: our own miniature, round trips, hostile input and files of other programs.
#include <camber/base/error.hpp>
#include <camber/io/base64.hpp>
#include <camber/io/meshlink/meshlink.hpp>

#include <array>
#include <filesystem>
#include <fstream>
#include <random>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace camber::io {
namespace {

using ::testing::HasSubstr;

constexpr const char* k_miniature = R"(<MeshLink xmlns="https://cadence.com" version="1.0">
  <Attribute attid="1" name="geometry format">STEP</Attribute>
  <Attribute attid="2" name="model size">10</Attribute>
  <AttributeGroup attid="4" name="geom atts">1 2</AttributeGroup>
  <GeometryFile filename="bump.step" aref="4">
    <GeometryReference gid="1" ref="face_1" name="wall_fwd"/>
    <GeometryReference gid="2" ref="face_2"/> <GeometryReference gid="3" ref="edge_5"/>
  </GeometryFile>
  <GeometryGroup gid="10" name="wall">1 2</GeometryGroup>
  <MeshFile filename="bump.cgns"><MeshModelReference ref="/Base/blk-1">
    <MeshSheet name="root/dom-1" gref="10">
      <ParamVertex vref="1" gref="1" dim="2">0.25 0.5</ParamVertex>
      <MeshFace etype="Tri3" count="2"> 1 2 3 <!-- DIR=SAME --> 2 4 3 </MeshFace>
      <MeshFace etype="Quad4" gref="2">3 4 6 5</MeshFace>
      <MeshFace etype="Tri3" format="base64" count="1">BQAAAAYAAAAHAAAA</MeshFace>
    </MeshSheet>
    <MeshString name="root/con-1" gref="3"><MeshEdge etype="Edge2" count="1">1 2</MeshEdge></MeshString>
    <MeshPointReference gref="3" count="1">1</MeshPointReference>
  </MeshModelReference></MeshFile>
  <Transform xid="1" name="shift_y">1 0 0 0  0 1 0 0  0 0 1 0  0 2 0 1</Transform>
  <MeshElementLinkage sourceEntityRef="root/dom-1" targetEntityRef="root/dom-2" xref="1"/>
</MeshLink>
)";

class MeshLinkFile : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ =
        std::filesystem::temp_directory_path() / (std::string("camber_meshlink_") + test->name());
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name = "link.xml") const {
    return (folder_ / name).string();
  }
  [[nodiscard]] MeshLink parse(const std::string& text) const {
    std::ofstream(path()) << text;
    return read_meshlink(path());
  }
  [[nodiscard]] std::string refusal(const std::string& text) const {
    try {
      static_cast<void>(parse(text));
    } catch (const FileError& error) {
      return error.what();
    }
    return "";
  }
  [[nodiscard]] static std::string replaced(std::string what, std::string with) {
    std::string text = k_miniature;
    const std::size_t at = text.find(what);
    EXPECT_NE(at, std::string::npos) << what;
    return text.replace(at, what.size(), with);
  }

 private:
  std::filesystem::path folder_;
};

void expect_answers(const MeshLink::Model& model) {
  const MeshLinkQuery query(model);
  EXPECT_EQ(query.face(std::array<GlobalId, 3>{3, 1, 2}), 10);
  EXPECT_EQ(query.face(std::array<GlobalId, 3>{2, 1, 3}), 10);
  EXPECT_EQ(query.face(std::array<GlobalId, 4>{6, 5, 3, 4}), 2);
  EXPECT_EQ(query.face(std::array<GlobalId, 3>{7, 6, 5}), 10);
  EXPECT_EQ(query.face(std::array<GlobalId, 3>{1, 2, 4}), 0);
  EXPECT_EQ(query.edge(2, 1), 3);   // its string
  EXPECT_EQ(query.edge(2, 3), 10);  // no string: taken from the face
  EXPECT_EQ(query.edge(6, 5), 2);
  EXPECT_EQ(query.edge(1, 4), 0);
  EXPECT_EQ(query.string_edge(2, 3), 0);
  EXPECT_EQ(query.point(1), 3);
  EXPECT_EQ(query.point(5), 2);
  EXPECT_EQ(query.point(99), 0);
}

TEST_F(MeshLinkFile, AnswersByFormingNodesInAnyOrder) {
  const MeshLink link = parse(k_miniature);
  ASSERT_EQ(link.meshes.size(), 1u);
  expect_answers(link.meshes[0].models.at(0));
}

TEST_F(MeshLinkFile, HoldsReferencesGroupsAttributesParametersAndTransforms) {
  const MeshLink link = parse(k_miniature);

  ASSERT_EQ(link.geometry.size(), 1u);
  EXPECT_EQ(link.geometry[0].path, "bump.step");
  EXPECT_EQ(link.geometry[0].attributes, 4);
  ASSERT_EQ(link.geometry[0].references.size(), 3u);
  EXPECT_EQ(link.geometry[0].references[0].name, "wall_fwd");
  EXPECT_EQ(link.geometry[0].references[1].name, "face_2");  // the ref if there is no name
  EXPECT_THAT(link.geometry_groups.at(0).members, ::testing::ElementsAre(1, 2));
  EXPECT_THAT(link.attribute_groups.at(0).members, ::testing::ElementsAre(1, 2));
  EXPECT_EQ(link.attributes.at(1).text, "10");
  const MeshLink::ParamVertex& p = link.meshes[0].models[0].sheets[0].parameters.at(0);
  EXPECT_EQ(p.vertex, 1);
  EXPECT_EQ(p.u, 0.25);
  EXPECT_EQ(p.v, 0.5);
  EXPECT_EQ(link.transforms.at(0).matrix[13], 2.0);
  EXPECT_EQ(link.linkages.at(0).transform, 1);
}

TEST_F(MeshLinkFile, IgnoresNamespaces) {
  expect_answers(
      parse(replaced("https://cadence.com", "https://pointwise.com")).meshes[0].models[0]);
  expect_answers(parse(R"(<m:MeshLink xmlns:m="https://x"><m:GeometryFile filename="a">
        <m:GeometryReference gid="2" ref="a"/><m:GeometryReference gid="3" ref="b"/></m:GeometryFile>
        <m:GeometryGroup gid="10">2 3</m:GeometryGroup><m:MeshFile filename="b">
        <m:MeshModelReference ref="c"><m:MeshSheet gref="10"><m:MeshFace etype="Tri3" count="2">
        1 2 3 2 4 3</m:MeshFace><m:MeshFace etype="Quad4" gref="2">3 4 6 5</m:MeshFace>
        <m:MeshFace etype="Tri3">5 6 7</m:MeshFace>
        </m:MeshSheet><m:MeshString gref="3"><m:MeshEdge etype="Edge2">1 2</m:MeshEdge></m:MeshString>
        </m:MeshModelReference></m:MeshFile></m:MeshLink>)")
                     .meshes[0]
                     .models[0]);
}

TEST_F(MeshLinkFile, ComesBackAsItWasWritten) {
  const MeshLink link = parse(k_miniature);
  write_meshlink(link, path("first.xml"));
  const MeshLink again = read_meshlink(path("first.xml"));
  write_meshlink(again, path("second.xml"));

  expect_answers(again.meshes.at(0).models.at(0));
  const auto bytes = [](const std::string& file) {
    std::ostringstream text;
    text << std::ifstream(file).rdbuf();
    return text.str();
  };
  EXPECT_FALSE(bytes(path("first.xml")).empty());
  EXPECT_EQ(bytes(path("first.xml")), bytes(path("second.xml")));
}

TEST_F(MeshLinkFile, EscapesNames) {
  MeshLink link = parse(k_miniature);
  link.geometry[0].references[0].name = "a<b>&\"c\"";
  write_meshlink(link, path("names.xml"));
  EXPECT_EQ(read_meshlink(path("names.xml")).geometry[0].references[0].name, "a<b>&\"c\"");
}

TEST_F(MeshLinkFile, IsRefusedWithLineAndReasonWhenSomethingIsWrong) {
  const std::pair<std::string, std::string> cases[] = {
      {replaced("</MeshLink>", ""), "no well-formed XML"},
      {"<Other/>", "starts with <Other>"},
      {replaced("attid=\"2\"", "attid=\"1\""), "attid=\"1\" is given twice"},
      {replaced("gref=\"10\"", "gref=\"11\""), "no geometry (gref) with id 11"},
      {replaced("gref=\"10\"", "gref=\"-4\""), "must be 1 or more"},
      {replaced("gref=\"10\"", "gref=\"99999999999\""), "no number that fits"},
      {replaced("count=\"2\"", "count=\"3\""), "3 elements of 3 numbers and holds 6"},
      {replaced("count=\"2\"", "count=\"2000000000\""), "holds 6 numbers"},
      {replaced(" 2 4 3 ", " 2 x 3 "), "'x' in <MeshFace> is no number"},
      {replaced(" 2 4 3 ", " 2 0 3 "), "a number below 1"},
      {replaced("BQAAAAYAAAAHAAAA", "BQAAAAYAAAAHAA*A"), "no base64"},
      {replaced("BQAAAAYAAAAHAAAA", "BQAAAAYAAAA="), "holds 2 numbers"},
      {replaced("Edge2", "Bar2"), "etype=\"Bar2\""},
      {replaced("0 2 0 1<", "0 2 0<"), "16 finite numbers, found 15"},
      {replaced("0 2 0 1<", "0 nan 0 1<"), "16 finite numbers"},
      {replaced("xref=\"1\"", "xref=\"7\""), "no transform (xref) with id 7"},
      {replaced("dim=\"2\"", "dim=\"3\""), "dim=\"1\" or \"2\""},
      {replaced("<GeometryGroup gid=\"10\"", "<GeometryGroup"), "has no gid"},
      {replaced("<MeshSheet", "<Sheet"), "no well-formed XML"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string message = refusal(text);
    EXPECT_THAT(message, HasSubstr(expected));
    EXPECT_THAT(message, HasSubstr("line "));
  }
}

TEST_F(MeshLinkFile, SurvivesAnyTruncation) {
  const std::string text = k_miniature;
  for (std::size_t n = 1; n < text.rfind("</MeshLink>"); n += 7) {
    EXPECT_NE(refusal(text.substr(0, n)), "") << n;
  }
}

TEST_F(MeshLinkFile, SurvivesDeepNesting) {
  std::string text;
  for (int i = 0; i < 100000; ++i) text += "<a>";
  EXPECT_NE(refusal(text), "");
}

/// Little-endian bytes, as MeshLink has them.
std::string bytes_of(const std::vector<std::int32_t>& values) {
  std::string bytes;
  for (const std::int32_t value : values) {
    for (int k = 0; k < 4; ++k) {
      bytes += static_cast<char>((static_cast<std::uint32_t>(value) >> (8 * k)) & 0xffu);
    }
  }
  return bytes;
}

TEST(Base64, ComesBackForAnyNumberOfIntegers) {
  std::mt19937 random(3);
  for (std::size_t n = 0; n < 20; ++n) {
    std::vector<std::int32_t> values(n);
    for (std::int32_t& v : values) v = static_cast<std::int32_t>(random());
    const auto back = decode_base64(encode_base64(bytes_of(values)));
    ASSERT_TRUE(back.has_value());
    EXPECT_EQ(*back, values);
  }
  EXPECT_EQ(encode_base64(bytes_of({5, 6, 7})), "BQAAAAYAAAAHAAAA");
}

TEST(MeshLinkSamples, OfOtherProgramsAreRead) {
  const std::string folder = std::string(CAMBER_SHARED_CASES) + "/foreign/meshlink-samples/";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "no " << folder;
  std::size_t files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    if (entry.path().extension() != ".xml") continue;
    ++files;
    const MeshLink link = read_meshlink(entry.path().string());
    ASSERT_FALSE(link.meshes.empty()) << entry.path();
    std::size_t faces = 0, answered = 0;
    for (const MeshLink::Model& model : link.meshes[0].models) {
      const MeshLinkQuery query(model);
      for (const MeshLink::Part& sheet : model.sheets) {
        for (const MeshLink::Elements& list : sheet.elements) {
          if (list.is_opaque) continue;
          const std::size_t n = static_cast<std::size_t>(list.corners);
          for (std::size_t i = 0; i < list.numbers.size(); i += n, ++faces) {
            answered += query.face(std::span(list.numbers).subspan(i, n)) ==
                        (list.geometry != 0 ? list.geometry : sheet.geometry);
          }
        }
      }
    }
    EXPECT_GT(faces, 0u) << entry.path();
    EXPECT_EQ(answered, faces) << entry.path();
  }
  EXPECT_GT(files, 0u);
}

}  // namespace
}  // namespace camber::io
