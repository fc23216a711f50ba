#pragma once
#include <cstdlib>
#include <string>
#include <sys/wait.h>

namespace camber::io {

/// Exit code of the scripts in this folder where what they need is not installed.
inline constexpr int k_not_installed = 77;

/// Runs a Python script of this folder with the system's own Python, which has the packages of the
/// distribution. @return its exit code, -1 if it was killed
inline int run_script(const std::string& name, const std::string& arguments) {
  const std::string command = "/usr/bin/python3 -B " + std::string(CAMBER_SOURCE_DIR) +
                              "/tests/io/" + name + " " + arguments;
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace camber::io
