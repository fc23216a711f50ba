#pragma once
// --isolate: files that other people's libraries read are tried in a process of their own first.
#include <camber/io/mesh_file.hpp>

#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace camber::app {

struct IsolationFlags {
  bool is_asked = false;
  double memory = 8.0;  // [GB]
  int seconds = 600;    // of processor time [s]
};

void add_isolation_flags(CLI::App& verb, IsolationFlags& flags);

/// If asked, reads the mesh, where it is CGNS, and every CAD file completely in a child process
/// each; what is read is thrown away. To be called before any thread is started.
/// @param mesh  "" for none
/// @param geometry  as -g takes it; what is no CAD file is passed over
/// @throws Error as try_in_child(), Cancelled
void try_inputs(const IsolationFlags& flags, const std::string& mesh,
                const io::ReadOptions& reading, const std::vector<std::string>& geometry);

}  // namespace camber::app
