#include <camber/associate/detail/boundary.hpp>
#include <camber/associate/detail/patch_rules.hpp>
#include <camber/associate/detail/shape_edges.hpp>
#include <camber/associate/detail/shape_patches.hpp>
#include <camber/associate/given_link.hpp>
#include <camber/base/error.hpp>
#include <camber/base/parallel.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace camber {
namespace {

/// By face slot: how far its worst corner is from its group, and how far the CAD allows it to be.
struct Misfit {
  double distance = 0.0, tolerance = 0.0;
};

std::vector<Misfit> measure(const LinearMesh& mesh, const Topology& topology,
                            const Boundary& boundary, const GeometryModel& model,
                            const FaceMatch& match) {
  std::vector<Misfit> misfit(boundary.faces.size());
  parallel_for_with(
      boundary.faces.size(), 128, [&] { return model.projector(); },
      [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
        for (std::size_t s = begin; s < end; ++s) {
          if (match.group[s].empty()) continue;
          const Boundary::Face& face = boundary.faces[s];
          for (int i = 0; i < face.corners; ++i) {
            const Index v = topology.face2vertex[at(face.face)][static_cast<std::size_t>(i)];
            const Projection foot =
                project_to_group(*projector, match.group[s], mesh.vertices[at(v)]);
            if (foot.distance <= misfit[s].distance) continue;
            misfit[s] = {foot.distance, 2.0 * model.tolerance(foot.entity)};
          }
        }
      });
  return misfit;
}

void refuse_misfits(const LinearMesh& mesh, const Boundary& boundary, const FaceMatch& match,
                    const std::vector<Misfit>& misfit, double allowed) {
  std::size_t count = 0, worst = 0;
  for (std::size_t s = 0; s < misfit.size(); ++s) {
    if (misfit[s].distance <= std::max(allowed, misfit[s].tolerance)) continue;
    ++count;
    if (count == 1 || misfit[s].distance > misfit[worst].distance) worst = s;
  }
  if (count == 0) return;
  const Vec3& x = boundary.faces[worst].centre;
  throw GeometryError(
      fmt::format("mesh, link and CAD do not fit: a corner of a face of {} lies {:.3g} away from "
                  "face_{}, its CAD face (allowed {:.3g}); {} faces do not fit",
                  mesh.entity_name({2, boundary.faces[worst].entity}), misfit[worst].distance,
                  match.group[worst].front().tag, allowed, count),
      fmt::format("at ({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z()),
      "the link was made for another mesh or another CAD file");
}

}  // namespace

Association associate_given(const LinearMesh& mesh, const Topology& topology,
                            const GeometryModel& model, const GivenLink& link,
                            const TagOptions& options) {
  const Boundary boundary = collect_boundary(mesh, topology);
  const AppliedRules rules = apply_patch_rules(mesh, boundary, model, options);
  FaceMatch match;
  match.near.resize(boundary.vertices.size());
  match.confidence.assign(boundary.faces.size(), 1.0);
  for (std::size_t s = 0; s < boundary.faces.size(); ++s) {
    const PatchRule rule = rules.rule[s];
    const bool is_loose = rule == PatchRule::free || rule == PatchRule::fixed;
    match.group.push_back(is_loose ? GeometryGroup{} : link.face_group[at(boundary.faces[s].face)]);
  }
  const double allowed = options.distance_tolerance * std::min(mesh.size(), model.box().diagonal());
  refuse_misfits(mesh, boundary, match, measure(mesh, topology, boundary, model, match), allowed);

  Association association;
  association.scale = model.scale();
  std::vector<double> confidence;
  make_shape_patches(mesh, topology, boundary, model, match, rules.rule, association, confidence);
  const std::vector<double> reach(boundary.vertices.size(), allowed);
  link_edges_and_vertices(mesh, topology, boundary, model, match, reach, link.edge_group,
                          association);
  return association;
}

}  // namespace camber
