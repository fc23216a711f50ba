// camber check: certificates, gaps, quality and surface error of any mesh.
#include <camber/associate/cad_scale.hpp>
#include <camber/base/error.hpp>
#include <camber/geom_occ/cad_file.hpp>
#include <camber/pipeline/check.hpp>
#include <camber/pipeline/geometry_source.hpp>

#include <chrono>
#include <memory>

#include <fmt/format.h>

#include "console.hpp"
#include "isolation.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace camber::app {
namespace {

struct CheckFlags {
  CommonFlags common;
  FormatFlags format;
  IsolationFlags isolation;
  CheckOptions options;
  std::string mesh, unit = "auto";
  std::vector<std::string> geometry;
};

int run(const CheckFlags& flags) {
  ProgressLine line(flags.common.shows_progress());
  const auto start = std::chrono::steady_clock::now();
  line.show("read", 0.0);
  try_inputs(flags.isolation, flags.mesh, flags.format.reading(), flags.geometry);
  const MeshData mesh = io::read_mesh(flags.mesh, flags.format.reading());
  stop_if_interrupted();
  std::unique_ptr<GeometryModel> geometry;
  double scale = 1.0;
  if (!flags.geometry.empty()) {
    const std::string& source = only_geometry(flags.geometry);
    if (is_geometry_without_cad(source)) {
      throw OptionError("check measures patches by the CAD faces that their tags name, and '" +
                            source + "' has no such faces",
                        "--geometry",
                        "give a CAD file, or leave it out and look at the deviation with "
                        "camber report -g " +
                            source);
    }
    geometry = read_cad(source);
    scale = fit_cad_scale(mesh, *geometry, scale_of_unit(flags.unit));
  }
  stop_if_interrupted();
  const std::chrono::duration<double> reading = std::chrono::steady_clock::now() - start;
  line.show("check", 0.2);
  Report report = check(mesh, geometry.get(), flags.options);
  stop_if_interrupted();
  report.input.geometry = flags.geometry;
  if (geometry) {
    report.options = {{"deviation", fmt::format("{:g}", flags.options.deviation)},
                      {"unit", fmt::format("{} (mesh = {:g} x mm)", flags.unit, scale)}};
  }
  report.stages_s.insert(report.stages_s.begin(), {"read", reading.count()});
  report.total_s += reading.count();
  report.peak_bytes = peak_memory();
  line.clear();
  return deliver(report, flags.common);
}

}  // namespace

Verb add_check(CLI::App& app) {
  const auto flags = std::make_shared<CheckFlags>();
  CLI::App* verb =
      app.add_subcommand("check", "certificates, quality, gaps and surface error of any mesh");
  verb->add_option("mesh", flags->mesh, "mesh to check (" + extensions(true) + ")")
      ->required()
      ->type_name("MESH");
  verb->add_option("-g,--geometry", flags->geometry,
                   "CAD that its surface tags refer to (.step .iges .brep); default: none")
      ->type_name("CAD")
      ->expected(1);
  verb->add_option("--deviation", flags->options.deviation,
                   "a face is off the CAD over this share of its shortest edge [-]")
      ->check(CLI::PositiveNumber)
      ->type_name("SHARE")
      ->capture_default_str();
  verb->add_flag("--strict", flags->options.strict, "faces over the deviation give exit code 3");
  add_unit_flag(*verb, flags->unit);
  add_isolation_flags(*verb, flags->isolation);
  add_from_flag(*verb, flags->format);
  add_common_flags(*verb, flags->common);
  return {verb, &flags->common, [flags] { return run(*flags); }};
}

}  // namespace camber::app
