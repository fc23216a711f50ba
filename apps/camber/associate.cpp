// camber associate: finds what links a mesh and its CAD and writes it as MeshLink XML.
#include <camber/base/parallel.hpp>
#include <camber/geom_occ/cad_file.hpp>
#include <camber/pipeline/cad_link.hpp>
#include <camber/pipeline/family_link.hpp>
#include <camber/pipeline/mesh_link.hpp>

#include <chrono>
#include <memory>

#include <fmt/format.h>

#include "console.hpp"
#include "output.hpp"
#include "verbs.hpp"

namespace camber::app {
namespace {

struct AssociateFlags {
  CommonFlags common;
  FormatFlags format;
  std::string mesh, output, link = "auto", unit = "auto";
  std::vector<std::string> geometry, patches;
};

int run(const AssociateFlags& flags) {
  const auto start = std::chrono::steady_clock::now();
  CurveOptions options;
  options.scale = scale_of_unit(flags.unit);
  options.association = association_of(flags.patches);
  if (flags.link != "auto") {
    options.link_by = flags.link == "tags" ? LinkBy::tags : LinkBy::shape;
  }
  const std::string& cad = only_geometry(flags.geometry);
  refuse_overwriting({flags.mesh, cad}, {flags.output});
  ProgressLine line(flags.common.shows_progress());
  line.show("read", 0.0);
  const MeshData data = io::read_mesh(flags.mesh, flags.format.reading());
  stop_if_interrupted();
  const std::unique_ptr<GeometryModel> geometry = read_cad(cad);
  stop_if_interrupted();
  line.show("associate", 0.2);
  const LinearMesh mesh = build_linear_mesh(data);
  const Topology topology = build_topology(mesh);
  const std::string families =
      take_families(flags.mesh, flags.format.reading().format, data, *geometry, cad, options);
  Report report;
  const Association association = CadLink(data, *geometry, options).link(mesh, topology, report);
  stop_if_interrupted();
  line.show("write", 0.9);
  io::write_meshlink(mesh_link_of(mesh, topology, association, *geometry, flags.mesh, cad),
                     flags.output);
  line.clear();
  note_families(families, report);
  report.command = "associate";
  report.threads = thread_count();
  report.input.mesh = flags.mesh;
  report.input.geometry = flags.geometry;
  report.output.path = flags.output;
  report.options = {{"link", flags.link}, {"unit", flags.unit}};
  report.input.nodes = mesh.vertices.size();
  for (Shape shape : mesh.cell_shape) ++report.input.cells[shape];
  for (const Patch& patch : association.patches) {
    if (patch.group.empty()) report.surface.patches_without_cad.push_back(patch.name);
  }
  if (association.scale != 1.0) {
    report.warnings.push_back(
        fmt::format("CAD lengths were multiplied by {:g} to fit the mesh", association.scale));
  }
  const std::chrono::duration<double> total = std::chrono::steady_clock::now() - start;
  report.total_s = total.count();
  report.peak_bytes = peak_memory();
  return deliver(report, flags.common);
}

}  // namespace

Verb add_associate(CLI::App& app) {
  const auto flags = std::make_shared<AssociateFlags>();
  CLI::App* verb = app.add_subcommand(
      "associate", "find the CAD face, curve and vertex of every boundary entity of a mesh");
  verb->add_option("mesh", flags->mesh, "linear mesh")->required()->type_name("MESH");
  verb->add_option("-g,--geometry", flags->geometry, "CAD file (.step .stp .iges .igs .brep)")
      ->required()
      ->type_name("CAD")
      ->expected(1)
      ->take_all();
  verb->add_option("-o,--output", flags->output,
                   "MeshLink file to write (.xml), for: camber curve --link")
      ->required()
      ->type_name("LINK");
  verb->add_option(
          "--link", flags->link,
          "tags: the surface tags of the mesh; shape: place and shape alone; auto: CAD faces "
          "that the families of a CGNS mesh name, else tags if they fit the CAD, else shape")
      ->check(CLI::IsMember({"auto", "tags", "shape"}))
      ->type_name("auto|tags|shape")
      ->capture_default_str();
  add_patch_flag(*verb, flags->patches);
  add_unit_flag(*verb, flags->unit);
  add_from_flag(*verb, flags->format);
  add_common_flags(*verb, flags->common);
  return {verb, &flags->common, [flags] { return run(*flags); }};
}

}  // namespace camber::app
