#include <camber/associate/cad_scale.hpp>
#include <camber/base/error.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace camber {
namespace {

/// Mesh lengths per CAD length (OpenCASCADE gives millimetres): mm, m, micrometre, inch, ..., foot.
constexpr std::array<double, 7> k_usual_scales{1.0, 1e-3, 1e3, 1.0 / 25.4, 25.4, 1e-2, 1.0 / 304.8};
/// Nodes lie on the CAD, or miss it by the error of the mesh; a wrong unit moves the CAD by half of
/// the model's size and more.
constexpr double k_misfit = 0.1;
constexpr std::size_t k_samples_per_block = 16;

using Sample = std::pair<GeomEntity, Vec3>;

std::vector<Sample> sample_nodes(const MeshData& data, int face_count) {
  std::vector<Sample> samples;
  for (const ElementBlock& block : data.blocks) {
    if (dimension(block.shape) != 2 || block.entity < 1 || block.entity > face_count) continue;
    const std::size_t step = block.nodes.size() / k_samples_per_block + 1;
    for (std::size_t i = 0; i < block.nodes.size(); i += step) {
      samples.emplace_back(GeomEntity{2, block.entity}, data.points[at(block.nodes[i])]);
    }
  }
  return samples;
}

double largest_distance(const GeometryModel& geometry, const std::vector<Sample>& samples) {
  const std::unique_ptr<Projector> projector = geometry.projector();
  double largest = 0.0;
  for (const auto& [face, x] : samples) {
    largest = std::max(largest, projector->closest(face, x).distance);
  }
  return largest;
}

}  // namespace

double fit_cad_scale(const MeshData& data, GeometryModel& geometry, double scale) {
  const std::vector<Sample> samples = sample_nodes(data, geometry.count(2));
  if (samples.empty()) {
    throw GeometryError(
        fmt::format("no surface of the mesh refers to the CAD, which has faces 1..{}",
                    geometry.count(2)),
        data.source,
        "surface tags must be those of the CAD, as Gmsh gives them with Mesh.SaveAll=1");
  }
  if (scale > 0.0) {
    geometry.set_scale(scale);
    return scale;
  }
  Box box;
  for (const auto& [face, x] : samples) box.add(x);
  const double given = geometry.scale();
  double best = given, nearest = std::numeric_limits<double>::infinity();
  for (double factor : k_usual_scales) {
    geometry.set_scale(given * factor);
    const double distance = largest_distance(geometry, samples);
    if (distance >= nearest) continue;
    nearest = distance;
    best = given * factor;
  }
  geometry.set_scale(best);
  if (nearest > k_misfit * box.diagonal()) {
    const Box cad = geometry.box();
    throw GeometryError(
        fmt::format("mesh and CAD do not fit in any usual unit: at best nodes lie {:.3g} away from "
                    "their CAD face (the mesh's walls measure {:.6g}, the CAD {:.6g})",
                    nearest, box.diagonal(), cad.diagonal()),
        data.source, "give the CAD that this mesh was made from, or --unit");
  }
  return best;
}

}  // namespace camber
