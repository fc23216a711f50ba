#pragma once
#include <camber/associate/association.hpp>

#include <map>
#include <string>
#include <vector>

namespace camber {

/// What a user says of a patch by name (or "surface 7", or "7").
enum class PatchRule { automatic, free, fixed, plane, wall };

struct TagOptions {
  /// A classified vertex may be this far from its CAD entity, relative to the model size, or within
  /// the CAD's own tolerance.
  double distance_tolerance = 1e-4;
  std::map<std::string, PatchRule> patches;
  /// Patch -> CAD faces it may lie on, by number (face_3) or name; association by shape only.
  std::map<std::string, std::vector<std::string>> faces;
};

/// Association by Gmsh's entity tags: surface, curve and vertex tags are those of the CAD (the
/// numbering of GeometryModel); tags above the CAD's count are patches without CAD. The model's
/// scale must fit the mesh already (cad_scale.hpp). Boundary faces without a surface element are
/// classified by their vertices where these agree on one CAD face.
/// @throws GeometryError if an entity's vertices are not on it (names the worst entity and how
/// far);
///         OptionError for a patch rule that names no patch.
[[nodiscard]] Association associate_by_tags(const LinearMesh& mesh, const Topology& topology,
                                            const GeometryModel& model,
                                            const TagOptions& options = {});

}  // namespace camber
