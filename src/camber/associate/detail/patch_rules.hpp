#pragma once
// --patch, spread over the boundary faces.
#include <camber/associate/by_tags.hpp>
#include <camber/associate/detail/boundary.hpp>
#include <camber/associate/detail/face_match.hpp>

#include <vector>

namespace camber {

/// What the user said, by face slot.
struct AppliedRules {
  std::vector<PatchRule> rule;
  AllowedFaces allowed;
  std::vector<GeometryGroup> groups;  // that `allowed` points into
};

/// @throws OptionError for a name that no patch has, or a CAD face that does not exist
[[nodiscard]] AppliedRules apply_patch_rules(const LinearMesh& mesh, const Boundary& boundary,
                                             const GeometryModel& model, const TagOptions& options);

}  // namespace camber
