// camber: curves linear meshes onto their CAD, checks and converts curved ones.
#include <camber/base/error.hpp>
#include <camber/base/log.hpp>
#include <camber/base/parallel.hpp>
#include <camber/pipeline/version.hpp>

#include <new>

#include <fmt/format.h>

#include "console.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace camber::app {
namespace {

constexpr int k_usage = 1, k_input = 2, k_bug = 4;
constexpr int k_signal = 128;  // plus the number of the signal, as shells count

int fail(const Verb& verb, const std::string& message, int exit_code) {
  print_error(message);
  write_error_report(*verb.common, verb.app->get_name(), message, exit_code);
  return exit_code;
}

int run(const Verb& verb) {
  try {
    if (verb.common->is_verbose) enable_stderr_log(LogLevel::debug);
    const ThreadLimit limit(verb.common->threads);
    check_report_writable(*verb.common);
    return verb.run();
  } catch (const OptionError& error) {
    return fail(verb, error.what(), k_usage);
  } catch (const Error& error) {
    return fail(verb, error.what(), k_input);
  } catch (const Cancelled&) {
    return fail(verb, "stopped; nothing was left half written", k_signal + interrupted());
  } catch (const std::bad_alloc&) {
    return fail(verb, "out of memory; use a machine with more, or a smaller mesh", k_input);
  } catch (const std::exception& error) {
    return fail(verb,
                fmt::format("unexpected: {} (this is a bug in camber {}: please report it with the "
                            "command line and the files)",
                            error.what(), version()),
                k_bug);
  }
}

int parse_and_run(int argc, char** argv) {
  CLI::App app(
      "Curves a linear hybrid mesh onto its CAD: mixed orders Q1 to Q4, every element "
      "certified.\nExit codes: 0 done, 1 usage, 2 input unreadable or unusable, 3 done but not "
      "certified,\nnot watertight or not on the CAD, 4 bug, 130 interrupted.",
      "camber");
  app.require_subcommand(0, 1);
  const std::string version_line = fmt::format("camber {}", version());
  app.set_version_flag("--version", version_line);
  const std::vector<Verb> verbs{add_curve(app),   add_associate(app), add_check(app), add_info(app),
                                add_convert(app), add_report(app),    add_cite(app)};
  for (const Verb& verb : verbs) verb.app->set_version_flag("--version", version_line);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& wanted) {  // --help, --version
    return app.exit(wanted);
  } catch (const CLI::ParseError& error) {
    print_error(fmt::format(
        "{} (see: camber {}--help)", error.what(),
        app.get_subcommands().empty() ? "" : app.get_subcommands().front()->get_name() + " "));
    return k_usage;
  }
  catch_interrupts();
  for (const Verb& verb : verbs) {
    if (verb.app->parsed()) return run(verb);
  }
  print_error(
      "a verb is needed: curve, associate, check, info, convert, report or cite (see: camber "
      "--help)");
  return k_usage;
}

}  // namespace
}  // namespace camber::app

int main(int argc, char** argv) {
  try {
    return camber::app::parse_and_run(argc, argv);
  } catch (const std::exception& error) {
    camber::app::print_error(
        fmt::format("unexpected: {} (this is a bug in camber: please report it)", error.what()));
    return 4;
  }
}
