#include <camber/associate/cad_scale.hpp>
#include <camber/associate/detail/boundary.hpp>
#include <camber/base/error.hpp>
#include <camber/geom/box_tree.hpp>

#include <algorithm>
#include <array>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace camber {
namespace {

/// Mesh lengths per CAD length (OpenCASCADE gives millimetres): mm, m, micrometre, inch, ...,
/// centimetre, foot.
constexpr std::array<double, 8> k_usual_scales{1.0,  1e-3, 1e3, 1.0 / 25.4,
                                               25.4, 1e-2, 0.1, 1.0 / 304.8};
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

/// Without tags: boundary vertices looked at, and how far from the CAD they may be, as a share of
/// their longest boundary edge.
constexpr std::size_t k_boundary_samples = 300;
constexpr double k_near_share = 0.02;
/// The vertices on the CAD take at least this share of its room: the CAD in a unit too large meets
/// only some of them, on its planes; a mesh of half the body meets half.
constexpr double k_least_room = 0.15;

/// How well boundary vertices lie on the CAD at its present scale.
struct Fit {
  std::size_t on_cad = 0;
  Box room;  // of these vertices
};

Fit boundary_fit(const LinearMesh& mesh, const Boundary& boundary, const GeometryModel& geometry) {
  Fit fit;
  std::vector<Box> boxes;
  for (int face = 1; face <= geometry.count(2); ++face) boxes.push_back(geometry.box({2, face}));
  const std::unique_ptr<Projector> projector = geometry.projector();
  const std::size_t step = boundary.vertices.size() / k_boundary_samples + 1;
  for (std::size_t s = 0; s < boundary.vertices.size(); s += step) {
    const Vec3& x = mesh.vertices[at(boundary.vertices[s])];
    const double near = k_near_share * boundary.longest_at[s];
    for (std::size_t i = 0; i < boxes.size(); ++i) {
      if (distance_squared(boxes[i], x) > near * near) continue;
      if (projector->closest({2, static_cast<int>(i) + 1}, x).distance > near) continue;
      ++fit.on_cad;
      fit.room.add(x);
      break;
    }
  }
  return fit;
}

}  // namespace

double fit_cad_scale_by_shape(const LinearMesh& mesh, const Topology& topology,
                              GeometryModel& geometry, double scale) {
  if (scale > 0.0) {
    geometry.set_scale(scale);
    return scale;
  }
  const Boundary boundary = collect_boundary(mesh, topology);
  const double given = geometry.scale();
  double best = given;
  std::size_t most = 0;
  for (double factor : k_usual_scales) {
    geometry.set_scale(given * factor);
    const double room = geometry.box().diagonal();
    // The CAD is at most as large as the mesh or, where only a part was meshed, a few times that.
    if (k_least_room * room > mesh.size()) continue;
    const Fit fit = boundary_fit(mesh, boundary, geometry);
    if (fit.on_cad <= most || fit.room.diagonal() < k_least_room * room) continue;
    most = fit.on_cad;
    best = given * factor;
  }
  geometry.set_scale(best);
  if (most == 0) {
    throw GeometryError(
        fmt::format("mesh and CAD do not fit in any usual unit: no boundary vertex lies on the CAD "
                    "(the mesh measures {:.6g}, the CAD {:.6g})",
                    mesh.size(), geometry.box().diagonal()),
        "association by shape",
        "give the CAD that this mesh was made from, in its place, or --unit");
  }
  return best;
}

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
