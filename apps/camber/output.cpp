#include "output.hpp"

#include <camber/base/error.hpp>
#include <camber/pipeline/text_report.hpp>
#include <camber/pipeline/version.hpp>

#include <nlohmann/json.hpp>

#include "console.hpp"

namespace camber::app {

void check_report_writable(const CommonFlags& flags) {
  // A stated format: the name may have any extension.
  if (!flags.json.empty()) io::check_writable(flags.json, {.format = io::Format::gmsh});
}

int deliver(const Report& report, const CommonFlags& flags) {
  if (!flags.is_quiet) print(text_report(report));
  if (!flags.json.empty()) io::write_text(flags.json, json_report(report));
  return report.exit_code;
}

void write_error_report(const CommonFlags& flags, const std::string& command,
                        const std::string& message, int exit_code) noexcept {
  if (flags.json.empty()) return;
  try {
    nlohmann::ordered_json json;
    json["camber"] = {{"version", version()}};
    json["command"] = command;
    json["status"] = "error";
    json["exit_code"] = exit_code;
    json["error"] = message;
    io::write_text(
        flags.json,
        json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  } catch (...) {  // the first error has been told; this one is mostly the same again
  }
}

}  // namespace camber::app
