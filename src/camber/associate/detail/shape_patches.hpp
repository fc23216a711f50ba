#pragma once
// Patches out of matched faces: file patch by CAD faces, and the pieces that lie on no CAD.
#include <camber/associate/association.hpp>
#include <camber/associate/by_tags.hpp>
#include <camber/associate/detail/face_match.hpp>

#include <vector>

namespace camber {

/// Fills association.patches and face2patch. `rules` is by face slot; `confidence` comes by patch.
void make_shape_patches(const LinearMesh& mesh, const Topology& topology, const Boundary& boundary,
                        const GeometryModel& model, const FaceMatch& match,
                        const std::vector<PatchRule>& rules, Association& association,
                        std::vector<double>& confidence);

}  // namespace camber
