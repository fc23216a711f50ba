#pragma once
// Changes of the linear mesh inside the volume that its surface does not notice.
#include <camber/mesh/linear_mesh.hpp>
#include <camber/mesh/topology.hpp>

#include <cstdint>
#include <utility>
#include <vector>

namespace camber {

/// Cuts cells from a new vertex at their centre: a tet over each triangular face, a pyramid over
/// each quadrilateral one. All faces stay as they are, so neighbours do not notice. A cell whose
/// parts would not all be certified positive is left whole. The parts follow the whole cells, in
/// order, with cell and vertex tags above all others.
/// @param cells  sorted, each once
/// @param split  if given, filled with those of `cells` that were cut
[[nodiscard]] LinearMesh split_from_centre(const LinearMesh& mesh, const std::vector<Index>& cells,
                                           std::vector<Index>* split = nullptr);

/// Removes edges inside a volume of tets: the n tets around an edge CD become 2 (n - 2), two over
/// each triangle of the ring that they leave, with apex C and D. Of all triangulations of the ring
/// the one with the best worst tet is taken (shape 12 (3 V)^(2/3) / sum of squared edges, 1 for the
/// regular one); where that is flat or has tets with all corners in `avoided`, 2 n tets from a new
/// vertex inside the ring, if these are better than flat. An edge stays if it is not inside, if
/// another shape touches it, if its ring shares a cell with one removed before, or if the worst tet
/// would be flat. Source: Klincsek 1980, doi 10.1016/S0167-5060(08)70044-X; Shewchuk 2002 (edge
/// removal).
/// @param edges    topology edges, in order of preference
/// @param avoided  by vertex
/// @return the mesh and the number of edges removed
[[nodiscard]] std::pair<LinearMesh, std::size_t> remove_edges(
    const LinearMesh& mesh, const Topology& topology, const std::vector<Index>& edges,
    const std::vector<std::uint8_t>& avoided);

}  // namespace camber
