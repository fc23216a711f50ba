#pragma once
// Work that may crash or eat the machine, tried in a process of its own.
#include <cstddef>
#include <functional>
#include <string>

namespace camber {

struct ChildLimits {
  std::size_t bytes = 0;  // address space the child may take beside what it starts with; 0: any
  int seconds = 0;        // of processor time [s]; 0: any
};

/// Calls `work` in a forked process whose output goes nowhere, and waits for its end. What the work
/// does to memory stays in the child; what it does to files, and what it could do with this user's
/// rights, does not: this guards against damage and exhaustion, not against an attacker.
/// Linux: the child dies with this process.
/// @param subject  file or other thing that is tried, for messages
/// @param cancelled  asked after signals; true ends the child
/// @throws what `work` throws of Error; FileError naming `subject` if the child crashed, reached a
///         limit or could not be started; Cancelled
/// Threads: only while the process has no other thread; a fork copies this one alone, and locks
/// that others hold would stay locked in the child.
void try_in_child(const std::string& subject, const ChildLimits& limits,
                  const std::function<void()>& work, const std::function<bool()>& cancelled = {});

}  // namespace camber
