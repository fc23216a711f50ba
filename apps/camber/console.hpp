#pragma once
// What goes to the terminal, and Ctrl-C.
#include <camber/base/progress.hpp>

#include <string>
#include <string_view>

namespace camber::app {

/// Results, to stdout.
void print(std::string_view text);
/// One line on stderr: "camber: error: ...".
void print_error(std::string_view message);

/// From now on the first SIGINT or SIGTERM only sets a flag (the second one kills as usual).
void catch_interrupts();
/// The signal that came, or 0.
[[nodiscard]] int interrupted();
/// Throws Cancelled if a signal came.
void stop_if_interrupted();

/// One line on stderr that is rewritten as the work goes on; removed at the end of its life.
class ProgressLine {
 public:
  explicit ProgressLine(bool is_shown) : is_shown_(is_shown) {}
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  void show(std::string_view stage, double fraction);
  void show(std::string_view stage, const IterationState& state);
  void clear();
  /// To pass into long calls: shows stages, and cancels when a signal came. Must not outlive this.
  [[nodiscard]] Progress progress();

 private:
  void rewrite(const std::string& text);

  bool is_shown_;
  std::size_t width_ = 0;  // of what is on the terminal now
};

/// True if stderr is a terminal.
[[nodiscard]] bool stderr_is_terminal();
/// Most memory this process has held so far.
[[nodiscard]] std::size_t peak_memory();

}  // namespace camber::app
