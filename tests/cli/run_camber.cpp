#include "run_camber.hpp"

#include <algorithm>
#include <cstdlib>
#include <fcntl.h>
#include <fstream>
#include <sstream>
#include <sys/wait.h>
#include <unistd.h>

#include <gmock/gmock.h>

namespace camber::cli {
namespace {

std::string quoted(const std::string& word) {
  std::string out(1, '\'');
  for (char c : word) {
    if (c == '\'') {
      out.append("'\\''");
    } else {
      out.push_back(c);
    }
  }
  out.push_back('\'');
  return out;
}

int exit_code(int status) { return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status); }

}  // namespace

std::string read_text(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream out(path, std::ios::binary);
  out << text;
}

std::string bundled(const std::string& file) {
  return std::string(CAMBER_SOURCE_DIR) + "/cases/" + file;
}

CliTest::CliTest() {
  std::string pattern = (std::filesystem::temp_directory_path() / "camber_cli_XXXXXX").string();
  if (!mkdtemp(pattern.data())) throw std::runtime_error("no temporary folder");
  folder_ = pattern;
}

CliTest::~CliTest() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

Outcome CliTest::camber(const std::vector<std::string>& arguments, const std::string& setup) const {
  const std::filesystem::path out = folder_.string() + ".out", err = folder_.string() + ".err";
  std::string command = setup;
  if (!setup.empty()) command.append("; ");
  command += quoted(CAMBER_PROGRAM);
  for (const std::string& argument : arguments) {
    command.append(" ");
    command.append(quoted(argument));
  }
  command.append(" >").append(quoted(out.string()));
  command.append(" 2>").append(quoted(err.string())).append(" </dev/null");
  Outcome outcome;
  outcome.code = exit_code(std::system(command.c_str()));
  outcome.out = read_text(out);
  outcome.err = read_text(err);
  std::filesystem::remove(out);
  std::filesystem::remove(err);
  return outcome;
}

pid_t CliTest::start(const std::vector<std::string>& arguments) const {
  std::vector<std::string> words{CAMBER_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  std::vector<char*> pointers;
  for (std::string& word : words) pointers.push_back(word.data());
  pointers.push_back(nullptr);
  const pid_t process = fork();
  if (process == 0) {
    const int nothing = open("/dev/null", O_WRONLY);
    dup2(nothing, STDOUT_FILENO);
    dup2(nothing, STDERR_FILENO);
    execv(CAMBER_PROGRAM, pointers.data());
    _exit(127);
  }
  return process;
}

int CliTest::wait_for(pid_t process) {
  int status = 0;
  waitpid(process, &status, 0);
  return exit_code(status);
}

void CliTest::expect_error(const Outcome& outcome, int code, const std::string& message) {
  EXPECT_EQ(outcome.code, code);
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_THAT(outcome.err, ::testing::StartsWith("camber: error: "));
  EXPECT_THAT(outcome.err, ::testing::HasSubstr(message));
}

std::vector<std::string> CliTest::files() const {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    names.push_back(entry.path().filename().string());
  }
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace camber::cli
