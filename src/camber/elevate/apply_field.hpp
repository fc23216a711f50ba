#pragma once
#include <camber/elevate/layer_field.hpp>
#include <camber/mesh/curved_mesh.hpp>

namespace camber {

/// Moves every high-order node of the mesh (which must be straight) by the field: wall nodes to their
/// placed positions, volume nodes by the carried displacement, nodes on planes exactly inside them.
void apply_field(const LayerField& field, CurvedMesh& curved);

}  // namespace camber
