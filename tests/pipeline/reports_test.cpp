#include <camber/pipeline/text_report.hpp>
#include <camber/pipeline/text_table.hpp>
#include <camber/pipeline/version.hpp>

#include <algorithm>
#include <limits>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

namespace camber {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Not;
using Json = nlohmann::ordered_json;

/// A report with a value of its own in every place.
Report filled() {
  Report report;
  report.command = "curve";
  report.status = "scaled_back";
  report.exit_code = 3;
  report.options = {{"order", "4"}, {"deviation", "0.01"}};
  report.input.mesh = "in.msh";
  report.input.geometry = {"body.step"};
  report.input.cells = {{Shape::tetrahedron, 11}, {Shape::prism, 12}};
  report.input.nodes = 13;
  report.output.path = "out.msh";
  report.output.cells_by_order = {{1, 14}, {4, 9}};
  report.output.cells_by_shape_and_order = {{Shape::tetrahedron, {{1, 11}}},
                                            {Shape::prism, {{1, 3}, {4, 9}}}};
  report.output.nodes = 99;
  report.validity.certified = 21;
  report.validity.invalid = 1;
  report.validity.undecided = 1;
  report.validity.min_scaled_jacobian = -0.25;
  report.validity.min_jacobian_ratio = 0.125;
  report.validity.worst = {{77, Shape::prism, 4, Vec3(1, 2, 3), -0.25}};
  report.conformity = {2e-16, 1, 4.0};
  report.surface.faces = 6;
  report.surface.faces_over_deviation = 2;
  report.surface.average = 0.001;
  report.surface.maximum = 0.002;
  report.surface.linear_average = 0.01;
  report.surface.linear_maximum = 0.02;
  SurfaceRow row;
  row.name = "wing";
  row.cad = {"face_3"};
  row.faces = 6;
  row.area = 1.5;
  row.average = 0.001;
  row.maximum = 0.002;
  row.linear_average = 0.01;
  row.linear_maximum = 0.02;
  report.surface.by_group = {row};
  row.name = "Q4";
  row.cad.clear();
  row.order = 4;
  report.surface.by_order = {row};
  report.surface.patches_without_cad = {"far", "far", "inlet"};
  report.quality.minimum = 0.375;
  report.quality.average = 0.875;
  report.quality.below_target = 5;
  report.quality.cost[9] = 23;
  report.quality.scaled_jacobian[3] = 23;
  report.wall_spacing = {8, 200, 1, 0.0123};
  report.start = {"cell", "elastic", 321, 4, {2, 1, 123, 0.5}};
  report.rescue.scaled_back = 1;
  report.rescue.pinched = 2;
  report.rescue.places = {{5, Shape::tetrahedron, Vec3(0, 0, 1), 0.5, "scaled back"}};
  report.quality.target = 0.9;
  report.rescue.put_back = 2;
  report.smooth = {{"surface", 1, 0, 40, 3, 0, -0.5, Vec3(1, 0, 0), 6, Shape::triangle, 2},
                   {"volume", 2, 17, 4, 0, 9, 0.75, Vec3(0, 2, 0), 7, Shape::prism, 3}};
  report.stages_s = {{"read", 0.5}, {"verify", 0.25}};
  report.total_s = 0.75;
  report.peak_bytes = 1048576;
  report.threads = 2;
  report.warnings = {"something to know"};
  return report;
}

std::vector<std::string> keys(const Json& object) {
  std::vector<std::string> names;
  for (const auto& [key, value] : object.items()) names.push_back(key);
  return names;
}

TEST(JsonReport, HasTheKeysThatOthersRelyOn) {
  const Json json = Json::parse(json_report(filled()));

  EXPECT_THAT(keys(json), ElementsAre("camber", "command", "status", "exit_code", "options",
                                      "input", "output", "validity", "conformity", "link",
                                      "surface", "quality", "wall_spacing", "start", "rescue",
                                      "smooth", "time", "memory", "threads", "ranks", "warnings"));
  EXPECT_THAT(keys(json["input"]), ElementsAre("mesh", "geometry", "cells", "nodes"));
  EXPECT_THAT(keys(json["input"]["cells"]), ElementsAre("tet", "pyramid", "prism", "hex"));
  EXPECT_THAT(keys(json["output"]),
              ElementsAre("path", "cells_by_order", "cells_by_shape_and_order", "nodes"));
  EXPECT_THAT(keys(json["output"]["cells_by_order"]), ElementsAre("1", "2", "3", "4"));
  EXPECT_THAT(keys(json["validity"]),
              ElementsAre("certified", "invalid", "undecided", "min_scaled_jacobian",
                          "min_jacobian_ratio", "worst"));
  EXPECT_THAT(keys(json["validity"]["worst"][0]),
              ElementsAre("cell", "shape", "order", "centre", "lower_bound"));
  EXPECT_THAT(keys(json["surface"]["by_group"][0]),
              ElementsAre("name", "cad", "faces", "area", "average", "maximum", "linear_average",
                          "linear_maximum"));
  EXPECT_THAT(keys(json["time"]["stages_s"]),
              ElementsAre("read", "associate", "elevate", "place", "propagate", "certify", "smooth",
                          "write", "verify"));
  EXPECT_THAT(keys(json["start"]),
              ElementsAre("asked", "taken", "uncertified_as_asked", "uncertified", "elastic"));
  EXPECT_THAT(keys(json["start"]["elastic"]),
              ElementsAre("solves", "unconverged", "products", "largest_residual"));
  EXPECT_THAT(keys(json["rescue"]),
              ElementsAre("load_steps", "patches", "faces_smoothed", "orders_lowered",
                          "scaled_back", "put_back", "pinched", "elastic_patches", "edges_removed",
                          "pinched_split", "mended", "places"));
}

TEST(JsonReport, HoldsEveryValue) {
  const Json json = Json::parse(json_report(filled()));

  EXPECT_EQ(json["camber"]["version"], version());
  EXPECT_EQ(json["exit_code"], 3);
  EXPECT_EQ(json["start"]["asked"], "cell");
  EXPECT_EQ(json["start"]["taken"], "elastic");
  EXPECT_EQ(json["start"]["uncertified_as_asked"], 321);
  EXPECT_EQ(json["start"]["uncertified"], 4);
  EXPECT_EQ(json["start"]["elastic"]["products"], 123);
  EXPECT_EQ(json["start"]["elastic"]["largest_residual"], 0.5);
  EXPECT_EQ(json["options"]["order"], "4");
  EXPECT_EQ(json["input"]["cells"]["prism"], 12);
  EXPECT_EQ(json["input"]["cells"]["hex"], 0);
  EXPECT_EQ(json["output"]["cells_by_shape_and_order"]["prism"]["4"], 9);
  EXPECT_EQ(json["validity"]["worst"][0]["cell"], 77);
  EXPECT_EQ(json["validity"]["worst"][0]["centre"], Json({1.0, 2.0, 3.0}));
  EXPECT_EQ(json["conformity"]["max_gap"], 2e-16);
  EXPECT_EQ(json["surface"]["by_order"][0]["order"], 4);
  EXPECT_EQ(json["surface"]["by_group"][0]["linear_maximum"], 0.02);
  EXPECT_EQ(json["quality"]["cost"]["histogram"][9], 23);
  EXPECT_EQ(json["quality"]["scaled_jacobian"]["histogram"][3], 23);
  EXPECT_EQ(json["wall_spacing"]["first_cell_changed_over_1_percent"], 1);
  EXPECT_EQ(json["rescue"]["places"][0]["distance"], 0.5);
  EXPECT_EQ(json["quality"]["cost"]["target"], 0.9);
  EXPECT_EQ(json["smooth"].size(), 2u);
  EXPECT_EQ(json["smooth"][0]["negative_elements"], 3);
  EXPECT_EQ(json["smooth"][1],
            Json::parse(R"({"stage": "volume", "pass": 2, "iteration": 17, "active_nodes": 4,
                            "negative_elements": 0, "elevated_elements": 9, "worst_cost": 0.75,
                            "place": [0.0, 2.0, 0.0], "element": 7, "shape": "prism",
                            "order": 3})"));
  EXPECT_EQ(json["time"]["stages_s"]["verify"], 0.25);
  EXPECT_EQ(json["memory"]["peak_bytes"], 1048576);
  EXPECT_EQ(json["warnings"][0], "something to know");
}

TEST(JsonReport, IsJsonWhateverTheNumbersAndNamesAre) {
  Report report = filled();
  report.validity.min_scaled_jacobian = std::numeric_limits<double>::quiet_NaN();
  report.surface.maximum = std::numeric_limits<double>::infinity();
  report.surface.by_group[0].name = "na\xefve \"quoted\"\n";

  const Json json = Json::parse(json_report(report));

  EXPECT_TRUE(json["validity"]["min_scaled_jacobian"].is_null());
  EXPECT_TRUE(json["surface"]["maximum"].is_null());
}

TEST(TextReport, ShowsThePapersTableWithTheLinearMeshBeside) {
  const std::string text = text_report(filled());

  EXPECT_THAT(text, HasSubstr("linear avg  linear max  curved avg  curved max"));
  EXPECT_THAT(text, HasSubstr("wing   face_3      6   1.5        0.01        0.02       0.001"));
  EXPECT_THAT(text, HasSubstr("2 of 6 faces are over the deviation asked"));
  EXPECT_THAT(text, HasSubstr("no CAD:  far, inlet\n"));
  EXPECT_THAT(text, HasSubstr("21 of 23 certified, 1 invalid, 1 undecided"));
  EXPECT_THAT(text, HasSubstr("5 cells below 0.9\n"));
  EXPECT_THAT(
      text,
      HasSubstr("volume      2         17             4         0       9     0.75  (0, 2, 0)"));
  EXPECT_THAT(text, HasSubstr("prism 7 Q3"));
  EXPECT_THAT(text, HasSubstr("mesh units"));
  EXPECT_THAT(text, HasSubstr("1 of 200 wall nodes (0.5 %)"));
  EXPECT_THAT(text, HasSubstr("--propagate cell: 321 cells not certified; replaced by elastic: 4"));
  EXPECT_THAT(text,
              HasSubstr("2 elastic solves, 123 products with the stiffness, 1 not converged"));
  EXPECT_THAT(text, HasSubstr("something to know"));
  EXPECT_THAT(text, HasSubstr("result     scaled_back\n"));
}

TEST(TextReport, IsPlainTextOfAtMostAHundredColumns) {
  Report report = filled();
  for (int i = 0; i < 40; ++i) report.options.emplace_back("option", std::to_string(i));
  report.warnings.emplace_back(
      "a long line that goes on and on so that it cannot stand on one line of a terminal, which "
      "has "
      "eighty to a hundred columns at most");
  std::istringstream text(text_report(report));

  for (std::string line; std::getline(text, line);) {
    EXPECT_LE(line.size(), 100u) << line;
    EXPECT_TRUE(line.empty() || line.back() != ' ') << line;
    EXPECT_TRUE(std::all_of(line.begin(), line.end(), [](char c) { return c >= ' ' && c <= '~'; }))
        << line;
  }
}

TEST(TextReport, LeavesOutWhatWasNotMeasured) {
  Report report;
  report.command = "check";

  const std::string text = text_report(report);

  for (const char* section :
       {"Surface", "Start", "Validity", "Wall", "Rescue", "Quality", "Conformity", "Smoothing"}) {
    EXPECT_THAT(text, Not(HasSubstr(section)));
  }
  EXPECT_THAT(text, HasSubstr("result     ok"));
}

TEST(TextTable, AlignsTheFirstColumnLeftAndTheOthersRight) {
  TextTable table;
  table.add({"a", "long head"});
  table.add({"longer", "1"});

  EXPECT_EQ(table.text(), "  a       long head\n  longer          1\n");
}

}  // namespace
}  // namespace camber
