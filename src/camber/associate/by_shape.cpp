#include <camber/associate/by_shape.hpp>
#include <camber/associate/detail/boundary.hpp>
#include <camber/associate/detail/face_match.hpp>
#include <camber/associate/detail/shape_edges.hpp>
#include <camber/associate/detail/shape_patches.hpp>
#include <camber/base/error.hpp>

#include <algorithm>
#include <charconv>
#include <set>

#include <fmt/format.h>

namespace camber {
namespace {

/// A vertex on the CAD is nearer to it than this share of its longest boundary edge.
constexpr double k_reach_share = 0.1;

/// The faces a user names: face_7, or all of one CAD name.
GeometryGroup faces_named(const GeometryModel& model, const std::string& name) {
  GeometryGroup group;
  constexpr std::string_view prefix = "face_";
  if (name.starts_with(prefix)) {
    int tag = 0;
    const char* end = name.data() + name.size();
    const auto [stop, error] = std::from_chars(name.data() + prefix.size(), end, tag);
    if (error == std::errc{} && stop == end && tag >= 1 && tag <= model.count(2)) {
      return {{2, tag}};
    }
  }
  for (int tag = 1; tag <= model.count(2); ++tag) {
    if (model.name({2, tag}) == name) group.push_back({2, tag});
  }
  if (group.empty()) {
    throw OptionError(
        "the CAD has no face " + name, "--patch",
        fmt::format("give face_1 to face_{} or a name of its faces (camber info)", model.count(2)));
  }
  return group;
}

/// What the user said, by face slot.
struct Rules {
  std::vector<PatchRule> rule;
  AllowedFaces allowed;
  std::vector<GeometryGroup> groups;  // that `allowed` points into
};

/// The key of `map` that means this entity, or end.
template <class Map>
typename Map::const_iterator find_patch(const LinearMesh& mesh, int entity, const Map& map) {
  for (const std::string& name :
       {mesh.entity_name({2, entity}), std::to_string(entity), fmt::format("surface {}", entity)}) {
    const auto found = map.find(name);
    if (found != map.end()) return found;
  }
  return map.end();
}

Rules apply_rules(const LinearMesh& mesh, const Boundary& boundary, const GeometryModel& model,
                  const TagOptions& options) {
  static const GeometryGroup nowhere;
  Rules rules;
  rules.rule.assign(boundary.faces.size(), PatchRule::automatic);
  rules.allowed.assign(boundary.faces.size(), nullptr);
  std::set<int> entities;
  for (const Boundary::Face& face : boundary.faces) entities.insert(face.entity);
  rules.groups.reserve(entities.size());
  std::set<std::string> used;
  for (int entity : entities) {
    PatchRule rule = PatchRule::automatic;
    const GeometryGroup* allowed = nullptr;
    if (const auto found = find_patch(mesh, entity, options.patches);
        found != options.patches.end()) {
      used.insert(found->first);
      rule = found->second;
      if (rule == PatchRule::free || rule == PatchRule::fixed) allowed = &nowhere;
    }
    if (const auto found = find_patch(mesh, entity, options.faces); found != options.faces.end()) {
      used.insert(found->first);
      GeometryGroup group;
      for (const std::string& name : found->second) {
        const GeometryGroup named = faces_named(model, name);
        group.insert(group.end(), named.begin(), named.end());
      }
      rules.groups.push_back(std::move(group));
      allowed = &rules.groups.back();
    }
    for (std::size_t s = 0; s < boundary.faces.size(); ++s) {
      if (boundary.faces[s].entity != entity) continue;
      rules.rule[s] = rule;
      rules.allowed[s] = allowed;
    }
  }
  const auto refuse_unused = [&](const std::string& name) {
    if (used.contains(name)) return;
    std::string known;
    for (int entity : entities) {
      known += (known.empty() ? "" : ", ") + mesh.entity_name({2, entity});
    }
    throw OptionError("no patch is named " + name, "--patch", "patches: " + known);
  };
  for (const auto& [name, rule] : options.patches) refuse_unused(name);
  for (const auto& [name, faces] : options.faces) refuse_unused(name);
  return rules;
}

}  // namespace

ShapeLink associate_by_shape(const LinearMesh& mesh, const Topology& topology,
                             const GeometryModel& model, const TagOptions& options) {
  const Boundary boundary = collect_boundary(mesh, topology);
  const Rules rules = apply_rules(mesh, boundary, model, options);
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
  link_edges_and_vertices(mesh, topology, boundary, model, match, reach, link.association);
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
