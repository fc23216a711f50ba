// camber report: a page to look at a curved mesh, and pictures of it.
#include <camber/associate/cad_scale.hpp>
#include <camber/base/error.hpp>
#include <camber/geom_occ/cad_file.hpp>
#include <camber/page/page.hpp>
#include <camber/pipeline/check.hpp>
#include <camber/pipeline/geometry_source.hpp>
#include <camber/pipeline/surface_groups.hpp>

#include <algorithm>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <sstream>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "browser.hpp"
#include "console.hpp"
#include "isolation.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace camber::app {
namespace {

struct ReportFlags {
  CommonFlags common;
  FormatFlags format;
  IsolationFlags isolation;
  CheckOptions options;
  double feature_angle = FeatureOptions{}.angle;
  std::string mesh, unit = "auto", page, png, view = "view=iso", size = "1600x1000", report;
  std::vector<std::string> geometry;
};

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// The --json file of an earlier run. @throws FileError if it is none
std::string read_report(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  if (!in) throw FileError("cannot be read", path, "give the file that --json wrote");
  const auto json = nlohmann::json::parse(text.str(), nullptr, false);
  if (!json.is_object() || !json.contains("camber")) {
    throw FileError("is no report of camber (JSON with a key \"camber\" was expected)", path,
                    "give the file that camber curve or check wrote with --json");
  }
  return text.str();
}

/// Where the page goes when only a picture is wanted: beside it, and gone afterwards.
class ScratchPage {
 public:
  explicit ScratchPage(const std::string& png)
      : path_(std::filesystem::path(png).parent_path() /
              ("." + std::filesystem::path(png).filename().string() + ".page.html")) {}
  ~ScratchPage() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  ScratchPage(const ScratchPage&) = delete;
  ScratchPage& operator=(const ScratchPage&) = delete;
  [[nodiscard]] std::string path() const { return path_.string(); }

 private:
  std::filesystem::path path_;
};

void refuse_what_cannot_work(const ReportFlags& flags) {
  if (flags.page.empty() && flags.png.empty()) {
    throw OptionError("nothing is asked for", "report",
                      "give -o PAGE.html for a page, --png FILE.png for a picture, or both");
  }
  std::vector<std::string> inputs{flags.mesh}, outputs;
  inputs.insert(inputs.end(), flags.geometry.begin(), flags.geometry.end());
  if (!flags.report.empty()) inputs.push_back(flags.report);
  for (const std::string& path : {flags.page, flags.png}) {
    if (!path.empty()) outputs.push_back(path);
  }
  refuse_overwriting(inputs, outputs);
  // A stated format: the name may have any extension.
  for (const std::string& path : outputs) io::check_writable(path, {.format = io::Format::gmsh});
}

/// A geometry without CAD has no tags for the mesh: its faces are found by place.
std::vector<GeometryGroup> linked_by_place(const MeshData& mesh, const GeometryModel& geometry,
                                           const std::string& source, Report& report) {
  std::vector<GeometryGroup> groups = surface_groups_by_place(mesh, geometry);
  const auto linked = std::count_if(groups.begin(), groups.end(),
                                    [](const GeometryGroup& group) { return !group.empty(); });
  if (linked == 0) {
    throw GeometryError("no surface element of the mesh has its corners on it", source,
                        "give the geometry that the mesh was curved onto, and --unit if its unit "
                        "is not the mesh's");
  }
  report.link.method = "place";
  report.link.faces = groups.size();
  report.link.on_cad = static_cast<std::size_t>(linked);
  return groups;
}

int run(const ReportFlags& flags) {
  const Clock::time_point begin = Clock::now();
  refuse_what_cannot_work(flags);
  const PictureSize size = picture_size(flags.size);
  const std::string browser = flags.png.empty() ? "" : find_browser();
  ProgressLine line(flags.common.shows_progress());
  line.show("read", 0.0);
  try_inputs(flags.isolation, flags.mesh, flags.format.reading(), flags.geometry);
  MeshData mesh = io::read_mesh(flags.mesh, flags.format.reading());
  mesh.source = flags.mesh;
  stop_if_interrupted();
  std::unique_ptr<GeometryModel> geometry;
  double scale = 1.0;
  bool is_cad = true;
  if (!flags.geometry.empty()) {
    const std::string& source = only_geometry(flags.geometry);
    is_cad = !is_geometry_without_cad(source);
    geometry = is_cad ? read_cad(source)
                      : make_geometry(source, {flags.feature_angle, flags.feature_angle});
    scale = scale_of_unit(flags.unit);
    if (is_cad) {
      scale = fit_cad_scale(mesh, *geometry, scale);
    } else if (scale != 0.0) {
      geometry->set_scale(scale);
    } else {
      scale = 1.0;  // it is in the mesh's unit
    }
  }
  const GeometryModel* by_tags = is_cad ? geometry.get() : nullptr;
  const double reading = seconds_since(begin);
  stop_if_interrupted();
  line.show("check", 0.2);
  CellFindings findings;
  Report report = check(mesh, by_tags, flags.options, &findings);
  report.command = "report";
  report.input.geometry = flags.geometry;
  if (geometry) {
    report.options = {{"deviation", fmt::format("{:g}", flags.options.deviation)},
                      {"unit", fmt::format("{} (mesh = {:g} x mm)", flags.unit, scale)}};
  }
  std::vector<GeometryGroup> groups;
  if (!is_cad) groups = linked_by_place(mesh, *geometry, flags.geometry.front(), report);
  report.stages_s.insert(report.stages_s.begin(), {"read", reading});
  report.peak_bytes = peak_memory();
  stop_if_interrupted();
  line.show("page", 0.6);
  const Clock::time_point start = Clock::now();
  PageContent content = page_content(std::move(mesh), std::move(findings), report, by_tags);
  if (!is_cad) content.surface_groups = std::move(groups);
  if (!flags.report.empty()) content.report = read_report(flags.report);
  const std::string text = page_html(content, geometry.get());
  stop_if_interrupted();
  if (!flags.page.empty()) io::write_text(flags.page, text);
  if (!flags.png.empty()) {
    const ScratchPage scratch(flags.png);
    line.show("picture", 0.8);
    if (flags.page.empty()) io::write_text(scratch.path(), text);
    take_picture(browser, flags.page.empty() ? scratch.path() : flags.page, flags.view, size,
                 flags.png);
  }
  report.stages_s.emplace_back("page", seconds_since(start));
  report.total_s = seconds_since(begin);
  line.clear();
  return deliver(report, flags.common);
}

}  // namespace

Verb add_report(CLI::App& app) {
  const auto flags = std::make_shared<ReportFlags>();
  CLI::App* verb = app.add_subcommand(
      "report", "a page (one HTML file) to look at any mesh, and pictures of it");
  verb->add_option("mesh", flags->mesh, "mesh to show (" + extensions(true) + ")")
      ->required()
      ->type_name("MESH");
  verb->add_option("-g,--geometry", flags->geometry,
                   "for the deviation: CAD that its surface tags refer to (.step .iges .brep); or, "
                   "found by place, a finer surface mesh (.stl .msh) or an analytic surface such "
                   "as sphere:x,y,z,r; default: none")
      ->type_name("CAD|SURFACE")
      ->expected(1);
  verb->add_option("-o,--page", flags->page, "page to write (.html)")->type_name("PAGE");
  verb->add_option("--png", flags->png, "picture to write; needs Chromium or Chrome")
      ->type_name("PICTURE");
  verb->add_option("--view", flags->view,
                   "what the picture shows: the part after # in the address of the page, as in "
                   "\"colour=deviation&cut=x:0.5&view=iso\" (docs/page.md)")
      ->type_name("STATE")
      ->capture_default_str();
  verb->add_option("--size", flags->size, "of the picture [pixels]")
      ->type_name("WIDTHxHEIGHT")
      ->capture_default_str();
  verb->add_option("--report", flags->report,
                   "report to show on the page: the --json file of the run that made the mesh; "
                   "default: what check finds")
      ->type_name("JSON");
  verb->add_option("--deviation", flags->options.deviation,
                   "a face is off the CAD over this share of its shortest edge [-]")
      ->check(CLI::PositiveNumber)
      ->type_name("SHARE")
      ->capture_default_str();
  add_feature_angle_flag(*verb, "-g .stl or .msh", flags->feature_angle);
  add_unit_flag(*verb, flags->unit);
  add_isolation_flags(*verb, flags->isolation);
  add_from_flag(*verb, flags->format);
  add_common_flags(*verb, flags->common);
  return {verb, &flags->common, [flags] { return run(*flags); }};
}

}  // namespace camber::app
