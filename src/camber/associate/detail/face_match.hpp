#pragma once
// Which CAD faces each boundary face lies on: by its forming nodes, its centre and its normal.
#include <camber/associate/detail/boundary.hpp>
#include <camber/geom/geometry_model.hpp>

#include <vector>

namespace camber {

/// A CAD face and how far away it is.
struct NearFace {
  int face = 0;
  double distance = 0.0;
};

struct FaceMatch {
  std::vector<std::vector<NearFace>> near;  // by vertex slot: CAD faces in reach, nearest first
  std::vector<GeometryGroup> group;         // by face slot; empty: on no CAD face
  std::vector<double> confidence;           // by face slot, 0..1
  std::vector<std::uint8_t> is_off;         // by face slot: nodes on the CAD, the face not
};

/// CAD faces that a face slot may lie on; empty: any.
using AllowedFaces = std::vector<const GeometryGroup*>;

/// @param reach  by vertex slot: how far from the CAD a vertex may be to lie on it
/// @param allowed by face slot: null: any CAD face, else only those (an empty group: none)
[[nodiscard]] FaceMatch match_faces(const LinearMesh& mesh, const Topology& topology,
                                    const Boundary& boundary, const GeometryModel& model,
                                    const std::vector<double>& reach, const AllowedFaces& allowed);

}  // namespace camber
