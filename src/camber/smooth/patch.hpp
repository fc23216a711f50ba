#pragma once
// Repairs small groups of cells by moving only nodes inside the volume.
#include <camber/mesh/curved_mesh.hpp>

#include <cstdint>
#include <vector>

namespace camber {

/// Entities whose nodes must stay: everything on the boundary or on a wall.
struct FixedEntities {
  std::vector<std::uint8_t> edge, face;
};
/// Boundary faces, patch faces and their edges are fixed.
[[nodiscard]] FixedEntities boundary_entities(const Topology& topology);
/// By high-order node: not on an entity of boundary_entities(), nor on one of the cells that are to
/// stay as they are.
[[nodiscard]] std::vector<std::uint8_t> free_nodes(const CurvedMesh& curved,
                                                   const std::vector<Index>& frozen_cells = {});

struct UntangleOptions {
  int rings = 3;        // layers of neighbours whose nodes may move too
  int max_rounds = 12;  // of regularisation
  int iterations_per_round = 40;
  std::size_t max_cells = 4000;  // a larger patch is left alone
  // Work limits, counted in evaluations of one cell of order 2 (a cell of order 3 counts twice, of
  // order 4 four times): for one group, and for all groups of a call.
  std::size_t evaluations_per_group = 400000, evaluations = 1000000;
};

struct UntangleResult {
  std::size_t patches = 0, repaired = 0;  // connected groups tried, and certified afterwards
  std::vector<Index> mended;              // first cell of each group repaired
  std::size_t load_steps = 0;             // of groups that only these repaired
  std::vector<Index> still_bad;           // cells of groups that were put back as they were
  std::size_t evaluations = 0;            // of one cell, spent
};

/// For each connected group of uncertified cells: minimises the distortion energy over the nodes
/// (free_nodes) of the group and its rings (L-BFGS, scaled by the diagonal of the energy's metric
/// part), regularised while something is inverted, until every cell it touches is certified: from
/// the nodes as they are, from the cells straight, and in steps of load from near the straight
/// copy; else the group is put back as it was. Energy: Gauss points with weights of equal sum per
/// cell, plus the lattice points with little weight, plus points where a certificate failed.
/// Deterministic.
UntangleResult untangle(CurvedMesh& curved, const std::vector<Index>& uncertified,
                        const UntangleOptions& options = {});

}  // namespace camber
