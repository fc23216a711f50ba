// CAD files, curve() and check().
#include "runs.hpp"

#include <camber/associate/cad_scale.hpp>
#include <camber/base/error.hpp>
#include <camber/base/parallel.hpp>
#include <camber/geom_occ/cad_file.hpp>
#include <camber/pipeline/check.hpp>
#include <camber/pipeline/family_link.hpp>
#include <camber/pipeline/geometry_source.hpp>
#include <camber/pipeline/own_surface.hpp>
#include <camber/pipeline/text_report.hpp>

#include <filesystem>
#include <pybind11/stl.h>
#include <utility>

#include <fmt/format.h>

namespace camber::python {

double scale_of(const std::string& unit) {
  for (const auto& [known, scale] :
       {std::pair{"auto", 0.0}, {"mm", 1.0}, {"m", 1e-3}, {"in", 1.0 / 25.4}}) {
    if (unit == known) return scale;
  }
  throw OptionError(fmt::format("'{}' is no known unit", unit), "unit", "give auto, m, mm or in");
}

namespace {

template <class Value>
Value choice(const char* option, const std::string& text,
             std::initializer_list<std::pair<const char*, Value>> choices) {
  std::string all;
  for (const auto& [known, value] : choices) {
    if (text == known) return value;
    all += fmt::format("{}{}", all.empty() ? "" : ", ", known);
  }
  throw OptionError(fmt::format("'{}' is no choice", text), option, "give one of " + all);
}

void set_deviation_length(const std::string& text, CurveOptions& options) {
  options.orders.deviation_length = choice<DeviationLength>(
      "deviation_length", text, {{"face", DeviationLength::face}, {"cell", DeviationLength::cell}});
}

/// A rule by its name, or the CAD faces that the patch may lie on.
void set_patches(const py::dict& patches, TagOptions& association) {
  for (const auto& [key, value] : patches) {
    const auto patch = py::str(key).cast<std::string>();
    if (!py::isinstance<py::str>(value)) {
      association.faces[patch] = value.cast<std::vector<std::string>>();
      continue;
    }
    association.patches[patch] = choice<PatchRule>("patches", value.cast<std::string>(),
                                                   {{"free", PatchRule::free},
                                                    {"fixed", PatchRule::fixed},
                                                    {"plane", PatchRule::plane},
                                                    {"wall", PatchRule::wall}});
  }
}

/// One of the three ways to find the link, or the MeshLink file that states it.
void set_link(const std::string& text, CurveOptions& options) {
  if (text.ends_with(".xml")) {
    options.link_by = LinkBy::file;
    options.mesh_link = io::read_meshlink(text);
    return;
  }
  options.link_by = choice<LinkBy>(
      "link", text,
      {{"auto", LinkBy::automatic}, {"tags", LinkBy::tags}, {"shape", LinkBy::shape}});
}

CurveOptions make_options(const py::dict& given) {
  CurveOptions options;
  const auto text = [&](const char* key) { return given[key].cast<std::string>(); };
  const auto yes = [&](const char* key) { return given[key].cast<bool>(); };
  options.orders.max_order = given["order"].cast<int>();
  options.orders.min_order = given["min_order"].cast<int>();
  options.orders.deviation = given["deviation"].cast<double>();
  if (py::isinstance<py::str>(given["deviation_length"])) {
    set_deviation_length(text("deviation_length"), options);
  } else {
    options.orders.deviation_length = DeviationLength::given;
    options.orders.length = given["deviation_length"].cast<double>();
  }
  options.uniform = yes("uniform");
  options.propagation = choice<Propagation>("propagate", text("propagate"),
                                            {{"layer", Propagation::layer},
                                             {"elastic", Propagation::elastic},
                                             {"cell", Propagation::cell}});
  options.smoothing = choice<Smoothing>("smooth", text("smooth"),
                                        {{"auto", Smoothing::automatic},
                                         {"marching", Smoothing::marching},
                                         {"none", Smoothing::none}});
  if (!given["quality"].is_none()) {
    options.quality = given["quality"].cast<double>();
    options.polish_below = options.quality;
  }
  options.scale = scale_of(text("unit"));
  set_patches(given["patches"].cast<py::dict>(), options.association);
  set_link(text("link"), options);
  options.fit = yes("fit");
  options.split_pinched = yes("split_pinched");
  options.strict = yes("strict");
  return options;
}

std::vector<std::pair<std::string, std::string>> shown(const py::dict& given) {
  std::vector<std::pair<std::string, std::string>> list;
  for (const auto& [key, value] : given) {
    list.emplace_back(key.cast<std::string>(), py::str(value).cast<std::string>());
  }
  return list;
}

/// What the families of the file say, where the mesh came from a .cgns file that is still there.
std::string families_of(const MeshData& mesh, const Geometry& geometry, CurveOptions& options) {
  std::error_code failed;
  const std::filesystem::path source(mesh.source);
  if (source.extension() != ".cgns" || !std::filesystem::is_regular_file(source, failed)) return "";
  return take_families(mesh.source, io::Format::cgns, mesh, *geometry.model, geometry.path,
                       options);
}

CurveResult run_curve(const MeshData& mesh, Geometry* geometry, CurveOptions& options,
                      double feature_angle, const Progress& progress) {
  if (!geometry) {
    return curve_without_cad(mesh, {feature_angle, feature_angle}, options, progress);
  }
  const std::scoped_lock turn(geometry->turn);
  geometry->model->set_scale(1.0);  // as read, whatever an earlier run found
  if (!geometry->is_cad) link_without_cad(options);
  const std::string families = families_of(mesh, *geometry, options);
  CurveResult result = curve(mesh, *geometry->model, options, progress);
  note_families(families, result.report);
  return result;
}

std::shared_ptr<Run> curve_mesh(const MeshData& mesh, const std::shared_ptr<Geometry>& geometry,
                                const py::dict& given, int threads, const py::object& callback) {
  auto run = std::make_shared<Run>();
  run->options = make_options(given);
  const double feature_angle = given["feature_angle"].cast<double>();
  PythonProgress python(callback);
  bool is_cancelled = false;
  {
    const py::gil_scoped_release no_gil;
    const ThreadLimit limit(threads);
    try {
      run->result = run_curve(mesh, geometry.get(), run->options, feature_angle, python.progress());
    } catch (const Cancelled&) {
      is_cancelled = true;
    }
  }
  if (is_cancelled) python.rethrow();
  run->geometry = geometry;
  run->scale = run->result.association.scale;
  run->result.report.input.mesh = mesh.source;
  run->result.report.input.geometry = {geometry ? geometry->path : "auto"};
  run->result.report.options = shown(given);
  return run;
}

Report check_mesh(const MeshData& mesh, Geometry* geometry, const CheckOptions& options,
                  double scale) {
  if (!geometry) return check(mesh, nullptr, options);
  const std::scoped_lock turn(geometry->turn);
  geometry->model->set_scale(1.0);
  fit_cad_scale(mesh, *geometry->model, scale);
  Report report = check(mesh, geometry->model.get(), options);
  report.input.geometry = {geometry->path};
  return report;
}

void bind_geometry(py::module_& module) {
  py::class_<Geometry, std::shared_ptr<Geometry>>(module, "GeometryModel")
      .def(py::init([](const std::string& path) {
             auto geometry = std::make_shared<Geometry>();
             geometry->path = path;
             geometry->is_cad = !is_geometry_without_cad(path);
             geometry->model = geometry->is_cad ? read_cad(path) : make_geometry(path);
             return geometry;
           }),
           py::call_guard<py::gil_scoped_release>(), py::arg("path"))
      .def_readonly("path", &Geometry::path)
      .def(
          "count",
          [](const Geometry& self, int dim) {
            if (dim < 0 || dim > 2) {
              throw GeometryError(fmt::format("there are no entities of dimension {}", dim),
                                  self.path, "give 0 (vertices), 1 (curves) or 2 (faces)");
            }
            return self.model->count(dim);
          },
          py::arg("dim"))
      .def(
          "name",
          [](const Geometry& self, int dim, int tag) {
            if (dim < 0 || dim > 2 || tag < 1 || tag > self.model->count(dim)) {
              throw GeometryError(fmt::format("there is no entity ({}, {})", dim, tag), self.path,
                                  "tags count from 1 to count(dim), dimensions are 0 to 2");
            }
            return self.model->name({dim, tag});
          },
          py::arg("dim"), py::arg("tag"));
}

void bind_result(py::module_& module) {
  py::class_<Run, std::shared_ptr<Run>>(module, "Run")
      .def_property_readonly("is_certified", &Run::is_certified)
      .def_property_readonly("report", [](const Run& self) { return self.result.report; })
      .def_property_readonly("vertices",
                             [](const py::object& self) {
                               const Points& points = self.cast<Run&>().result.linear->vertices;
                               return view_of(points.data(), points.size(), self, false);
                             })
      .def_property_readonly(
          "high_order_nodes",
          [](const py::object& self) {
            const auto nodes = std::as_const(*self.cast<Run&>().result.curved).high_order_nodes();
            return view_of(nodes.data(), nodes.size(), self, false);
          })
      .def_property_readonly("cell_orders",
                             [](const py::object& self) {
                               return view_of(self.cast<Run&>().result.curved->orders().cell, self);
                             })
      .def_property_readonly("cell_tags",
                             [](const py::object& self) {
                               return view_of(self.cast<Run&>().result.linear->cell_tags, self);
                             })
      .def_property_readonly(
          "cell_bounds",
          [](const py::object& self) { return view_of(self.cast<Run&>().result.cell_bound, self); })
      .def_property_readonly(
          "cell_costs",
          [](const py::object& self) { return view_of(self.cast<Run&>().result.cell_cost, self); })
      .def_property_readonly("face_deviations",
                             [](const py::object& self) {
                               return view_of(self.cast<Run&>().result.face_deviation, self);
                             })
      .def(
          "exported",
          [](const Run& self) {
            return std::make_shared<MeshData>(exported(self.result, self.options));
          },
          py::call_guard<py::gil_scoped_release>());
}

}  // namespace

void bind_runs(py::module_& module) {
  bind_geometry(module);
  py::class_<Report>(module, "Report")
      .def_readonly("status", &Report::status)
      .def_readonly("exit_code", &Report::exit_code)
      .def("text", &text_report)
      .def("json", &json_report);
  bind_result(module);
  module.def("curve", &curve_mesh, py::arg("mesh"), py::arg("geometry").none(true),
             py::arg("options"), py::arg("threads"), py::arg("progress"));
  module.def(
      "check",
      [](const MeshData& mesh, Geometry* geometry, double deviation, bool with_quality, bool strict,
         const std::string& unit) {
        CheckOptions options;
        options.deviation = deviation;
        options.with_quality = with_quality;
        options.strict = strict;
        return check_mesh(mesh, geometry, options, scale_of(unit));
      },
      py::call_guard<py::gil_scoped_release>(), py::arg("mesh"), py::arg("geometry").none(true),
      py::arg("deviation"), py::arg("quality"), py::arg("strict"), py::arg("unit"));
}

}  // namespace camber::python
