// Pages: one HTML file to look at a mesh.
#include <camber/associate/cad_scale.hpp>
#include <camber/base/error.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/page/page.hpp>
#include <camber/pipeline/check.hpp>
#include <camber/pipeline/surface_groups.hpp>

#include <filesystem>
#include <utility>

#include "runs.hpp"

namespace camber::python {
namespace {

std::string title_of(const std::string& path) {
  return std::filesystem::path(path).filename().string();
}

void write_run_page(const Run& run, const std::string& path) {
  const std::string title = run.result.report.input.mesh.empty()
                                ? title_of(path)
                                : title_of(run.result.report.input.mesh);
  const PageContent content = page_content(run.result, title);
  if (!run.geometry) {  // without CAD: the deviations that the run measured are shown
    io::write_text(path, page_html(content, nullptr));
    return;
  }
  const std::scoped_lock turn(run.geometry->turn);
  run.geometry->model->set_scale(run.scale);
  io::write_text(path, page_html(content, run.geometry->model.get()));
}

void write_mesh_page(const MeshData& mesh, const std::string& path, Geometry* geometry,
                     double deviation, double scale) {
  CheckOptions options;
  options.deviation = deviation;
  CellFindings findings;
  if (!geometry) {
    const Report report = check(mesh, nullptr, options, &findings);
    PageContent content = page_content(mesh, std::move(findings), report, nullptr);
    if (content.title.empty()) content.title = title_of(path);
    io::write_text(path, page_html(content, nullptr));
    return;
  }
  const std::scoped_lock turn(geometry->turn);
  GeometryModel& model = *geometry->model;
  model.set_scale(1.0);
  if (geometry->is_cad) fit_cad_scale(mesh, model, scale);
  if (!geometry->is_cad && scale != 0.0) model.set_scale(scale);
  const GeometryModel* by_tags = geometry->is_cad ? &model : nullptr;
  Report report = check(mesh, by_tags, options, &findings);
  report.command = "report";
  report.input.geometry = {geometry->path};
  PageContent content = page_content(mesh, std::move(findings), report, by_tags);
  if (!geometry->is_cad) content.surface_groups = surface_groups_by_place(mesh, model);
  if (content.title.empty()) content.title = title_of(path);
  io::write_text(path, page_html(content, &model));
}

}  // namespace

void bind_pages(py::module_& module) {
  module.def("write_run_page", &write_run_page, py::call_guard<py::gil_scoped_release>(),
             py::arg("run"), py::arg("path"));
  module.def(
      "write_mesh_page",
      [](const MeshData& mesh, const std::string& path, Geometry* geometry, double deviation,
         const std::string& unit) {
        write_mesh_page(mesh, path, geometry, deviation, scale_of(unit));
      },
      py::call_guard<py::gil_scoped_release>(), py::arg("mesh"), py::arg("path"),
      py::arg("geometry").none(true), py::arg("deviation"), py::arg("unit"));
}

}  // namespace camber::python
