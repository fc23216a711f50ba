#pragma once
// What the measuring programs share.
#include <cstdio>
#include <exception>

#include <fmt/format.h>

namespace camber {

/// Runs the body of main(): an error becomes one line on stderr and exit code 2.
template <class Body>
int run_program(const char* name, const Body& body) {
  try {
    return body();
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}: {}\n", name, error.what());
    return 2;
  }
}

}  // namespace camber
