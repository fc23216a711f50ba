#pragma once
#include <cstdlib>
#include <string>
#include <sys/wait.h>

#include "hybrid_mesh.hpp"
#include "sample_mesh.hpp"

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

/// The verdict of a second reader (read_*.py) on a file: every cell, face and node of the mesh,
/// which has one order, is where it was. @return as run_script()
inline int judged_by(const std::string& reader, const MeshData& uniform, int order,
                     const std::string& path) {
  write_sizes(uniform, scratch("sizes.txt"));
  return run_script(reader, path + " " + std::to_string(order) + " " + scratch("sizes.txt"));
}

}  // namespace camber::io
