#pragma once
#include <camber/associate/by_tags.hpp>

#include <vector>

namespace camber {

/// What a file says of the faces and edges of a mesh.
struct GivenLink {
  std::vector<GeometryGroup> face_group;  // by topology face: CAD faces; empty: no CAD
  std::vector<GeometryGroup> edge_group;  // by topology edge: CAD curves; empty: nothing is said
};

/// Association as given: every boundary face on its group, every edge on the nearest curve of its
/// own. An edge of which nothing is said, between faces of two groups, lies on the curve that
/// bounds both. The model's scale must fit the mesh already.
/// @throws GeometryError if a face's vertices are not on its group (names the worst); OptionError
///         for a patch rule that names no patch. Threads: runs parallel inside.
[[nodiscard]] Association associate_given(const LinearMesh& mesh, const Topology& topology,
                                          const GeometryModel& model, const GivenLink& link,
                                          const TagOptions& options = {});

}  // namespace camber
