// What the verbs do with good input.
#include <camber/io/mesh_file.hpp>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "run_camber.hpp"

namespace camber::cli {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using Json = nlohmann::json;

const std::string k_mesh = bundled("ball/linear.msh"), k_cad = bundled("ball/body.step");

TEST_F(CliTest, CurvesTheBallWritesItTwiceAndReports) {
  const Outcome outcome =
      camber({"curve", k_mesh, "-g", k_cad, "-o", file("out.msh"), "-o", file("out.vtu"), "--order",
              "3", "--deviation", "0.001", "--json", file("report.json")});

  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  EXPECT_THAT(outcome.out, HasSubstr("3653 of 3653 certified"));
  EXPECT_THAT(files(), ElementsAre("out.msh", "out.vtu", "report.json"));
  const Json json = Json::parse(read_text(file("report.json")));
  EXPECT_EQ(json["command"], "curve");
  EXPECT_EQ(json["status"], "ok");
  EXPECT_EQ(json["options"]["order"], "3");
  EXPECT_EQ(json["input"]["cells"],
            Json({{"tet", 2895}, {"pyramid", 86}, {"prism", 156}, {"hex", 516}}));
  EXPECT_EQ(json["output"]["cells_by_order"]["4"], 0);
  EXPECT_GT(json["output"]["cells_by_order"]["3"], 0);
  EXPECT_LT(json["surface"]["maximum"], 0.05 * json["surface"]["linear_maximum"].get<double>());
  EXPECT_GT(json["memory"]["peak_bytes"], 1000000);
}

TEST_F(CliTest, ChecksWhatItCurvedAndAgreesWithTheReportOfTheRun) {
  ASSERT_EQ(camber({"curve", k_mesh, "-g", k_cad, "-o", file("out.msh"), "-q", "--json",
                    file("curve.json")})
                .code,
            0);

  const Outcome outcome =
      camber({"check", file("out.msh"), "-g", k_cad, "-q", "--json", file("check.json")});

  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  const Json run = Json::parse(read_text(file("curve.json")));
  const Json check = Json::parse(read_text(file("check.json")));
  EXPECT_EQ(check["output"]["cells_by_shape_and_order"], run["output"]["cells_by_shape_and_order"]);
  EXPECT_EQ(check["validity"]["certified"], run["validity"]["certified"]);
  for (const char* key : {"min_scaled_jacobian", "min_jacobian_ratio"}) {
    EXPECT_NEAR(check["validity"][key], run["validity"][key], 1e-9) << key;
  }
  for (const char* key : {"average", "maximum", "linear_average", "linear_maximum"}) {
    EXPECT_NEAR(check["surface"][key], run["surface"][key], 1e-9) << key;
  }
  EXPECT_NEAR(check["quality"]["cost"]["minimum"], run["quality"]["cost"]["minimum"], 1e-9);
  EXPECT_EQ(check["conformity"]["max_order_jump"], run["conformity"]["max_order_jump"]);
  EXPECT_LT(check["conformity"]["max_gap"],
            1e-14 * check["conformity"]["model_size"].get<double>());
}

TEST_F(CliTest, WritesTheSameBytesForAnyNumberOfThreads) {
  for (const char* threads : {"1", "2", "4", "8"}) {
    ASSERT_EQ(camber({"curve", k_mesh, "-g", k_cad, "-q", "--threads", threads, "-o",
                      file(std::string(threads) + ".msh")})
                  .code,
              0);
  }
  const std::string one = read_text(file("1.msh"));
  for (const char* other : {"2.msh", "4.msh", "8.msh"}) EXPECT_EQ(read_text(file(other)), one);
}

TEST_F(CliTest, ChecksALinearMeshWithoutCad) {
  const Outcome outcome = camber({"check", k_mesh});

  EXPECT_EQ(outcome.code, 0);
  EXPECT_THAT(outcome.out, HasSubstr("3653 of 3653 certified, 0 invalid, 0 undecided"));
}

TEST_F(CliTest, CheckGivesThreeForAnInvertedElementAndNamesIt) {
  ASSERT_EQ(camber({"convert", k_mesh, file("quadratic.msh"), "--order", "2"}).code, 0);
  MeshData mesh = io::read_mesh(file("quadratic.msh"));
  for (ElementBlock& block : mesh.blocks) {
    if (block.shape != Shape::hexahedron) continue;
    std::swap(mesh.points[at(block.nodes[0])], mesh.points[at(block.nodes[13])]);
    break;
  }
  io::write_mesh(mesh, file("bad.msh"));

  const Outcome outcome = camber({"check", file("bad.msh"), "--json", file("check.json")});

  EXPECT_EQ(outcome.code, 3);
  EXPECT_THAT(outcome.out, HasSubstr("result     not_certified"));
  const Json json = Json::parse(read_text(file("check.json")));
  EXPECT_EQ(json["status"], "not_certified");
  EXPECT_EQ(json["exit_code"], 3);
  EXPECT_GT(json["validity"]["invalid"], 0);
  EXPECT_LT(json["validity"]["worst"][0]["lower_bound"], 0.0);
}

TEST_F(CliTest, ConvertsToQuarticAndBackToTheSameCorners) {
  ASSERT_EQ(camber({"convert", k_mesh, file("quartic.msh"), "--order", "4"}).code, 0);
  const Outcome back = camber({"convert", file("quartic.msh"), file("linear.msh"), "--order", "1"});

  EXPECT_EQ(back.code, 0);
  EXPECT_THAT(back.out, HasSubstr("3653 Q1"));
  const MeshData before = io::read_mesh(k_mesh), after = io::read_mesh(file("linear.msh"));
  EXPECT_EQ(after.element_count(), before.element_count());
  EXPECT_EQ(after.points.size(), before.points.size());
}

TEST_F(CliTest, ConvertKeepsOrdersAndWritesOtherFormats) {
  ASSERT_EQ(camber({"convert", k_mesh, file("q2.msh"), "--order", "2", "-q"}).code, 0);

  EXPECT_EQ(camber({"convert", file("q2.msh"), file("old.msh"), "--keep", "--msh-version", "2.2",
                    "--ascii"})
                .code,
            0);
  EXPECT_EQ(camber({"convert", file("q2.msh"), file("view.data"), "--to", "vtu", "--json",
                    file("convert.json")})
                .code,
            0);

  EXPECT_THAT(read_text(file("old.msh")), ::testing::StartsWith("$MeshFormat\n2.2 0 8\n"));
  EXPECT_THAT(read_text(file("view.data")), HasSubstr("VTKFile"));
  EXPECT_EQ(Json::parse(read_text(file("convert.json")))["output"]["cells_by_order"]["2"], 3653);
}

TEST_F(CliTest, ConvertGoesThroughEveryFormatAndKeepsCellsAndPatches) {
  ASSERT_EQ(camber({"convert", k_mesh, file("a.cgns"), "--order", "2", "-q"}).code, 0);
  ASSERT_EQ(camber({"convert", file("a.cgns"), file("b.su2"), "-q"}).code, 0);
  ASSERT_EQ(camber({"convert", file("b.su2"), file("c.lb8.ugrid"), "--order", "1", "-q"}).code, 0);
  ASSERT_EQ(camber({"convert", file("c.lb8.ugrid"), file("d.msh"), "-q"}).code, 0);

  const MeshData mesh = io::read_mesh(file("d.msh"));

  EXPECT_EQ(mesh.element_count(), 4305U);
  std::vector<std::string> patches;
  for (const EntityRecord& e : mesh.entities) {
    if (e.key.dim == 2) patches.push_back(e.name);
  }
  EXPECT_THAT(patches, ElementsAre("ball", "far"));
  EXPECT_THAT(files(), ElementsAre("a.cgns", "b.su2", "c.lb8.ugrid", "c.mapbc", "d.msh"));
}

TEST_F(CliTest, InfoListsTheFormatsOrAsksForAFile) {
  EXPECT_THAT(camber({"info", "--formats"}).out, HasSubstr("| CGNS"));

  const Outcome outcome = camber({"info"});

  EXPECT_EQ(outcome.code, 1);
  EXPECT_THAT(outcome.err, HasSubstr("name a mesh or a CAD file"));
}

TEST_F(CliTest, InfoListsPatchesOfAMeshAndFacesOfACad) {
  const Outcome mesh = camber({"info", k_mesh, "--json", file("mesh.json")});
  const Outcome cad = camber({"info", k_cad, "--json", file("cad.json")});

  EXPECT_EQ(mesh.code, 0);
  EXPECT_THAT(mesh.out, HasSubstr("2895 tet Q1, 86 pyramid Q1, 156 prism Q1, 516 hex Q1"));
  EXPECT_THAT(mesh.out, ::testing::ContainsRegex("surface 1 +ball +26 tri Q1, 86 quad Q1"));
  EXPECT_EQ(Json::parse(read_text(file("mesh.json")))["mesh"]["elements"]["hex"]["1"], 516);
  EXPECT_EQ(cad.code, 0);
  EXPECT_THAT(cad.out, HasSubstr("1 faces"));
  const Json json = Json::parse(read_text(file("cad.json")));
  EXPECT_EQ(json["cad"]["faces"], 1);
  EXPECT_EQ(json["cad"]["face"][0]["kind"], "curved");
}

TEST_F(CliTest, CitesThePaper) {
  const Outcome outcome = camber({"cite"});
  EXPECT_EQ(outcome.code, 0);
  EXPECT_EQ(outcome.out, read_text(std::string(CAMBER_SOURCE_DIR) + "/docs/references.bib"));
  EXPECT_THAT(outcome.out, HasSubstr("karman2022"));
}

TEST_F(CliTest, AssociateWritesALinkThatCurveTakes) {
  const std::string mesh = bundled("wing/linear.msh"), cad = bundled("wing/body.step");
  const Outcome found =
      camber({"associate", mesh, "-g", cad, "-o", file("link.xml"), "--link", "shape"});
  EXPECT_EQ(found.code, 0) << found.err;
  EXPECT_THAT(found.out, HasSubstr("found by shape"));
  EXPECT_THAT(found.out, HasSubstr("confidence"));
  const Outcome curved = camber(
      {"curve", mesh, "-g", cad, "-l", file("link.xml"), "-o", file("a.msh"), "--order", "2"});
  EXPECT_EQ(curved.code, 0) << curved.err;
  EXPECT_EQ(camber({"curve", mesh, "-g", cad, "-o", file("b.msh"), "--order", "2", "--patch",
                    "1=face_99"})
                .code,
            1);
}

}  // namespace
}  // namespace camber::cli
