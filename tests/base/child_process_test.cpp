#include <camber/base/child_process.hpp>
#include <camber/base/error.hpp>
#include <camber/base/progress.hpp>

#include <csignal>
#include <stdexcept>
#include <string>
#include <unistd.h>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace camber {
namespace {

using ::testing::HasSubstr;

/// What the work ends in; "" if in nothing.
template <class Kind = FileError>
std::string outcome(const ChildLimits& limits, const std::function<void()>& work) {
  try {
    try_in_child("bad.step", limits, work);
  } catch (const Kind& error) {
    return error.what();
  }
  return "";
}

TEST(ChildProcess, LeavesNothingBehindIfAllIsWell) {
  int value = 1;

  try_in_child("good.step", {.bytes = 1'000'000'000, .seconds = 10}, [&] { value = 2; });

  EXPECT_EQ(value, 1);
}

TEST(ChildProcess, ErrorsOfTheWorkReachTheCaller) {
  EXPECT_EQ(outcome({}, [] { throw FileError("no faces", "bad.step, line 3", "save it"); }),
            FileError("no faces", "bad.step, line 3", "save it").what());
  EXPECT_THAT(outcome<GeometryError>({}, [] { throw GeometryError("a", "b", ""); }),
              HasSubstr("a"));
  EXPECT_THAT(outcome({}, [] { throw std::runtime_error("odd"); }), HasSubstr("odd"));
}

TEST(ChildProcess, ALongErrorArrivesWhole) {
  const std::string text(300'000, 'x');
  EXPECT_THAT(outcome({}, [&] { throw FileError(text, "bad.step", ""); }), HasSubstr(text));
}

TEST(ChildProcess, ACrashIsOneErrorThatNamesTheFile) {
  const std::string crash = outcome({}, [] {
    std::signal(SIGSEGV, SIG_DFL);  // sanitizers would tell it in their own way
    ::raise(SIGSEGV);
  });
  EXPECT_THAT(crash, HasSubstr("bad.step"));
  EXPECT_THAT(crash, HasSubstr("signal 11"));
  EXPECT_THAT(outcome({}, [] { ::_exit(1); }), HasSubstr("exit code 1"));
}

TEST(ChildProcess, TimeAndMemoryAreLimited) {
  EXPECT_THAT(outcome({.seconds = 1},
                      [] {
                        volatile unsigned n = 0;
                        while (true) n = n + 1;
                      }),
              HasSubstr("more than 1 s of processor time"));
#ifndef __SANITIZE_ADDRESS__  // it takes terabytes of address space for itself
  EXPECT_THAT(outcome({.bytes = 50'000'000},
                      [] {
                        const std::vector<char> all(100'000'000, 'x');
                        if (all[7] != 'x') throw std::logic_error("");
                      }),
              HasSubstr("more memory than the limit"));
#endif
}

TEST(ChildProcess, IsEndedWhenItsRunIsCancelled) {
  EXPECT_THROW(try_in_child(
                   "slow.step", {}, [] { ::pause(); }, [] { return true; }),
               Cancelled);
}

}  // namespace
}  // namespace camber
