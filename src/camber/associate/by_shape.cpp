#include <camber/associate/by_shape.hpp>
#include <camber/associate/detail/boundary.hpp>
#include <camber/associate/detail/face_match.hpp>
#include <camber/associate/detail/patch_rules.hpp>
#include <camber/associate/detail/shape_edges.hpp>
#include <camber/associate/detail/shape_patches.hpp>
#include <camber/base/error.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace camber {
namespace {

/// A vertex on the CAD is nearer to it than this share of its longest boundary edge.
constexpr double k_reach_share = 0.1;

}  // namespace

ShapeLink associate_by_shape(const LinearMesh& mesh, const Topology& topology,
                             const GeometryModel& model, const TagOptions& options) {
  const Boundary boundary = collect_boundary(mesh, topology);
  const AppliedRules rules = apply_patch_rules(mesh, boundary, model, options);
  const double allowed = options.distance_tolerance * std::min(mesh.size(), model.box().diagonal());
  std::vector<double> reach;
  for (double longest : boundary.longest_at) {
    reach.push_back(std::min(allowed, k_reach_share * longest));
  }
  const FaceMatch match = match_faces(mesh, topology, boundary, model, reach, rules.allowed);

  ShapeLink link;
  link.association.scale = model.scale();
  make_shape_patches(mesh, topology, boundary, model, match, rules.rule, link.association,
                     link.confidence);
  link_edges_and_vertices(mesh, topology, boundary, model, match, reach, {}, link.association);
  link.faces = boundary.faces.size();
  std::vector<std::uint8_t> is_met(static_cast<std::size_t>(model.count(2)) + 1, 0);
  for (std::size_t s = 0; s < boundary.faces.size(); ++s) {
    const GeometryGroup& group = match.group[s];
    link.on_cad += !group.empty();
    link.straddling += group.size() > 1;
    link.off_cad += match.is_off[s];
    for (const GeomEntity& face : group) is_met[static_cast<std::size_t>(face.tag)] = 1;
  }
  for (int face = 1; face <= model.count(2); ++face) {
    if (!is_met[static_cast<std::size_t>(face)]) link.cad_without_mesh.push_back(face);
  }
  if (link.on_cad == 0) {
    throw GeometryError(
        fmt::format("no boundary face of the mesh lies on the CAD (within {:.3g})", allowed),
        "association by shape",
        "give the CAD that this mesh was made from, in its place, or --unit");
  }
  return link;
}

}  // namespace camber
