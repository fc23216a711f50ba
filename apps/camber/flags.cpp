#include "flags.hpp"

#include <camber/base/error.hpp>

#include <filesystem>
#include <map>

#include "console.hpp"

namespace camber::app {
namespace {

io::Format format_called(const std::string& name) {
  for (const io::FormatInfo& info : io::formats()) {
    if (info.name == name) return info.format;
  }
  return io::Format::automatic;
}

/// Names of the formats that can be read (or written).
std::vector<std::string> format_names(bool reading) {
  std::vector<std::string> names;
  for (const io::FormatInfo& info : io::formats()) {
    if (reading ? info.reads : info.writes) names.emplace_back(info.name);
  }
  return names;
}

}  // namespace

std::string extensions(bool reading) {
  std::string list;
  for (const io::FormatInfo& info : io::formats()) {
    if (!(reading ? info.reads : info.writes)) continue;
    list += (list.empty() ? "" : " ") + std::string(info.extensions);
  }
  return list;
}

bool CommonFlags::shows_progress() const {
  return !is_quiet && !no_progress && stderr_is_terminal();
}

void add_common_flags(CLI::App& verb, CommonFlags& flags) {
  verb.add_option("--json", flags.json, "also write the report to this file, as JSON")
      ->type_name("FILE");
  verb.add_option("--threads", flags.threads, "threads to work with; 0: all of the machine")
      ->check(CLI::NonNegativeNumber)
      ->type_name("N")
      ->capture_default_str();
  verb.add_flag("-q,--quiet", flags.is_quiet, "no report on the terminal");
  verb.add_flag("-v,--verbose", flags.is_verbose, "log what is done to stderr");
  verb.add_flag("--no-progress", flags.no_progress,
                "no progress line (it is only shown on a terminal)");
}

io::ReadOptions FormatFlags::reading() const { return {.format = format_called(from)}; }

io::WriteOptions FormatFlags::writing() const {
  io::WriteOptions options;
  options.format = format_called(to);
  options.binary = !is_ascii;
  options.gmsh_version = msh_version == "2.2" ? 2.2 : 4.1;
  return options;
}

void add_from_flag(CLI::App& verb, FormatFlags& flags) {
  verb.add_option("--from", flags.from, "format of the mesh read; default: by its extension")
      ->check(CLI::IsMember(format_names(true)))
      ->type_name("FORMAT");
}

void add_to_flags(CLI::App& verb, FormatFlags& flags) {
  verb.add_option("--to", flags.to, "format of the mesh written; default: by its extension")
      ->check(CLI::IsMember(format_names(false)))
      ->type_name("FORMAT");
  verb.add_flag("--ascii", flags.is_ascii, "write text; default: binary");
  verb.add_option("--msh-version", flags.msh_version, "version of the Gmsh format written")
      ->check(CLI::IsMember({"4.1", "2.2"}))
      ->type_name("VERSION")
      ->capture_default_str();
}

double scale_of_unit(const std::string& unit) {
  static const std::map<std::string, double> scales{
      {"auto", 0.0}, {"mm", 1.0}, {"m", 1e-3}, {"in", 1.0 / 25.4}};
  return scales.at(unit);
}

void add_unit_flag(CLI::App& verb, std::string& unit) {
  verb.add_option("--unit", unit,
                  "unit of the mesh's lengths; auto: the one in which mesh and CAD fit")
      ->check(CLI::IsMember({"auto", "m", "mm", "in"}))
      ->type_name("UNIT")
      ->capture_default_str();
}

void add_feature_angle_flag(CLI::App& verb, const std::string& geometry, double& angle) {
  verb.add_option("--feature-angle", angle,
                  geometry +
                      ": edges between faces turned by more stay sharp, chains of them have a "
                      "corner where they turn by more [degrees]")
      ->check(CLI::Range(1.0, 179.0))
      ->type_name("ANGLE")
      ->capture_default_str();
}

const std::string& only_geometry(const std::vector<std::string>& files) {
  if (files.size() != 1) {
    throw OptionError("one CAD file is taken for now, " + std::to_string(files.size()) + " given",
                      "--geometry", "join them in one STEP file");
  }
  if (files.front() == "auto") {
    throw OptionError("a geometry made from the mesh itself is for camber curve alone",
                      "--geometry auto", "give the CAD file");
  }
  return files.front();
}

void refuse_overwriting(const std::vector<std::string>& inputs,
                        const std::vector<std::string>& outputs) {
  namespace fs = std::filesystem;
  const auto same = [](const std::string& a, const std::string& b) {
    std::error_code failed;
    return fs::weakly_canonical(a, failed) == fs::weakly_canonical(b, failed) ||
           fs::equivalent(a, b, failed);
  };
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    for (const std::string& input : inputs) {
      if (same(outputs[i], input)) {
        throw OptionError("the output would replace an input", outputs[i], "give another name");
      }
    }
    for (std::size_t k = 0; k < i; ++k) {
      if (same(outputs[i], outputs[k])) {
        throw OptionError("two outputs have the same name", outputs[i], "give another name");
      }
    }
  }
}

}  // namespace camber::app
