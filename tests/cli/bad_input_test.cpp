// Input that cannot be used: exit code 2, one line, and the old output as it was.
#include <camber/io/mesh_file.hpp>

#include <limits>
#include <sys/mount.h>
#include <unistd.h>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "run_camber.hpp"

namespace camber::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::string k_mesh = bundled("ball/linear.msh"), k_cad = bundled("ball/body.step");
const std::string k_old = "what was there before";

const std::string k_head = "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n";
const std::string k_nodes =
    "$Nodes\n1 4 1 4\n3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n";
const std::string k_elements = "$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 4\n$EndElements\n";

class BadInput : public CliTest {
 protected:
  BadInput() { write_text(file("out.msh"), k_old); }

  /// Expects that curving ends with code 2 and one line, and leaves the folder as it was.
  void expect_refused(const std::string& mesh, const std::string& cad, const std::string& message) {
    const std::vector<std::string> before = files();
    expect_error(camber({"curve", mesh, "-g", cad, "-o", file("out.msh")}), 2, message);
    EXPECT_EQ(files(), before);
    EXPECT_EQ(read_text(file("out.msh")), k_old);
  }
  /// The same for the text of a mesh.
  void expect_refused_text(const std::string& text, const std::string& message) {
    write_text(file("in.msh"), text);
    expect_refused(file("in.msh"), k_cad, message);
  }
  /// The same for the bundled ball after a change.
  void expect_refused_mesh(const MeshData& mesh, const std::string& message) {
    io::write_mesh(mesh, file("in.msh"));
    expect_refused(file("in.msh"), k_cad, message);
  }
};

TEST_F(BadInput, AMissingMesh) { expect_refused(file("none.msh"), k_cad, "none.msh"); }

TEST_F(BadInput, AFolderInsteadOfAMesh) {
  std::filesystem::create_directory(file("folder.msh"));
  expect_refused(file("folder.msh"), k_cad, "folder.msh");
}

TEST_F(BadInput, AMeshCutOffAtTwentyPlaces) {
  const std::string whole = read_text(k_mesh);
  for (std::size_t i = 0; i < 20; ++i) {
    expect_refused_text(whole.substr(0, whole.size() * (2 * i + 1) / 40), "in.msh");
  }
}

TEST_F(BadInput, AnotherVersion) {
  std::string text = k_head + k_nodes + k_elements;
  text.replace(text.find("4.1"), 3, "3.0");
  expect_refused_text(text, "version");
}

TEST_F(BadInput, ACoordinateThatIsNoNumber) {
  std::string text = k_head + k_nodes + k_elements;
  text.replace(text.find("0 1 0\n"), 6, "0 nan 0\n");
  expect_refused_text(text, "in.msh");
}

TEST_F(BadInput, AnElementWithAnUnknownNode) {
  std::string text = k_head + k_nodes + k_elements;
  text.replace(text.find("1 1 2 3 4"), 9, "1 1 2 3 9");
  expect_refused_text(text, "node 9");
}

TEST_F(BadInput, AnElementWithARepeatedNode) {
  std::string text = k_head + k_nodes + k_elements;
  text.replace(text.find("1 1 2 3 4"), 9, "1 1 2 3 3");
  expect_refused_text(text, "1");
}

TEST_F(BadInput, AnInvertedLinearElementIsListed) {
  MeshData mesh = io::read_mesh(k_mesh);
  GlobalId number = 0;
  for (ElementBlock& block : mesh.blocks) {
    if (block.shape != Shape::tetrahedron) continue;
    std::swap(block.nodes[0], block.nodes[1]);
    number = block.tags[0];
    break;
  }
  expect_refused_mesh(mesh, "tet " + std::to_string(number) + " at (");
}

TEST_F(BadInput, AMeshThatIsAlreadyCurved) {
  ASSERT_EQ(camber({"convert", k_mesh, file("in.msh"), "--order", "2", "-q"}).code, 0);
  expect_refused(file("in.msh"), k_cad, "already curved");
}

TEST_F(BadInput, AMeshWithoutCells) {
  MeshData mesh = io::read_mesh(k_mesh);
  std::erase_if(mesh.blocks, [](const ElementBlock& b) { return dimension(b.shape) == 3; });
  expect_refused_mesh(mesh, "no volume cells");
}

TEST_F(BadInput, AMeshWithoutABoundaryOnTheCad) {
  MeshData mesh = io::read_mesh(k_mesh);
  std::erase_if(mesh.blocks, [](const ElementBlock& b) { return dimension(b.shape) < 3; });
  for (EntityKey& key : mesh.point_entity) key = {3, 1};
  for (Vec3& x : mesh.points) x += Vec3(50.0, 0.0, 0.0);
  expect_refused_mesh(mesh, "no surface of the mesh refers to the CAD");
}

TEST_F(BadInput, ACadOfAnotherSize) {
  MeshData mesh = io::read_mesh(k_mesh);
  for (Vec3& x : mesh.points) x *= 1.7;
  expect_refused_mesh(mesh, "CAD");
}

TEST_F(BadInput, AMissingCad) { expect_refused(k_mesh, file("none.step"), "none.step"); }

TEST_F(BadInput, ACadWithoutFaces) {
  write_text(file("empty.step"),
             "ISO-10303-21;\nHEADER;\nFILE_DESCRIPTION((''),'2;1');\n"
             "FILE_NAME('','',(''),(''),'','','');\nFILE_SCHEMA(('AUTOMOTIVE_DESIGN'));\nENDSEC;\n"
             "DATA;\nENDSEC;\nEND-ISO-10303-21;\n");
  expect_refused(k_mesh, file("empty.step"), "empty.step");
}

TEST_F(BadInput, ACadCutInTheMiddle) {
  const std::string whole = read_text(k_cad);
  write_text(file("cut.step"), whole.substr(0, whole.size() / 2));
  expect_refused(k_mesh, file("cut.step"), "cut.step");
}

TEST_F(BadInput, GeometryWithoutCadThatCannotBe) {
  expect_refused(k_mesh, file("none.stl"), "none.stl");
  write_text(file("text.stl"), "no surface");
  expect_refused(k_mesh, file("text.stl"), "not an STL file");
  const auto curved_onto = [&](const std::string& geometry) {
    return camber({"curve", k_mesh, "-g", geometry, "-o", file("out.msh")});
  };
  expect_error(curved_onto("sphere:0,0,0"), 1, "4 expected");
  expect_error(curved_onto("torus:0,0,0,0,0,1,1,2"), 1, "as wide as its ring");
  expect_error(camber({"curve", k_mesh, "-g", "auto", "-o", file("out.msh"), "--link", "tags"}), 1,
               "nothing to link to");
  expect_error(camber({"check", k_mesh, "-g", "auto"}), 1, "for camber curve alone");
}

TEST_F(BadInput, UnknownExtensions) {
  write_text(file("mesh.abc"), read_text(k_mesh));
  expect_refused(file("mesh.abc"), k_cad, ".abc");
  write_text(file("body.xyz"), read_text(k_cad));
  expect_refused(k_mesh, file("body.xyz"), ".xyz");
  expect_error(camber({"curve", k_mesh, "-g", k_cad, "-o", file("out.abc")}), 2, ".abc");
}

TEST_F(BadInput, AnOutputFolderThatDoesNotExistIsRefusedBeforeAnyWork) {
  // The mesh is missing too: the output is looked at first.
  expect_error(camber({"curve", file("none.msh"), "-g", k_cad, "-o", file("no/out.msh")}), 2,
               "no/out.msh");
  expect_error(camber({"curve", file("none.msh"), "-g", k_cad, "-o", file("out.msh"), "--json",
                       file("no/r.json")}),
               2, "no/r.json");
}

TEST_F(BadInput, AFileSizeLimitLeavesTheOldOutput) {
  const Outcome outcome =
      camber({"curve", k_mesh, "-g", k_cad, "-o", file("out.msh")}, "trap '' XFSZ; ulimit -f 64");
  expect_error(outcome, 2, "out.msh");
  EXPECT_THAT(files(), ElementsAre("out.msh"));
  EXPECT_EQ(read_text(file("out.msh")), k_old);
}

TEST_F(BadInput, AFullDiskLeavesTheOldOutput) {
  std::filesystem::create_directory(file("small"));
  if (mount("tmpfs", file("small").c_str(), "tmpfs", 0, "size=64k") != 0) {
    GTEST_SKIP() << "mounting a small disk needs root";
  }
  write_text(file("small/out.msh"), k_old);

  const Outcome outcome = camber({"curve", k_mesh, "-g", k_cad, "-o", file("small/out.msh")});
  const std::string left = read_text(file("small/out.msh"));
  const auto count = std::distance(std::filesystem::directory_iterator(file("small")),
                                   std::filesystem::directory_iterator());
  umount(file("small").c_str());

  expect_error(outcome, 2, "out.msh");
  EXPECT_EQ(left, k_old);
  EXPECT_EQ(count, 1);
}

TEST_F(BadInput, TheJsonReportTellsTheErrorToo) {
  const Outcome outcome = camber({"check", file("none.msh"), "--json", file("report.json")});

  expect_error(outcome, 2, "none.msh");
  const nlohmann::json json = nlohmann::json::parse(read_text(file("report.json")));
  EXPECT_EQ(json["status"], "error");
  EXPECT_EQ(json["exit_code"], 2);
  EXPECT_THAT(json["error"].get<std::string>(), HasSubstr("none.msh"));
}

}  // namespace
}  // namespace camber::cli
