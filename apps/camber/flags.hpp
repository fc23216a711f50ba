#pragma once
// Flags that several verbs have in common.
#include <camber/associate/by_tags.hpp>
#include <camber/io/mesh_file.hpp>

#include <functional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace camber::app {

/// What every verb takes.
struct CommonFlags {
  std::string json;
  int threads = 0;
  bool is_quiet = false, is_verbose = false, no_progress = false;

  [[nodiscard]] bool shows_progress() const;
};

/// A verb of the command line: its flags are parsed into what `run` works on.
struct Verb {
  CLI::App* app = nullptr;
  const CommonFlags* common = nullptr;
  std::function<int()> run;  // gives the exit code
};

void add_common_flags(CLI::App& verb, CommonFlags& flags);

/// --from, --to, --ascii, --msh-version
struct FormatFlags {
  std::string from, to;
  bool is_ascii = false;
  std::string msh_version = "4.1";

  [[nodiscard]] io::ReadOptions reading() const;
  [[nodiscard]] io::WriteOptions writing() const;
};
/// ".msh .cgns ..": what can be read (or written).
[[nodiscard]] std::string extensions(bool reading);
void add_from_flag(CLI::App& verb, FormatFlags& flags);
void add_to_flags(CLI::App& verb, FormatFlags& flags);

/// Mesh length per CAD length (the CAD is read in millimetres); 0: found by comparing boxes.
[[nodiscard]] double scale_of_unit(const std::string& unit);
void add_unit_flag(CLI::App& verb, std::string& unit);
/// --feature-angle, which counts for the kinds of -g that `geometry` names.
void add_feature_angle_flag(CLI::App& verb, const std::string& geometry, double& angle);

/// --patch NAME=RULE
void add_patch_flag(CLI::App& verb, std::vector<std::string>& patches);
/// @throws OptionError for what is no rule and no CAD face
[[nodiscard]] TagOptions association_of(const std::vector<std::string>& patches);

/// The one CAD file of -g. @throws OptionError if there are more
[[nodiscard]] const std::string& only_geometry(const std::vector<std::string>& files);

/// Refuses an output that is also an input, or named twice. @throws OptionError
void refuse_overwriting(const std::vector<std::string>& inputs,
                        const std::vector<std::string>& outputs);

}  // namespace camber::app
