// -g of check and report with geometry that is no CAD file.
#include <camber/io/mesh_file.hpp>

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "run_camber.hpp"

namespace camber::cli {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

const std::string k_mesh = bundled("ball/linear.msh");

TEST_F(CliTest, ReportTakesAnAnalyticSurfaceAndFindsItsElementsByPlace) {
  const Outcome outcome = camber({"report", k_mesh, "-g", "sphere:0,0,0,1", "-o", file("page.html"),
                                  "--json", file("report.json")});

  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_THAT(outcome.out, HasSubstr("surface elements lie on it"));
  EXPECT_THAT(read_text(file("page.html")), HasSubstr("\"has_deviation\":true"));
  const Json link = Json::parse(read_text(file("report.json")))["link"];
  EXPECT_EQ(link["method"], "place");
  EXPECT_GT(link["on_cad"], 0);
  EXPECT_LT(link["on_cad"], link["faces"]);  // the far field is not on the sphere
}

TEST_F(CliTest, ReportRefusesASurfaceThatTheMeshDoesNotLieOn) {
  expect_error(camber({"report", k_mesh, "-g", "sphere:50,0,0,1", "-o", file("page.html")}), 2,
               "no surface element of the mesh has its corners on it");
}

TEST_F(CliTest, CheckRefusesGeometryWithoutCadAndSaysWhy) {
  expect_error(camber({"check", k_mesh, "-g", "sphere:0,0,0,1"}), 1,
               "measures patches by the CAD faces that their tags name");
}

}  // namespace
}  // namespace camber::cli
