#pragma once
#include <camber/pipeline/report.hpp>

#include <exception>
#include <string>

#include "flags.hpp"

namespace camber::app {

/// Fails at once if the report could not be written in the end.
void check_report_writable(const CommonFlags& flags);
/// Prints the report unless -q, writes it if --json. @return its exit code
int deliver(const Report& report, const CommonFlags& flags);
/// What --json holds when there is no report. Never throws: the error itself is what counts.
void write_error_report(const CommonFlags& flags, const std::string& command,
                        const std::string& message, int exit_code) noexcept;

}  // namespace camber::app
