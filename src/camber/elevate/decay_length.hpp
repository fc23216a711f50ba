#pragma once
// How far the wall's displacement reaches into the volume.
#include <camber/elevate/columns.hpp>
#include <camber/elevate/face_tree.hpp>
#include <camber/elevate/placement.hpp>

#include <vector>

namespace camber {

/// What carries the wall's displacement.
enum class Decay {
  layer,  // the whole boundary layer, smoothly over about one surface edge
  cell    // the cells on the wall alone, linearly: the paper's transfer (2.2.4)
};

struct LayerFieldOptions {
  double reach = 1.0;              // c_L: decay length per surface edge length
  double reach_per_sagitta = 5.0;  // and at least this many wall displacements
  Decay decay = Decay::layer;
};

/// phi(s) = (1-s)^2 (1+2s) on [0,1], 0 beyond: 1 and flat at the wall.
[[nodiscard]] double decay(double s);

/// Decay length L at every wall vertex, 0 elsewhere [length].
///   layer: L = max(reach * (mean wall edge at the vertex), reach_per_sagitta * (largest |d| around
///   it)); shorter under flat cells on top of the layers, whose apex, a vertex, stays: there the
///   displacement left, |d| phi(t / L) at the top of a column of height t, may be k_cap_share of
///   the cell's height, if L = k_least_reach |d| gets that far down
///   cell:  L = height of the lowest cell on the wall faces around it; the other options do not
///   count
[[nodiscard]] std::vector<double> decay_lengths(const LinearMesh& mesh, const Topology& topology,
                                                const Wall& wall, const Placement& placement,
                                                const Columns& columns,
                                                const LayerFieldOptions& options);

/// Shortens lengths so that the decay ends before the middle between two facing walls. The middle:
/// a ball that touches the wall at the vertex from inside the fluid is shrunk until it is empty.
/// Threads: runs parallel inside.
void limit_lengths_in_gaps(const LinearMesh& mesh, const Wall& wall, const FaceTree& wall_tree,
                           std::vector<double>& length);

}  // namespace camber
