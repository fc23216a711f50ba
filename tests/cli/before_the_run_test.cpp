// What camber curve finds out before it works: memory, and what the families of a mesh say.
#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include "run_camber.hpp"

namespace camber::cli {
namespace {

using ::testing::HasSubstr;
using Json = nlohmann::json;

TEST_F(CliTest, TheMemoryExpectedIsWithinAFactorOfThreeOfThePeak) {
  for (const std::string name : {"ball", "elbow", "wing"}) {
    for (const std::string order : {"2", "4"}) {
      const Outcome outcome =
          camber({"curve", bundled(name + "/linear.msh"), "-g", bundled(name + "/body.step"),
                  "--order", order, "-o", file("out.msh"), "-v", "--json", file("report.json")});

      ASSERT_EQ(outcome.code, 0) << outcome.err;
      EXPECT_THAT(outcome.err, HasSubstr("MB expected"));
      const Json memory = Json::parse(read_text(file("report.json")))["memory"];
      const double ratio =
          memory["estimated_bytes"].get<double>() / memory["peak_bytes"].get<double>();
      EXPECT_GT(ratio, 1.0 / 3.0) << name << " " << order;
      EXPECT_LT(ratio, 3.0) << name << " " << order;
    }
  }
}

TEST_F(CliTest, FamiliesOfACgnsMeshLinkItToTheCad) {
  const std::string cad = bundled("elbow/body.step");
  // Linked by tags, so that its families name CAD faces; patches of a CGNS file have no tags.
  ASSERT_EQ(camber({"curve", bundled("elbow/linear.msh"), "-g", cad, "--order", "1", "-q", "-o",
                    file("linear.cgns")})
                .code,
            0);
  const auto link = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"curve",  file("linear.cgns"), "-g",      cad,
                                       "-o",     file("out.cgns"),    "--order", "2",
                                       "--json", file("report.json")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = camber(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err << outcome.out;
    return Json::parse(read_text(file("report.json")));
  };

  const Json families = link({}), shape = link({"--link", "shape"});

  EXPECT_EQ(families["link"]["method"], "families");
  EXPECT_THAT(families["link"]["reason"].get<std::string>(), HasSubstr("name the CAD faces of"));
  EXPECT_EQ(shape["link"]["method"], "shape");
  EXPECT_EQ(families["output"]["cells_by_order"], shape["output"]["cells_by_order"]);
  EXPECT_NEAR(families["surface"]["maximum"], shape["surface"]["maximum"], 1e-12);

  const Outcome found = camber({"associate", file("linear.cgns"), "-g", cad, "-o", file("link.xml"),
                                "--json", file("report.json")});
  EXPECT_EQ(found.code, 0) << found.err << found.out;
  const Json associate = Json::parse(read_text(file("report.json")));
  EXPECT_EQ(associate["link"]["method"], "families");
  EXPECT_EQ(associate["link"]["reason"], families["link"]["reason"]);
}

}  // namespace
}  // namespace camber::cli
