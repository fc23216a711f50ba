// polish_optimum: how near the smoother's patches come to a long-run optimum, by evaluations.
#include <camber/smooth/patch.hpp>
#include <camber/smooth/polish.hpp>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "ladder.hpp"
#include "program.hpp"

namespace camber {
namespace {

using namespace testing;

struct Flags {
  std::vector<std::string> bodies;
  std::vector<double> first_cells{1e-1, 1e-2, 1e-4};
  std::vector<int> orders{2, 3, 4};
  std::vector<int> evaluations{15, 40};
  int long_run = 2000;
  double target = 0.9;
};

/// Energy where `evaluations` leave it; the mesh itself is not touched.
PolishResult polish_copy(const CurvedMesh& curved, const Flags& flags, int evaluations,
                         double tolerance, double& lowest, double& mean) {
  CurvedMesh copy = curved;
  PolishOptions options;
  options.cost_target = flags.target;
  options.max_evaluations = evaluations;
  options.gradient_tolerance = tolerance;
  std::vector<double> costs = cell_costs(copy);
  PolishResult result = polish(copy, free_nodes(copy), costs, options);
  lowest = 1.0, mean = 0.0;
  for (double cost : costs) {
    lowest = std::min(lowest, cost);
    mean += cost / static_cast<double>(costs.size());
  }
  return result;
}

void measure(const BodyCase& body, double first, int order, const Flags& flags) {
  const CurveResult result = curve(body.mesh(first), *body.model(),
                                   curve_options({.first_over_edge = first, .order = order}));
  const CurvedMesh& curved = *result.curved;
  double lowest = 0.0, mean = 0.0;
  const PolishResult best = polish_copy(curved, flags, flags.long_run, 1e-10, lowest, mean);
  if (best.patches == 0) return;
  fmt::print("{:<17}{:<7}{:>6.0e}{:>3}{:>6}{:>6}", body.body, body.filling, first, order,
             best.patches, best.seeds);
  const double reach = best.energy_at_start - best.energy_at_end;
  for (int evaluations : flags.evaluations) {
    double least = 0.0, average = 0.0;
    const PolishResult run =
        polish_copy(curved, flags, evaluations, evaluations < 20 ? 0.05 : 0.0, least, average);
    const double excess = run.energy_at_end - best.energy_at_end;
    fmt::print("{:>10.2f}{:>10.2f}{:>8.3f}{:>8.4f}", 100.0 * excess / best.energy_at_end,
               100.0 * excess / std::max(reach, 1e-300), least, average);
  }
  fmt::print("{:>8.3f}{:>8.4f}{:>8.1f}\n", lowest, mean, 100.0 * reach / best.energy_at_start);
  std::fflush(stdout);
}

int run(const Flags& flags) {
  fmt::print("{:<17}{:<7}{:>6}{:>3}{:>6}{:>6}", "case", "shape", "first", "P", "patch", "seeds");
  for (int evaluations : flags.evaluations) {
    fmt::print("{:>7}: % {:>9}{:>8}{:>8}", evaluations, "% reach", "minC", "meanC");
  }
  fmt::print("{:>8}{:>8}{:>8}\n", "minC*", "meanC*", "gain %");
  for (const BodyCase& body : body_cases(CaseSize::small)) {
    if (!is_wanted(flags.bodies, body.body)) continue;
    for (double first : flags.first_cells) {
      for (int order : flags.orders) measure(body, first, order, flags);
    }
  }
  return 0;
}

int parse_and_run(int argc, char** argv) {
  Flags flags;
  CLI::App app(
      "Polishes the bodies of the ladder from their carried start with few evaluations and with\n"
      "many, and prints by how many per cent the energy of the patches is above the long run's:\n"
      "of that optimum, and of what there was to gain.",
      "polish_optimum");
  app.add_option("--case", flags.bodies, "bodies as in ladder")->delimiter(',');
  app.add_option("--first-cell", flags.first_cells, "heights of the first cell / surface edge")
      ->delimiter(',');
  app.add_option("--order", flags.orders, "orders")->delimiter(',')->check(CLI::Range(2, 4));
  app.add_option("--evaluations", flags.evaluations, "of each patch")->delimiter(',');
  app.add_option("--long-run", flags.long_run, "evaluations of the long run");
  app.add_option("--target", flags.target, "cells with a lowest cost below start a patch");
  CLI11_PARSE(app, argc, argv);
  return run(flags);
}

}  // namespace
}  // namespace camber

int main(int argc, char** argv) {
  return camber::run_program("polish_optimum", [&] { return camber::parse_and_run(argc, argv); });
}
