#pragma once
// One function a verb: adds its subcommand and says how it is run.
#include "flags.hpp"

namespace camber::app {

[[nodiscard]] Verb add_curve(CLI::App& app);
[[nodiscard]] Verb add_associate(CLI::App& app);
[[nodiscard]] Verb add_check(CLI::App& app);
[[nodiscard]] Verb add_info(CLI::App& app);
[[nodiscard]] Verb add_convert(CLI::App& app);
[[nodiscard]] Verb add_report(CLI::App& app);
[[nodiscard]] Verb add_cite(CLI::App& app);

}  // namespace camber::app
