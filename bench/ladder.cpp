// ladder: bodies with thin layers x first cell x order x start x smoother, as a table.
#include "ladder.hpp"

#include <camber/base/error.hpp>
#include <camber/base/parallel.hpp>
#include <camber/pipeline/text_table.hpp>

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "program.hpp"

namespace camber {
namespace {

using namespace testing;

struct Flags {
  std::vector<std::string> bodies, fillings;
  std::vector<double> first_cells{1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7};
  std::vector<int> orders{2, 3, 4};
  std::vector<Propagation> starts{Propagation::layer, Propagation::cell};
  std::vector<Smoothing> smoothers{Smoothing::none, Smoothing::automatic, Smoothing::marching};
  CaseSize size = CaseSize::small;
  int threads = 1;
  bool is_bad_only = false;
  std::string csv, json;
};

/// A column of the results: how wide it is printed, and how a row is shown in it.
struct Column {
  const char* name;
  int width;
  std::function<std::string(const LadderRow&)> text;
};

std::vector<Column> columns() {
  using Row = LadderRow;
  const auto count = [](const char* name, auto member) -> Column {
    return {name, 8, [=](const Row& row) { return fmt::format("{}", row.*member); }};
  };
  const auto number = [](const char* name, const char* format, auto value) -> Column {
    return {name, 9, [=](const Row& row) { return fmt::format(fmt::runtime(format), value(row)); }};
  };
  return {
      {"case", 16, [](const Row& row) { return row.body; }},
      {"shape", 6, [](const Row& row) { return row.filling; }},
      number("first", "{:.0e}", [](const Row& row) { return row.settings.first_over_edge; }),
      {"order", 5, [](const Row& row) { return fmt::format("{}", row.settings.order); }},
      {"start", 7, [](const Row& row) { return std::string(name_of(row.settings.start)); }},
      {"smooth", 8, [](const Row& row) { return std::string(name_of(row.settings.smoothing)); }},
      count("cells", &Row::cells),
      count("bad", &Row::invalid_at_start),
      count("bad_end", &Row::invalid_at_end),
      count("patches", &Row::patches),
      count("slid", &Row::smoothed_faces),
      count("lowered", &Row::lowered),
      count("scaled", &Row::scaled_back),
      count("iters", &Row::iterations),
      count("products", &Row::products),
      number("certify_s", "{:.3f}", [](const Row& row) { return row.certify_s; }),
      number("rescue_s", "{:.3f}", [](const Row& row) { return row.rescue_s; }),
      number("smooth_s", "{:.3f}", [](const Row& row) { return row.smooth_s; }),
      number("s_per_1000", "{:.4f}", [](const Row& row) { return row.seconds_per_1000(); }),
      number("minC_0", "{:.3g}", [](const Row& row) { return row.start.minimum; }),
      number("minC", "{:.4f}", [](const Row& row) { return row.end.minimum; }),
      number("meanC_0", "{:.4g}", [](const Row& row) { return row.start.mean; }),
      number("meanC", "{:.4f}", [](const Row& row) { return row.end.mean; }),
      number("min_ratio", "{:.3g}", [](const Row& row) { return row.min_jacobian_ratio; }),
      {"error", 0, [](const Row& row) { return row.error; }}};
}

std::vector<std::string> cells_of(const LadderRow& row) {
  std::vector<std::string> cells;
  for (const Column& column : columns()) cells.push_back(column.text(row));
  return cells;
}

std::vector<std::string> headings() {
  std::vector<std::string> names;
  for (const Column& column : columns()) names.emplace_back(column.name);
  return names;
}

/// A result file that is complete up to the last row measured, however the run ends.
void write(std::ofstream& file, const std::string& path, const std::string& text) {
  if (!(file << text).flush()) {
    throw FileError("cannot write the results", path, "give a path in a folder you may write to");
  }
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string text;
  for (const std::string& cell : cells) {
    std::string quoted = cell;
    if (cell.find_first_of(",\"\n") != std::string::npos) {
      quoted = "\"";
      for (char c : cell) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
      quoted += '"';
    }
    text += (text.empty() ? "" : ",") + quoted;
  }
  return text + "\n";
}

void print(const std::vector<std::string>& cells) {
  std::string line;
  std::size_t i = 0;
  for (const Column& column : columns()) {
    line += i < 2 ? fmt::format("{:<{}} ", cells[i], column.width)
                  : fmt::format("{:>{}} ", cells[i], column.width);
    ++i;
  }
  fmt::print("{}\n", line);
  std::fflush(stdout);
}

std::string json_of(const std::vector<LadderRow>& rows) {
  nlohmann::ordered_json all = nlohmann::ordered_json::array();
  for (const LadderRow& row : rows) {
    all.push_back({{"case", row.body},
                   {"shape", row.filling},
                   {"first_cell", row.settings.first_over_edge},
                   {"order", row.settings.order},
                   {"start", name_of(row.settings.start)},
                   {"smooth", name_of(row.settings.smoothing)},
                   {"cells", row.cells},
                   {"invalid_start", row.invalid_at_start},
                   {"invalid_end", row.invalid_at_end},
                   {"patches", row.patches},
                   {"faces_smoothed", row.smoothed_faces},
                   {"lowered", row.lowered},
                   {"scaled_back", row.scaled_back},
                   {"iterations", row.iterations},
                   {"products", row.products},
                   {"certify_cpu_s", row.certify_s},
                   {"rescue_cpu_s", row.rescue_s},
                   {"smooth_cpu_s", row.smooth_s},
                   {"min_cost_start", row.start.minimum},
                   {"min_cost_end", row.end.minimum},
                   {"mean_cost_start", row.start.mean},
                   {"mean_cost_end", row.end.mean},
                   {"min_jacobian_ratio", row.min_jacobian_ratio},
                   {"error", row.error}});
  }
  return all.dump(1) + "\n";
}

std::vector<LadderRow> measure(const Flags& flags,
                               const std::function<void(const LadderRow&)>& tell) {
  std::vector<LadderRow> rows;
  for (const BodyCase& body : body_cases(flags.size)) {
    if (!is_wanted(flags.bodies, body.body) || !is_wanted(flags.fillings, body.filling)) continue;
    for (double first : flags.first_cells) {
      for (int order : flags.orders) {
        for (Propagation start : flags.starts) {
          for (Smoothing smoother : flags.smoothers) {
            rows.push_back(climb_ladder(body, {first, order, start, smoother}));
            tell(rows.back());
          }
        }
      }
    }
  }
  return rows;
}

/// One line of totals for each start and smoother.
std::string summary(const std::vector<LadderRow>& rows, const Flags& flags) {
  TextTable table;
  table.add({"start, smooth", "runs", "certified", "rescued", "scaled back", "cells",
             "bad at start", "s per 1000"});
  for (Propagation start : flags.starts) {
    for (Smoothing smoother : flags.smoothers) {
      std::size_t runs = 0, certified = 0, rescued = 0, scaled = 0, cells = 0, bad = 0;
      double seconds = 0.0;
      for (const LadderRow& row : rows) {
        if (row.settings.start != start || row.settings.smoothing != smoother) continue;
        ++runs;
        certified += row.is_certified() ? 1U : 0U;
        rescued += row.is_rescued() ? 1U : 0U;
        scaled += row.scaled_back > 0 ? 1U : 0U;
        cells += row.cells;
        bad += row.invalid_at_start;
        seconds += row.certify_s + row.rescue_s + row.smooth_s;
      }
      table.add({fmt::format("{}, {}", name_of(start), name_of(smoother)), fmt::format("{}", runs),
                 fmt::format("{}", certified), fmt::format("{}", rescued),
                 fmt::format("{}", scaled), fmt::format("{}", cells), fmt::format("{}", bad),
                 fmt::format("{:.4f}", 1000.0 * seconds /
                                           static_cast<double>(std::max<std::size_t>(cells, 1)))});
    }
  }
  return table.text();
}

int run(const Flags& flags) {
  const ThreadLimit limit(flags.threads);
  std::ofstream csv, json;
  if (!flags.csv.empty()) {
    csv.open(flags.csv);
    write(csv, flags.csv, csv_line(headings()));
  }
  if (!flags.json.empty()) {
    json.open(flags.json);
    write(json, flags.json, "");
  }
  print(headings());
  const std::vector<LadderRow> rows = measure(flags, [&](const LadderRow& row) {
    if (csv.is_open()) write(csv, flags.csv, csv_line(cells_of(row)));
    if (!flags.is_bad_only || !row.is_certified() || row.is_rescued()) print(cells_of(row));
  });
  fmt::print("\n{}", summary(rows, flags));
  if (json.is_open()) write(json, flags.json, json_of(rows));
  const bool is_good = std::all_of(rows.begin(), rows.end(),
                                   [](const LadderRow& row) { return row.is_certified(); });
  return is_good ? 0 : 1;
}

int parse_and_run(int argc, char** argv) {
  Flags flags;
  CLI::App app(
      "Curves analytic bodies with thin layers, every cell at one order, and prints what was\n"
      "invalid, what it took and what it cost. CPU seconds are those of certification, rescue and\n"
      "smoothing. Exit code 1 if anything ends without certificate.",
      "ladder");
  app.add_option("--case", flags.bodies,
                 "sphere, ellipsoid, wing, bump, torus-inside, ellipsoid-inside, tip, corner")
      ->delimiter(',');
  app.add_option("--shape", flags.fillings, "prisms, hexes, tets, caps")->delimiter(',');
  app.add_option("--first-cell", flags.first_cells, "heights of the first cell / surface edge")
      ->delimiter(',');
  app.add_option("--order", flags.orders, "orders")
      ->delimiter(',')
      ->check(CLI::Range(2, k_max_order));
  app.add_option("--start", flags.starts,
                 "carried (through the layers), elastic (a linear solve), cell (wall cells alone)")
      ->delimiter(',')
      ->transform(CLI::CheckedTransformer(
          std::vector<std::pair<std::string, Propagation>>{{"carried", Propagation::layer},
                                                           {"elastic", Propagation::elastic},
                                                           {"cell", Propagation::cell}}));
  app.add_option("--smooth", flags.smoothers, "none, auto, marching")
      ->delimiter(',')
      ->transform(CLI::CheckedTransformer(
          std::vector<std::pair<std::string, Smoothing>>{{"none", Smoothing::none},
                                                         {"auto", Smoothing::automatic},
                                                         {"marching", Smoothing::marching}}));
  app.add_option("--size", flags.size, "small or full")
      ->transform(CLI::CheckedTransformer(std::vector<std::pair<std::string, CaseSize>>{
          {"small", CaseSize::small}, {"full", CaseSize::full}}));
  app.add_option("--threads", flags.threads, "threads (0: all)")->check(CLI::NonNegativeNumber);
  app.add_flag("--bad", flags.is_bad_only, "print only rows with a rescue or without certificate");
  app.add_option("--csv", flags.csv, "write all rows here as they come");
  app.add_option("--json", flags.json, "write all rows here at the end");
  CLI11_PARSE(app, argc, argv);
  return run(flags);
}

}  // namespace
}  // namespace camber

int main(int argc, char** argv) {
  return camber::run_program("ladder", [&] { return camber::parse_and_run(argc, argv); });
}
