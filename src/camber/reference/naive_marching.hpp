#pragma once
// One sweep of the paper's smoother in the plainest way: every node looks at every element.
#include <camber/mesh/curved_mesh.hpp>

#include <cstdint>
#include <vector>

namespace camber::reference {

struct NaiveMarching {
  int level = 0;  // of subdivision for the normalised Jacobian
  double relaxation = 0.05, threshold = 0.95;
  /// Edges and faces whose nodes stay.
  std::vector<std::uint8_t> fixed_edge, fixed_face;
};

/// Displacement of the nodes by one sweep of [karman2022] 2.2.5 over the volume, or over some
/// boundary faces (then nodes leave their surface). Derivatives by closed formulas, weights from
/// the straight elements' edge vectors, dependence of elements on nodes by moving one node at a
/// time: slow. Nodes in order of the edges, faces and cells, all of each, zero where nothing moves.
[[nodiscard]] Points naive_volume_step(const CurvedMesh& curved, const NaiveMarching& options);
[[nodiscard]] Points naive_surface_step(const CurvedMesh& curved, const NaiveMarching& options,
                                        const std::vector<Index>& faces);

}  // namespace camber::reference
