#include "console.hpp"

#include <algorithm>
#include <csignal>
#include <cstdio>
#include <sys/resource.h>
#include <unistd.h>

#include <fmt/format.h>

namespace camber::app {
namespace {

volatile std::sig_atomic_t signal_received = 0;

void remember(int signal) { signal_received = signal; }

}  // namespace

void print(std::string_view text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

void print_error(std::string_view message) {
  std::string line(message);
  std::replace_if(
      line.begin(), line.end(), [](char c) { return c == '\n' || c == '\r'; }, ' ');
  fmt::print(stderr, "camber: error: {}\n", line);
}

void catch_interrupts() {
  struct sigaction action {};
  action.sa_handler = remember;
  action.sa_flags = static_cast<int>(SA_RESETHAND);
  for (const int signal : {SIGINT, SIGTERM}) sigaction(signal, &action, nullptr);
}

int interrupted() { return signal_received; }

void stop_if_interrupted() {
  if (interrupted() != 0) throw Cancelled{};
}

ProgressLine::~ProgressLine() { clear(); }

void ProgressLine::show(std::string_view stage, double fraction) {
  if (!is_shown_) return;
  rewrite(fmt::format("[{:3.0f} %] {}", 100.0 * fraction, stage));
}

void ProgressLine::show(std::string_view stage, const IterationState& state) {
  if (!is_shown_) return;
  rewrite(fmt::format("{} {}: {} nodes active, {} elements negative, worst cost {:.3g}", stage,
                      state.iteration, state.active_nodes, state.negative_elements,
                      state.worst_cost));
}

void ProgressLine::rewrite(const std::string& text) {
  fmt::print(stderr, "\r{:<{}}", text, width_);
  std::fflush(stderr);
  width_ = text.size();
}

void ProgressLine::clear() {
  if (width_ == 0) return;
  fmt::print(stderr, "\r{:{}}\r", "", width_);
  std::fflush(stderr);
  width_ = 0;
}

Progress ProgressLine::progress() {
  return {[this](std::string_view stage, double fraction) { show(stage, fraction); },
          [] { return interrupted() != 0; },
          [this](std::string_view stage, const IterationState& state) { show(stage, state); }};
}

bool stderr_is_terminal() { return isatty(STDERR_FILENO) == 1; }

std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;  // Linux counts in KiB
}

}  // namespace camber::app
