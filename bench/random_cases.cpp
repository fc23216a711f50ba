// random_cases: random hybrid layers on random walls; all must end certified.
#include <camber/base/error.hpp>
#include <camber/base/parallel.hpp>

#include <cstdio>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "ladder.hpp"
#include "program.hpp"
#include "random_wall.hpp"

namespace camber {
namespace {

using namespace testing;

struct Flags {
  std::uint32_t first = 1, count = 200;
  Propagation start = Propagation::layer;
  Smoothing smoothing = Smoothing::none;
  int threads = 0;
  bool is_verbose = false;
};

struct Totals {
  std::size_t cells = 0, failed = 0, rescued = 0, scaled = 0;
};

void run_one(std::uint32_t seed, const Flags& flags, Totals& totals) {
  RandomCase random = random_case(seed);
  random.options.propagation = flags.start;
  random.options.smoothing = flags.smoothing;
  LadderRow row;
  try {
    read_result(curve(random.mesh, *random.model, random.options), row);
  } catch (const Error& error) {
    row.error = error.what();
  }
  totals.cells += row.cells;
  totals.failed += row.is_certified() ? 0U : 1U;
  totals.rescued += row.is_rescued() ? 1U : 0U;
  totals.scaled += row.scaled_back > 0 ? 1U : 0U;
  if (row.is_certified() && !row.is_rescued() && !flags.is_verbose) return;
  fmt::print(
      "{}\n  {}: {} cells, {} not certified, {} patches mended, {} faces slid, {} lowered, "
      "{} scaled back, lowest C {:.4f}{}{}\n",
      random.text(), row.is_certified() ? "certified" : "FAILED", row.cells, row.invalid_at_end,
      row.patches, row.smoothed_faces, row.lowered, row.scaled_back, row.end.minimum,
      row.error.empty() ? "" : "\n  ", row.error);
  std::fflush(stdout);
}

int parse_and_run(int argc, char** argv) {
  Flags flags;
  CLI::App app(
      "Curves random hybrid layers on random B-spline walls, one for each seed, and lists those\n"
      "that were rescued or failed. Exit code 1 if a cell of any is not certified.",
      "random_cases");
  app.add_option("--seeds", flags.count, "how many");
  app.add_option("--first-seed", flags.first, "the first of them");
  app.add_option("--start", flags.start, "carried, elastic or cell")
      ->transform(CLI::CheckedTransformer(
          std::vector<std::pair<std::string, Propagation>>{{"carried", Propagation::layer},
                                                           {"elastic", Propagation::elastic},
                                                           {"cell", Propagation::cell}}));
  app.add_option("--smooth", flags.smoothing, "none, auto or marching")
      ->transform(CLI::CheckedTransformer(
          std::vector<std::pair<std::string, Smoothing>>{{"none", Smoothing::none},
                                                         {"auto", Smoothing::automatic},
                                                         {"marching", Smoothing::marching}}));
  app.add_option("--threads", flags.threads, "threads (0: all)")->check(CLI::NonNegativeNumber);
  app.add_flag("-v,--verbose", flags.is_verbose, "list every seed");
  CLI11_PARSE(app, argc, argv);
  const ThreadLimit limit(flags.threads);
  Totals totals;
  for (std::uint32_t i = 0; i < flags.count; ++i) run_one(flags.first + i, flags, totals);
  fmt::print("{} cases, {} cells: {} certified, {} rescued, {} of them scaled back, {} failed\n",
             flags.count, totals.cells, flags.count - totals.failed, totals.rescued, totals.scaled,
             totals.failed);
  return totals.failed == 0 ? 0 : 1;
}

}  // namespace
}  // namespace camber

int main(int argc, char** argv) {
  return camber::run_program("random_cases", [&] { return camber::parse_and_run(argc, argv); });
}
