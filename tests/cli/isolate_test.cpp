// --isolate: what it reads first in a process of its own.
#include <gmock/gmock.h>

#include "run_camber.hpp"

namespace camber::cli {
namespace {

using ::testing::HasSubstr;

const std::string k_mesh = bundled("ball/linear.msh"), k_cad = bundled("ball/body.step");

TEST_F(CliTest, IsolateChangesNothingOfAGoodRun) {
  ASSERT_EQ(camber({"convert", k_mesh, file("in.cgns"), "-q"}).code, 0);

  for (const auto& verb : std::vector<std::vector<std::string>>{
           {"convert", file("in.cgns"), file("out.msh")},
           {"check", file("in.cgns")},
           {"info", file("in.cgns")},
           {"info", k_cad},
           {"check", k_mesh, "-g", k_cad},
           {"report", k_mesh, "-g", k_cad, "-o", file("p.html")}}) {
    std::vector<std::string> isolated = verb;
    isolated.emplace_back("--isolate");
    const Outcome plain = camber(verb), with = camber(isolated);
    EXPECT_EQ(with.code, plain.code) << with.err;
    EXPECT_EQ(with.err, "");
  }
  const std::vector<std::string> curve{"curve", k_mesh, "-g", k_cad, "-o", file("a.msh"), "-q"};
  std::vector<std::string> isolated = curve;
  isolated[5] = file("b.msh");
  isolated.emplace_back("--isolate");
  ASSERT_EQ(camber(curve).code, 0);
  ASSERT_EQ(camber(isolated).code, 0);
  EXPECT_EQ(read_text(file("a.msh")), read_text(file("b.msh")));
}

TEST_F(CliTest, IsolateTellsDamageAsTheReaderDoes) {
  const std::string text = read_text(k_cad);
  write_text(file("cut.step"), text.substr(0, text.size() / 2));

  const Outcome plain = camber({"info", file("cut.step")});
  const Outcome isolated = camber({"info", file("cut.step"), "--isolate"});

  expect_error(isolated, 2, "cut.step");
  EXPECT_EQ(isolated.err, plain.err);
}

TEST_F(CliTest, IsolateLimitsMemory) {
  expect_error(camber({"curve", k_mesh, "-g", k_cad, "-o", file("out.msh"), "--isolate",
                       "--isolate-memory", "0.000001"}),
               2, "body.step");
  EXPECT_TRUE(files().empty());
}

}  // namespace
}  // namespace camber::cli
