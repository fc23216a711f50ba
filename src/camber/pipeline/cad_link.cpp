#include <camber/associate/by_shape.hpp>
#include <camber/associate/cad_scale.hpp>
#include <camber/base/error.hpp>
#include <camber/pipeline/cad_link.hpp>
#include <camber/pipeline/mesh_link.hpp>
#include <camber/pipeline/own_surface.hpp>

#include <optional>

#include <fmt/format.h>

namespace camber {
Association CadLink::link(const LinearMesh& mesh, const Topology& topology, Report& report) {
  if (options_.link_by == LinkBy::own_surface) {
    return associate_given(mesh, topology, geometry_,
                           given_link(*options_.surface_link, mesh, topology),
                           options_.association);
  }
  if (options_.link_by == LinkBy::file) return by_file(mesh, topology, report);
  if (is_by_shape_) return by_shape(mesh, topology, report);
  std::optional<GeometryError> misfit;
  if (options_.link_by == LinkBy::tags ||
      (options_.link_by == LinkBy::automatic && options_.association.faces.empty())) {
    const double scale = geometry_.scale();
    try {
      fit_cad_scale(data_, geometry_, options_.scale);
      Association association = associate_by_tags(mesh, topology, geometry_, options_.association);
      report.link.method = "tags";
      report.link.largest_distance = association.largest_distance;
      return association;
    } catch (const GeometryError& error) {
      if (options_.link_by == LinkBy::tags) throw;
      misfit = error;
      geometry_.set_scale(scale);
    }
  }
  is_by_shape_ = true;
  report.link.reason = misfit ? misfit->message() : "asked for";
  try {
    fit_cad_scale_by_shape(mesh, topology, geometry_, options_.scale);
    return by_shape(mesh, topology, report);
  } catch (const GeometryError& error) {
    if (!misfit) throw;
    throw GeometryError(fmt::format("{}; and by shape: {}", misfit->message(), error.message()),
                        data_.source, error.remedy());
  }
}

Association CadLink::by_file(const LinearMesh& mesh, const Topology& topology, Report& report) {
  if (!is_scaled_) fit_cad_scale_by_shape(mesh, topology, geometry_, options_.scale);
  is_scaled_ = true;
  Association association = associate_given(
      mesh, topology, geometry_, given_link(options_.mesh_link, mesh, topology, geometry_),
      options_.association);
  report.link.method = "file";
  report.link.largest_distance = association.largest_distance;
  return association;
}

Association CadLink::by_shape(const LinearMesh& mesh, const Topology& topology,
                              Report& report) const {
  ShapeLink link = associate_by_shape(mesh, topology, geometry_, options_.association);
  auto& found = report.link;
  found.method = "shape";
  found.faces = link.faces;
  found.on_cad = link.on_cad;
  found.straddling = link.straddling;
  found.off_cad = link.off_cad;
  found.largest_distance = link.association.largest_distance;
  found.cad_without_mesh.clear();
  for (int face : link.cad_without_mesh) {
    found.cad_without_mesh.push_back(fmt::format("face_{}", face));
  }
  found.patches.clear();
  for (std::size_t p = 0; p < link.confidence.size(); ++p) {
    const Patch& patch = link.association.patches[p];
    LinkRow row{patch.name, {}, patch.faces, link.confidence[p]};
    for (const GeomEntity& face : patch.group) row.cad.push_back(fmt::format("face_{}", face.tag));
    found.patches.push_back(std::move(row));
  }
  return std::move(link.association);
}

}  // namespace camber
