#pragma once
// Runs the built program and keeps what it said.
#include <filesystem>
#include <string>
#include <sys/types.h>
#include <vector>

#include <gtest/gtest.h>

namespace camber::cli {

struct Outcome {
  int code = -1;  // exit code; -signal if killed
  std::string out, err;
};

[[nodiscard]] std::string read_text(const std::filesystem::path& path);
void write_text(const std::filesystem::path& path, const std::string& text);
/// Path of a bundled case's file.
[[nodiscard]] std::string bundled(const std::string& file);

/// A folder of its own for every test, removed afterwards.
class CliTest : public ::testing::Test {
 protected:
  CliTest();
  ~CliTest() override;

  [[nodiscard]] std::string file(const std::string& name) const {
    return (folder_ / name).string();
  }
  /// Runs camber with these arguments; `setup` are shell commands before it.
  [[nodiscard]] Outcome camber(const std::vector<std::string>& arguments,
                               const std::string& setup = "") const;
  /// Starts camber and returns at once; wait_for() ends it.
  [[nodiscard]] pid_t start(const std::vector<std::string>& arguments) const;
  [[nodiscard]] static int wait_for(pid_t process);

  /// Expects the exit code, nothing on stdout, and one line on stderr: "camber: error:
  /// ...MESSAGE...".
  static void expect_error(const Outcome& outcome, int code, const std::string& message);
  /// Names of all files in the folder.
  [[nodiscard]] std::vector<std::string> files() const;

 private:
  std::filesystem::path folder_;
};

}  // namespace camber::cli
