// camber convert: formats and exact elevation; no node is ever projected again.
#include <camber/base/error.hpp>
#include <camber/mesh/elevate_data.hpp>
#include <camber/pipeline/check.hpp>
#include <camber/pipeline/version.hpp>

#include <map>
#include <memory>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "console.hpp"
#include "isolation.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace camber::app {
namespace {

struct ConvertFlags {
  CommonFlags common;
  FormatFlags format;
  IsolationFlags isolation;
  std::string input, output;
  int order = 0;
  bool keep = false;
};

std::map<int, std::size_t> cells_by_order(const MeshData& mesh) {
  std::map<int, std::size_t> counts;
  for (const ElementBlock& block : mesh.blocks) {
    if (dimension(block.shape) == 3) counts[block.order] += block.size();
  }
  return counts;
}

std::string text(const std::map<int, std::size_t>& counts) {
  std::string out;
  for (const auto& [order, count] : counts) {
    out += fmt::format("{}{} Q{}", out.empty() ? "" : ", ", count, order);
  }
  return out.empty() ? "no cells" : out;
}

int run(const ConvertFlags& flags) {
  refuse_overwriting({flags.input}, {flags.output});
  io::check_writable(flags.output, flags.format.writing());
  ProgressLine line(flags.common.shows_progress());
  line.show("read", 0.0);
  try_inputs(flags.isolation, flags.input, flags.format.reading(), {});
  MeshData mesh = io::read_mesh(flags.input, flags.format.reading());
  stop_if_interrupted();
  const std::map<int, std::size_t> before = cells_by_order(mesh);
  line.show("convert", 0.4);
  if (flags.order > 0) mesh = at_order(mesh, flags.order);
  const int raised = io::raised_order(mesh, flags.output, flags.format.writing());
  if (raised > 0) mesh = at_order(mesh, raised);
  const std::map<int, std::size_t> after = cells_by_order(mesh);
  stop_if_interrupted();
  line.show("write", 0.7);
  io::write_mesh(mesh, flags.output, flags.format.writing(), [&](const MeshData& read_back) {
    stop_if_interrupted();
    verify_written(mesh, read_back, false);
    stop_if_interrupted();
  });
  line.clear();
  if (!flags.common.is_quiet) {
    print(fmt::format("{}: {}\n{}: {}, {} nodes{}\n", flags.input, text(before), flags.output,
                      text(after), mesh.points.size(),
                      raised > 0 ? " (this format holds one order: all raised exactly)" : ""));
  }
  if (!flags.common.json.empty()) {
    nlohmann::ordered_json json;
    json["camber"] = {{"version", version()}};
    json["command"] = "convert";
    json["status"] = "ok";
    json["exit_code"] = 0;
    json["input"] = {{"mesh", flags.input}};
    json["output"] = {{"path", flags.output}, {"nodes", mesh.points.size()}};
    for (const auto& [order, count] : before) {
      json["input"]["cells_by_order"][std::to_string(order)] = count;
    }
    for (const auto& [order, count] : after) {
      json["output"]["cells_by_order"][std::to_string(order)] = count;
    }
    io::write_text(flags.common.json, json.dump(2) + "\n");
  }
  return 0;
}

}  // namespace

Verb add_convert(CLI::App& app) {
  const auto flags = std::make_shared<ConvertFlags>();
  CLI::App* verb = app.add_subcommand(
      "convert", "another format, or the same polynomial shapes at a higher order");
  verb->add_option("input", flags->input, "mesh to read (" + extensions(true) + ")")
      ->required()
      ->type_name("IN");
  verb->add_option("output", flags->output, "mesh to write (" + extensions(false) + ")")
      ->required()
      ->type_name("OUT");
  CLI::Option* order =
      verb->add_option("--order", flags->order,
                       "every element at this order: the same shape where it is lower now; 1 takes "
                       "the corners only; default: as --keep [-]")
          ->check(CLI::Range(1, k_max_order))
          ->type_name("ORDER");
  verb->add_flag("--keep", flags->keep, "every element keeps its order (default)")->excludes(order);
  add_isolation_flags(*verb, flags->isolation);
  add_from_flag(*verb, flags->format);
  add_to_flags(*verb, flags->format);
  add_common_flags(*verb, flags->common);
  return {verb, &flags->common, [flags] { return run(*flags); }};
}

}  // namespace camber::app
