#pragma once
#include <camber/pipeline/report.hpp>

#include <string>

namespace camber {

/// The report as people read it on a terminal (80 to 100 columns, units and tolerances stated).
[[nodiscard]] std::string text_report(const Report& report);
/// The report as JSON, keys as documented in docs/report.md, stable from release to release.
[[nodiscard]] std::string json_report(const Report& report);

}  // namespace camber
