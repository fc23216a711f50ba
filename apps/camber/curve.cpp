// camber curve: the main job, from a linear mesh and its CAD to a certified curved mesh in a file.
#include <camber/base/error.hpp>
#include <camber/base/log.hpp>
#include <camber/geom_occ/cad_file.hpp>
#include <camber/page/page.hpp>
#include <camber/pipeline/check.hpp>
#include <camber/pipeline/curve.hpp>
#include <camber/pipeline/family_link.hpp>
#include <camber/pipeline/geometry_source.hpp>
#include <camber/pipeline/memory_estimate.hpp>
#include <camber/pipeline/own_surface.hpp>
#include <camber/pipeline/periodic.hpp>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>

#include <fmt/format.h>

#include "console.hpp"
#include "isolation.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace camber::app {
namespace {

struct CurveFlags {
  CommonFlags common;
  FormatFlags format;
  IsolationFlags isolation;
  CurveOptions options;
  std::string mesh, unit = "auto", deviation_length = "face", propagation = "layer",
                    smoothing = "auto";
  std::string link = "auto", page;
  bool is_quality_given = false, allow_memory = false;
  double feature_angle = FeatureOptions{}.angle;
  std::vector<std::string> geometry, outputs, patches, periodic;
};

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

bool is_without_cad(const CurveFlags& flags) {
  return flags.geometry.size() == 1 && flags.geometry.front() == "auto";
}

void set_deviation_length(const std::string& text, OrderOptions& orders) {
  if (text == "face" || text == "cell") {
    orders.deviation_length = text == "face" ? DeviationLength::face : DeviationLength::cell;
    return;
  }
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), orders.length);
  if (error != std::errc{} || end != text.data() + text.size() || !(orders.length > 0.0)) {
    throw OptionError("'" + text + "' is no length", "--deviation-length",
                      "give face, cell or a positive length in mesh units");
  }
  orders.deviation_length = DeviationLength::given;
}

CurveOptions options_of(const CurveFlags& flags) {
  CurveOptions options = flags.options;
  if (is_without_cad(flags) && flags.link != "auto") {
    throw OptionError("without a CAD file there is nothing to link to", "--link",
                      "leave it out, or give the CAD with -g");
  }
  options.scale = scale_of_unit(flags.unit);
  set_deviation_length(flags.deviation_length, options.orders);
  options.association = association_of(flags.patches);
  for (const std::string& text : flags.periodic) {
    options.periodic.push_back(parse_periodic(text));
  }
  options.propagation = flags.propagation == "cell"      ? Propagation::cell
                        : flags.propagation == "elastic" ? Propagation::elastic
                                                         : Propagation::layer;
  if (flags.is_quality_given) options.polish_below = options.quality;
  if (flags.smoothing != "auto") {
    options.smoothing = flags.smoothing == "none" ? Smoothing::none : Smoothing::marching;
  }
  if (flags.link == "tags" || flags.link == "shape") {
    options.link_by = flags.link == "tags" ? LinkBy::tags : LinkBy::shape;
  } else if (flags.link != "auto") {
    options.link_by = LinkBy::file;
    options.mesh_link = io::read_meshlink(flags.link);
  }
  if (flags.geometry.size() == 1 && is_geometry_without_cad(flags.geometry.front())) {
    link_without_cad(options);
  }
  if (options.orders.min_order > options.orders.max_order) {
    throw OptionError(fmt::format("the lowest order {} is above the highest, {}",
                                  options.orders.min_order, options.orders.max_order),
                      "--min-order", "lower it or raise --order");
  }
  return options;
}

std::vector<std::pair<std::string, std::string>> shown(const CurveFlags& flags,
                                                       const CurveOptions& options) {
  const auto yes_no = [](bool value) { return std::string(value ? "yes" : "no"); };
  std::vector<std::pair<std::string, std::string>> list{
      {"order", std::to_string(options.orders.max_order)},
      {"min-order", std::to_string(options.orders.min_order)},
      {"uniform", yes_no(options.uniform)},
      {"deviation", fmt::format("{:g}", options.orders.deviation)},
      {"deviation-length", flags.deviation_length},
      {"propagate", flags.propagation},
      {"smooth", flags.smoothing},
      {"quality", fmt::format("{:g}", options.quality)},
      {"unit", flags.unit},
      {"link", flags.link},
      {"fit", yes_no(options.fit)},
      {"split-pinched", yes_no(options.split_pinched)},
      {"allow-invalid", yes_no(options.allow_invalid)},
      {"strict", yes_no(options.strict)}};
  if (is_without_cad(flags)) {
    list.emplace_back("feature-angle", fmt::format("{:g}", flags.feature_angle));
  }
  if (!flags.periodic.empty()) {
    list.emplace_back("periodic", fmt::format("{}", fmt::join(flags.periodic, " ")));
  }
  if (!flags.patches.empty()) {
    list.emplace_back("patch", fmt::format("{}", fmt::join(flags.patches, " ")));
  }
  return list;
}

FeatureOptions features_of(const CurveFlags& flags) {
  return {flags.feature_angle, flags.feature_angle};
}

/// An output can hold element fields.
bool takes_fields(const CurveFlags& flags) {
  const io::Format stated = flags.format.writing().format;
  return std::any_of(flags.outputs.begin(), flags.outputs.end(), [&](const std::string& path) {
    return (stated == io::Format::automatic ? io::format_by_name(path) : stated) == io::Format::vtu;
  });
}

/// Writes all outputs, each verified before it replaces anything. @return seconds spent verifying
double write_all(const MeshData& mesh, const CurveFlags& flags, bool is_certified,
                 bool has_cad_tags) {
  double verifying = 0.0;
  io::WriteOptions writing = flags.format.writing();
  // Tags of surfaces are numbers of CAD faces only if they made the link.
  if (has_cad_tags) writing.geometry = flags.geometry.front();
  for (const std::string& path : flags.outputs) {
    io::write_mesh(mesh, path, writing, [&](const MeshData& read_back) {
      const Clock::time_point start = Clock::now();
      stop_if_interrupted();
      verify_written(mesh, read_back, is_certified);
      stop_if_interrupted();
      verifying += seconds_since(start);
    });
    stop_if_interrupted();
  }
  return verifying;
}

/// States the memory that the run will take. @throws MeshError if there is less
std::size_t foresee_memory(const MeshData& mesh, const CurveFlags& flags) {
  const OrderOptions& orders = flags.options.orders;
  const std::size_t estimate =
      estimated_memory(mesh, {orders.max_order, orders.min_order, flags.options.uniform});
  const std::size_t available = available_memory();
  log(LogLevel::info,
      fmt::format("memory: about {:.0f} MB expected, {:.0f} MB available",
                  static_cast<double>(estimate) / 1e6, static_cast<double>(available) / 1e6));
  if (!flags.allow_memory) require_memory(estimate, peak_memory(), available, flags.mesh);
  return estimate;
}

int run(const CurveFlags& flags) {
  const Clock::time_point begin = Clock::now();
  CurveOptions options = options_of(flags);
  std::vector<std::string> inputs{flags.mesh}, outputs = flags.outputs;
  if (!is_without_cad(flags)) inputs.push_back(only_geometry(flags.geometry));
  if (!flags.page.empty()) outputs.push_back(flags.page);
  refuse_overwriting(inputs, outputs);
  // A stated format: the name of the page may have any extension.
  if (!flags.page.empty()) io::check_writable(flags.page, {.format = io::Format::gmsh});
  for (const std::string& path : flags.outputs) io::check_writable(path, flags.format.writing());

  ProgressLine line(flags.common.shows_progress());
  line.show("read", 0.0);
  try_inputs(flags.isolation, flags.mesh, flags.format.reading(), flags.geometry);
  MeshData mesh = io::read_mesh(flags.mesh, flags.format.reading());
  stop_if_interrupted();
  const std::size_t expected_bytes = foresee_memory(mesh, flags);
  std::unique_ptr<GeometryModel> geometry;
  if (!is_without_cad(flags)) {
    const std::string& source = flags.geometry.front();
    geometry = is_geometry_without_cad(source) ? make_geometry(source, features_of(flags))
                                               : read_cad(source);
  }
  stop_if_interrupted();
  const std::string families = geometry
                                   ? take_families(flags.mesh, flags.format.reading().format, mesh,
                                                   *geometry, flags.geometry.front(), options)
                                   : "";
  const double reading = seconds_since(begin);

  CurveResult result =
      geometry ? curve(std::move(mesh), *geometry, options, line.progress())
               : curve_without_cad(std::move(mesh), features_of(flags), options, line.progress());
  Report& report = result.report;
  report.input.mesh = flags.mesh;
  report.estimated_bytes = expected_bytes;
  note_families(families, report);
  report.input.geometry = flags.geometry;
  report.options = shown(flags, options);
  report.stages_s.insert(report.stages_s.begin(), {"read", reading});

  const bool is_certified = report.validity.invalid + report.validity.undecided == 0;
  if (is_certified || options.allow_invalid) {
    line.show("write", 1.0);
    const Clock::time_point start = Clock::now();
    // The page looks at the result again.
    const MeshData curved = flags.page.empty()
                                ? exported(std::move(result), options, takes_fields(flags))
                                : exported(result, options);
    const double verifying = write_all(curved, flags, is_certified, report.link.method == "tags");
    report.output.path = fmt::format("{}", fmt::join(flags.outputs, ", "));
    report.output.nodes = curved.points.size();
    report.stages_s.emplace_back("write", seconds_since(start) - verifying);
    report.stages_s.emplace_back("verify", verifying);
  } else {
    report.warnings.emplace_back(
        "nothing was written: not every element is certified (--allow-invalid writes all the "
        "same)");
  }
  report.total_s = seconds_since(begin);
  report.peak_bytes = peak_memory();
  if (!flags.page.empty()) {
    line.show("page", 1.0);
    const std::string title = std::filesystem::path(flags.outputs.front()).filename().string();
    // Written even if the mesh is not: what is not certified wants to be looked at most of all.
    const Clock::time_point start = Clock::now();
    io::write_text(flags.page, page_html(page_content(result, title), geometry.get()));
    // The page shows the report as it was before.
    report.stages_s.emplace_back("page", seconds_since(start));
    report.total_s = seconds_since(begin);
    stop_if_interrupted();
  }
  line.clear();
  return deliver(report, flags.common);
}

void add_smoothing_flags(CLI::App& verb, CurveFlags& flags) {
  verb.add_option("--smooth", flags.smoothing,
                  "auto: polish patches of cells with a cost below 0.6 (or --quality, if given) "
                  "and replace starts that are tangled as a whole; marching: the paper's smoother, "
                  "surface then volume, with elevation; none: leave the certified mesh as it is")
      ->check(CLI::IsMember({"auto", "marching", "none"}))
      ->type_name("auto|marching|none")
      ->capture_default_str();
  verb.add_option("--quality", flags.options.quality,
                  "cost C = min(1, Jp/Jc) / WCN that smoothing aims at; cells below it are counted "
                  "in the report [-]")
      ->check(CLI::Range(0.0, 1.0))
      ->type_name("COST")
      ->each([&flags](const std::string&) { flags.is_quality_given = true; })
      ->capture_default_str();
}

void add_order_flags(CLI::App& verb, CurveFlags& flags) {
  OrderOptions& orders = flags.options.orders;
  verb.add_option("--order", orders.max_order, "highest order (degree) of an element [-]")
      ->check(CLI::Range(1, k_max_order))
      ->type_name("ORDER")
      ->capture_default_str();
  verb.add_option("--min-order", orders.min_order, "lowest order of an element [-]")
      ->check(CLI::Range(1, k_max_order))
      ->type_name("ORDER")
      ->capture_default_str();
  verb.add_flag("--uniform", flags.options.uniform,
                "write every element at the highest order (same shapes); default: mixed orders");
  verb.add_option("--deviation", orders.deviation,
                  "a face asks for more order while it is farther from the CAD than this share of "
                  "the deviation length [-]")
      ->check(CLI::PositiveNumber)
      ->type_name("SHARE")
      ->capture_default_str();
  verb.add_option("--deviation-length", flags.deviation_length,
                  "face: shortest edge of the wall face; cell: of the cell on it, as in the paper; "
                  "or a length [mesh units]")
      ->type_name("face|cell|LENGTH")
      ->capture_default_str();
  verb.add_option(
          "--propagate", flags.propagation,
          "layer: the wall's displacement is carried through the whole boundary layer; elastic: "
          "spread by a linear solve; cell: it dies out in the first cell, as in the paper")
      ->check(CLI::IsMember({"layer", "elastic", "cell"}))
      ->type_name("layer|elastic|cell")
      ->capture_default_str();
}

}  // namespace

Verb add_curve(CLI::App& app) {
  const auto flags = std::make_shared<CurveFlags>();
  CLI::App* verb = app.add_subcommand("curve", "curve a linear mesh onto its CAD");
  verb->add_option("mesh", flags->mesh, "linear mesh (" + extensions(true) + ")")
      ->required()
      ->type_name("MESH");
  verb->add_option("-g,--geometry", flags->geometry,
                   "CAD file (.step .stp .iges .igs .brep). Without CAD: auto, a smooth surface "
                   "through the boundary vertices of the mesh; a finer surface mesh (.stl .msh); "
                   "or sphere:x,y,z,r, ellipsoid:x,y,z,a,b,c, cylinder:x,y,z,dx,dy,dz,r, "
                   "torus:x,y,z,dx,dy,dz,R,r")
      ->required()
      ->type_name("CAD|auto")
      ->expected(1)
      ->take_all();
  verb->add_option("-o,--output", flags->outputs,
                   "curved mesh to write (" + extensions(false) + "); may be given several times")
      ->required()
      ->type_name("OUT")
      ->expected(1)
      ->take_all();
  verb->add_option("--page", flags->page,
                   "page to write: the curved mesh and the report as one HTML file (docs/page.md)")
      ->type_name("PAGE");
  add_order_flags(*verb, *flags);
  add_smoothing_flags(*verb, *flags);
  add_unit_flag(*verb, flags->unit);
  verb->add_option("-l,--link", flags->link,
                   "what links mesh and CAD. A MeshLink file (.xml); tags: the surface tags of "
                   "the mesh; shape: place and shape alone; auto: CAD faces that the families "
                   "of a CGNS mesh name, else tags if they fit the CAD, else shape")
      ->type_name("LINK|auto|tags|shape")
      ->capture_default_str();
  add_patch_flag(*verb, flags->patches);
  verb->add_option("--periodic", flags->periodic,
                   "two patches that are copies: their curved shapes are made equal; the motion is "
                   "found if it is a translation or a turn between planes; may be given several "
                   "times")
      ->expected(1)
      ->take_all()
      ->type_name("NAME=OTHER[:dx,dy,dz|:x,y,z,ax,ay,az,degrees]");
  add_feature_angle_flag(*verb, "-g auto, .stl or .msh", flags->feature_angle);
  verb->add_flag("--fit", flags->options.fit,
                 "slide wall nodes along the CAD until the faces follow it as closely as their "
                 "order can; default: evenly spread nodes");
  verb->add_flag("--split-pinched", flags->options.split_pinched,
                 "mend cells whose corner has three edges on one smooth CAD face, which no curving "
                 "can leave valid, inside the volume: remove the edge behind them or cut them; "
                 "default: leave and list them");
  verb->add_flag("--allow-invalid", flags->options.allow_invalid,
                 "write even if an element is not certified; default: write nothing, exit code 3");
  verb->add_flag("--allow-memory", flags->allow_memory,
                 "go on even if more memory is expected to be needed than is available; default: "
                 "stop before the work, exit code 2");
  verb->add_flag("--strict", flags->options.strict, "faces over the deviation give exit code 3");
  add_isolation_flags(*verb, flags->isolation);
  add_from_flag(*verb, flags->format);
  add_to_flags(*verb, flags->format);
  add_common_flags(*verb, flags->common);
  return {verb, &flags->common, [flags] { return run(*flags); }};
}

}  // namespace camber::app
