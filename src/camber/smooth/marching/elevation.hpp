#pragma once
// The paper's deviation test inside the volume, made while smoothing.
#include <camber/smooth/marching/march_problem.hpp>
#include <camber/smooth/marching/marcher.hpp>

#include <cstdint>
#include <vector>

namespace camber {

struct ElevationOptions {
  int max_order = 4;
  double volume_deviation = 0.05;  // threshold, a share of the cell's shortest edge
  int sweeps = 50;                 // that a released interface may march
  MarcherOptions marching;
};

/// Cells that a neighbour of higher order asks to be raised, sorted.
/// The paper tests "nodes on the higher order side against the lower order shape" (2.2.3). Here
/// both sides carry the lower order's shape at all times, so the higher side is asked what it
/// would do: on a copy every edge and face between a cell of order p and one of lower order r < p
/// gets order r + 1 (the same shape at first), and its nodes (with those inside the cells of
/// higher order) march for some sweeps by the costs of the cells of higher order alone. The lower
/// cells are marked if the nodes are then farther from the shape of order r through the same edge
/// or face than the threshold times the shortest linear edge of the lower cell. Deterministic.
[[nodiscard]] std::vector<Index> cells_to_raise(const CurvedMesh& curved,
                                                const FixedEntities& fixed,
                                                const ElevationOptions& options);

/// Orders after raising the cells by one and limiting the jump between face neighbours to one.
[[nodiscard]] std::vector<std::uint8_t> raised_orders(const CurvedMesh& curved,
                                                      const std::vector<Index>& cells);

/// Largest distance, at the lattice of order q, between an edge's or face's polynomial and the one
/// of order q - 1 that interpolates it [length].
/// @param nodes  of order q, canonical order
[[nodiscard]] double distance_to_lower_order(Shape shape, int q, std::span<const Vec3> nodes);

}  // namespace camber
