// Ctrl-C: exit code 130, no half-written file, the old output as it was.
#include <chrono>
#include <csignal>
#include <thread>

#include <gmock/gmock.h>

#include "run_camber.hpp"

namespace camber::cli {
namespace {

TEST_F(CliTest, AnInterruptLeavesTheOldOutputAndNothingElse) {
  write_text(file("out.msh"), "old");
  int code = -SIGINT;
  // A signal that comes before the program listens kills it: later and later until it is at work.
  for (int delay_ms = 20; delay_ms <= 5120 && code == -SIGINT; delay_ms *= 2) {
    const pid_t process = start({"curve", bundled("wing/linear.msh"), "-g",
                                 bundled("wing/body.step"), "-o", file("out.msh")});
    std::this_thread::sleep_for(std::chrono::milliseconds(delay_ms));
    ::kill(process, SIGINT);
    code = wait_for(process);
  }
  EXPECT_EQ(code, 130);
  EXPECT_EQ(read_text(file("out.msh")), "old");
  EXPECT_THAT(files(), ::testing::ElementsAre("out.msh"));
}

}  // namespace
}  // namespace camber::cli
