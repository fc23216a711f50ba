// Help, and what is said when the command line is wrong: exit code 1 and one line.
#include <gmock/gmock.h>

#include "run_camber.hpp"

namespace camber::cli {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

const std::string k_mesh = bundled("ball/linear.msh"), k_cad = bundled("ball/body.step");

TEST_F(CliTest, HelpListsTheVerbsOfThisReleaseAndTheExitCodes) {
  const Outcome outcome = camber({"--help"});
  EXPECT_EQ(outcome.code, 0);
  for (const char* verb :
       {"curve", "associate", "check", "info", "convert", "cite", "Exit codes"}) {
    EXPECT_THAT(outcome.out, HasSubstr(verb));
  }
}

TEST_F(CliTest, EveryVerbHasTheCommonFlags) {
  for (const char* verb : {"curve", "associate", "check", "info", "convert", "cite"}) {
    const Outcome outcome = camber({verb, "--help"});
    EXPECT_EQ(outcome.code, 0);
    for (const char* flag :
         {"--json", "--threads", "--quiet", "--verbose", "--no-progress", "--version"}) {
      EXPECT_THAT(outcome.out, HasSubstr(flag)) << verb;
    }
  }
}

TEST_F(CliTest, HelpOfCurveShowsDefaultsAndUnits) {
  const Outcome outcome = camber({"curve", "--help"});
  for (const char* text :
       {"--order ORDER:INT in [1 - 4]=4", "--min-order ORDER:INT in [1 - 4]=1",
        "--deviation SHARE:POSITIVE=0.01", "--deviation-length face|cell|LENGTH=face",
        "[mesh units]", "--unit UNIT:{auto,m,mm,in}=auto", "--patch NAME=RULE", "--allow-invalid",
        "--strict", "--uniform", "--smooth auto|marching|none",
        "--quality COST:FLOAT in [0 - 1]=0.95", "--from", "--to"}) {
    EXPECT_THAT(outcome.out, HasSubstr(text));
  }
}

TEST_F(CliTest, VersionIsTheSameEverywhere) {
  const std::string version = camber({"--version"}).out;
  EXPECT_THAT(version, ::testing::StartsWith("camber "));
  EXPECT_EQ(camber({"check", "--version"}).out, version);
}

TEST_F(CliTest, WrongCommandLinesGiveOneAndOneLine) {
  struct Case {
    std::vector<std::string> arguments;
    const char* message;
  };
  const std::string out = file("out.msh");
  const std::vector<Case> cases{
      {{}, "a verb is needed"},
      {{"bend", k_mesh}, "bend"},
      {{"curve", k_mesh, "-o", out}, "--geometry"},
      {{"curve", k_mesh, "-g", k_cad}, "--output"},
      {{"curve", "-g", k_cad, "-o", out}, "mesh"},
      {{"curve", k_mesh, "-g", k_cad, "-o", out, "--order", "7"}, "--order"},
      {{"curve", k_mesh, "-g", k_cad, "-o", out, "--order", "two"}, "two"},
      {{"curve", k_mesh, "-g", k_cad, "-o", out, "--deviation", "-1"}, "--deviation"},
      {{"curve", k_mesh, "-g", k_cad, "-o", out, "--colour"}, "--colour"},
      {{"curve", k_mesh, "-g", k_cad, "-o", out, "--order", "2", "--min-order", "3"},
       "--min-order"},
      {{"curve", k_mesh, "-g", k_cad, "-o", out, "--deviation-length", "long"}, "'long'"},
      {{"curve", k_mesh, "-g", k_cad, "-o", out, "--patch", "ball=round"}, "ball=round"},
      {{"curve", k_mesh, "-g", k_cad, "-o", out, "--patch", "nose=free"}, "nose"},
      {{"curve", k_mesh, "-g", k_cad, "-o", out, "-g", k_cad}, "--geometry"},
      {{"curve", k_mesh, "-g", k_cad, "-o", out, "-o", file("./out.msh")}, "same name"},
      {{"convert", k_mesh, out, "--order", "2", "--keep"}, "--keep"},
      {{"convert", k_mesh, out, "--to", "stl"}, "--to"},
      {{"check", k_mesh, "--threads", "-2"}, "--threads"},
  };
  for (const Case& wrong : cases) {
    expect_error(camber(wrong.arguments), 1, wrong.message);
    EXPECT_THAT(files(), IsEmpty());
  }
}

TEST_F(CliTest, AnOutputNeverReplacesAnInput) {
  const std::string text = read_text(k_mesh);
  write_text(file("in.msh"), text);
  std::filesystem::create_symlink(file("in.msh"), file("link.msh"));

  expect_error(camber({"curve", file("in.msh"), "-g", k_cad, "-o", file("./in.msh")}), 1,
               "replace an input");
  expect_error(camber({"convert", file("in.msh"), file("link.msh")}), 1, "replace an input");
  EXPECT_EQ(read_text(file("in.msh")), text);
}

}  // namespace
}  // namespace camber::cli
