#pragma once
// What smoothing did to the wall goes on into the layers as the wall's displacement did.
#include <camber/elevate/layer_field.hpp>
#include <camber/mesh/curved_mesh.hpp>

namespace camber {

/// Everything the field is made of (elevate/layer_field.hpp).
struct FieldSource {
  const Association& association;
  const Wall& wall;
  const Placement& placement;
  const Columns& columns;
  LayerFieldOptions options;
};

/// Moves every node that is not on the wall by the difference of two fields: that of the wall as it
/// is in `after` and that of the wall in `before`. Nodes of planes stay in them. The meshes have
/// the same orders. Nothing changes where the wall is the same.
void carry_wall(const CurvedMesh& before, CurvedMesh& after, const FieldSource& source);

}  // namespace camber
