// camber info: what is in a mesh or CAD file.
#include "info.hpp"

#include <camber/base/error.hpp>
#include <camber/pipeline/version.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <memory>

#include <fmt/format.h>

#include "console.hpp"
#include "isolation.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace camber::app {
namespace {

struct InfoFlags {
  CommonFlags common;
  FormatFlags format;
  IsolationFlags isolation;
  std::string file, unit = "mm";
  bool lists_formats = false;
};

bool is_cad(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array<const char*, 5> cad{".step", ".stp", ".iges", ".igs", ".brep"};
  return std::find(cad.begin(), cad.end(), extension) != cad.end();
}

int run(const InfoFlags& flags) {
  if (flags.lists_formats) {
    print(io::format_table());
    return 0;
  }
  if (flags.file.empty()) {
    throw OptionError("no file given", "camber info", "name a mesh or a CAD file, or --formats");
  }
  ProgressLine line(flags.common.shows_progress());
  line.show("read", 0.0);
  const bool shows_cad = is_cad(flags.file);
  if (shows_cad) try_inputs(flags.isolation, "", {}, {flags.file});
  if (!shows_cad) try_inputs(flags.isolation, flags.file, flags.format.reading(), {});
  const double scale = scale_of_unit(flags.unit);
  const Info info =
      shows_cad ? cad_info(flags.file, scale) : mesh_info(flags.file, flags.format.reading());
  stop_if_interrupted();
  line.clear();
  if (!flags.common.is_quiet) print(info.text);
  if (!flags.common.json.empty()) {
    nlohmann::ordered_json json;
    json["camber"] = {{"version", version()}};
    json["command"] = "info";
    json["status"] = "ok";
    json["exit_code"] = 0;
    json.update(info.json);
    io::write_text(
        flags.common.json,
        json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  }
  return 0;
}

}  // namespace

std::string box_text(const Box& box) {
  if (box.is_empty()) return "none";
  return fmt::format("({:.5g}, {:.5g}, {:.5g}) to ({:.5g}, {:.5g}, {:.5g})", box.lower.x(),
                     box.lower.y(), box.lower.z(), box.upper.x(), box.upper.y(), box.upper.z());
}

nlohmann::ordered_json box_json(const Box& box) {
  if (box.is_empty()) return nullptr;
  return {{"lower", {box.lower.x(), box.lower.y(), box.lower.z()}},
          {"upper", {box.upper.x(), box.upper.y(), box.upper.z()}}};
}

Verb add_info(CLI::App& app) {
  const auto flags = std::make_shared<InfoFlags>();
  CLI::App* verb = app.add_subcommand(
      "info", "what is in a mesh or CAD file: counts, patches, boxes, names, faces");
  verb->add_option("file", flags->file,
                   "mesh (" + extensions(true) + ") or CAD (.step .stp .iges .igs .brep)")
      ->type_name("MESH|CAD");
  verb->add_flag("--formats", flags->lists_formats,
                 "list the mesh formats: orders, what they keep, which solvers take them");
  verb->add_option("--unit", flags->unit, "unit that CAD lengths are shown in")
      ->check(CLI::IsMember({"m", "mm", "in"}))
      ->type_name("UNIT")
      ->capture_default_str();
  add_isolation_flags(*verb, flags->isolation);
  add_from_flag(*verb, flags->format);
  add_common_flags(*verb, flags->common);
  return {verb, &flags->common, [flags] { return run(*flags); }};
}

}  // namespace camber::app
