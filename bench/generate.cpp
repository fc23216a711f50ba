// generate: hybrid layer meshes of any size on analytic bodies, for camber curve -g BODY.
#include <camber/base/error.hpp>
#include <camber/io/mesh_file.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "layer_meshes.hpp"

namespace camber {
namespace {

using namespace testing;

struct Flags {
  std::string body = "ball", shapes = "hybrid", output;
  double cells = 1e6, first_cell = 1e-4, growth = 1.2, thickness = 1.0;
};

/// A body that is the unit sphere stretched along the axes.
struct Body {
  Vec3 semi_axes;
  [[nodiscard]] std::string geometry() const {
    if (semi_axes == Vec3::Ones()) return "sphere:0,0,0,1";
    return fmt::format("ellipsoid:0,0,0,{},{},{}", semi_axes.x(), semi_axes.y(), semi_axes.z());
  }
  [[nodiscard]] Vec3 normal(const Vec3& x) const {
    return x.cwiseQuotient(semi_axes.cwiseProduct(semi_axes)).normalized();
  }
};

Body body_of(const std::string& name) {
  return {name == "ball" ? Vec3(1.0, 1.0, 1.0) : Vec3(1.0, 0.1, 3.0)};
}

/// Cubed sphere; for the hybrid mesh three of the six sides are cut into triangles.
SurfaceMesh surface_of(const Flags& flags, int n) {
  SurfaceMesh surface = cubed_sphere(n);
  if (flags.shapes == "hybrid") {
    const std::size_t half = surface.faces.size() / 2;
    std::vector<std::array<Index, 4>> faces;
    for (std::size_t f = 0; f < surface.faces.size(); ++f) {
      const auto [a, b, c, d] = surface.faces[f];
      if (f >= half) {
        faces.push_back(surface.faces[f]);
        continue;
      }
      faces.push_back({a, b, c, k_none});
      faces.push_back({a, c, d, k_none});
    }
    surface.faces = std::move(faces);
  }
  return stretched(surface, body_of(flags.body).semi_axes);
}

/// First cell, growing up to the edge of the surface mesh, then as high as wide.
std::vector<double> heights_of(const Flags& flags, double edge) {
  std::vector<double> heights{0.0};
  for (double h = flags.first_cell * edge; heights.back() < flags.thickness;
       h = std::min(edge, h * flags.growth)) {
    heights.push_back(heights.back() + h);
  }
  return heights;
}

void run(const Flags& flags) {
  int n = 2;
  const auto cells_with = [&](int faces) {
    const SurfaceMesh coarse = surface_of(flags, 8);
    const double edge = mean_edge(coarse) * 8.0 / faces;
    const double per_face = static_cast<double>(coarse.faces.size()) / 64.0;
    return per_face * faces * faces * static_cast<double>(heights_of(flags, edge).size() - 1);
  };
  while (cells_with(n + 1) <= flags.cells) ++n;
  const SurfaceMesh surface = surface_of(flags, n);
  const Body body = body_of(flags.body);
  LayerOptions options;
  if (flags.shapes == "hybrid") options.filling = LayerFilling::capped;
  const MeshData mesh = layers_on(
      surface, heights_of(flags, mean_edge(surface)), [&](const Vec3& x) { return body.normal(x); },
      options);
  io::write_mesh(mesh, flags.output);
  std::size_t cells = 0;
  for (const ElementBlock& block : mesh.blocks) {
    if (dimension(block.shape) == 3) cells += block.size();
  }
  fmt::print("{}: {} cells, {} points; camber curve {} -g {} -o OUT\n", flags.output, cells,
             mesh.points.size(), flags.output, body.geometry());
}

}  // namespace
}  // namespace camber

int main(int argc, char** argv) {
  CLI::App app(
      "Layers of prisms and hexahedra with pyramids and tetrahedra on top, on a ball or on a flat "
      "ellipsoid, with about as many cells as asked for.");
  camber::Flags flags;
  app.add_option("--body", flags.body)
      ->check(CLI::IsMember({"ball", "wing"}))
      ->capture_default_str();
  app.add_option("--shapes", flags.shapes, "hybrid: all four; hexes: no triangles, no caps")
      ->check(CLI::IsMember({"hybrid", "hexes"}))
      ->capture_default_str();
  app.add_option("--cells", flags.cells)->check(CLI::Range(100.0, 1e8))->capture_default_str();
  app.add_option("--first-cell", flags.first_cell, "height of the first cell by the mean edge")
      ->check(CLI::Range(1e-9, 1.0))
      ->capture_default_str();
  app.add_option("--growth", flags.growth)->check(CLI::Range(1.01, 10.0))->capture_default_str();
  app.add_option("--thickness", flags.thickness, "of all layers together")
      ->check(CLI::PositiveNumber)
      ->capture_default_str();
  app.add_option("-o,--output", flags.output, "mesh to write (.msh)")->required();
  CLI11_PARSE(app, argc, argv);
  try {
    camber::run(flags);
  } catch (const camber::Error& error) {
    fmt::print(stderr, "generate: {}\n", error.what());
    return 2;
  }
  return 0;
}
