#pragma once
#include <string_view>

namespace camber {

enum class LogLevel { debug, info, warning, error };

/// Sends a line to the one logger named "camber"; silent until a program sets a sink
/// (enable_stderr_log). The library itself never prints.
void log(LogLevel level, std::string_view message);

/// For programs: log lines at or above `level` go to stderr.
void enable_stderr_log(LogLevel level);

}  // namespace camber
