#pragma once
#include <map>
#include <string>

#include <camber/associate/association.hpp>

namespace camber {

/// What a user says of a patch by name (or "surface 7", or "7").
enum class PatchRule { automatic, free, fixed, plane, wall };

struct TagOptions {
  /// A classified vertex may be this far from its CAD entity, relative to the model size, or within the
  /// CAD's own tolerance.
  double distance_tolerance = 1e-4;
  /// Mesh length per CAD length; 0: found by comparing boxes.
  double scale = 0.0;
  std::map<std::string, PatchRule> patches;
};

/// Association by Gmsh's entity tags: surface, curve and vertex tags are those of the CAD (the numbering of
/// GeometryModel); tags above the CAD's count are patches without CAD. Sets the model's scale. Boundary
/// faces without a surface element are classified by their vertices where these agree on one CAD face.
/// @throws GeometryError if boxes do not match at any usual unit scale, or an entity's vertices are not
///         on it (names the worst entity and how far), or nothing of the mesh refers to the CAD.
[[nodiscard]] Association associate_by_tags(const LinearMesh& mesh, const Topology& topology,
                                            GeometryModel& model, const TagOptions& options = {});

}  // namespace camber
