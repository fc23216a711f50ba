#pragma once
// Node orders of the file formats, built by matching lattice points, never typed in.
#include <camber/basis/lattice.hpp>

#include <span>
#include <vector>

namespace camber {

enum class NodeConvention { gmsh, cgns, vtk, su2 };

/// Lattice points of the full Lagrange element in the file's order.
/// Sources: SIDS (CGNS, CPEX 0036/0038), Gmsh manual "Node ordering", VTK Lagrange cells >= 9.0,
/// SU2: canonical order for p >= 2, corners for p = 1. VTK has no Lagrange pyramid: throws
/// std::invalid_argument for (vtk, pyramid, p > 1).
[[nodiscard]] std::span<const LatticePoint> node_order(NodeConvention convention, Shape shape,
                                                       int p);

/// file2canonical[n] = canonical node at place n of the file's order. Cached; any thread.
[[nodiscard]] std::span<const int> file_to_canonical(NodeConvention convention, Shape shape, int p);

}  // namespace camber
