#pragma once
#include <camber/elevate/layer_field.hpp>
#include <camber/mesh/curved_mesh.hpp>

#include <vector>

namespace camber {

/// Sets every high-order node to its straight place moved by the field: wall nodes come to their
/// placed positions, volume nodes are carried, nodes on planes stay exactly inside them.
void apply_field(const LayerField& field, CurvedMesh& curved);

/// The same for the edges, faces and insides of some cells only.
void apply_field(const LayerField& field, CurvedMesh& curved, const std::vector<Index>& cells);

}  // namespace camber
