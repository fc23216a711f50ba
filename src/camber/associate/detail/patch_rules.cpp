#include <camber/associate/detail/patch_rules.hpp>
#include <camber/base/error.hpp>

#include <charconv>
#include <set>
#include <string_view>

#include <fmt/format.h>

namespace camber {
namespace {

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

}  // namespace

AppliedRules apply_patch_rules(const LinearMesh& mesh, const Boundary& boundary,
                               const GeometryModel& model, const TagOptions& options) {
  static const GeometryGroup nowhere;
  AppliedRules rules;
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

}  // namespace camber
