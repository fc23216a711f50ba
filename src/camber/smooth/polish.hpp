#pragma once
// Quality of a certified mesh: only patches that fail the target are touched.
#include <camber/mesh/curved_mesh.hpp>
#include <camber/smooth/smooth_row.hpp>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace camber {

struct PolishOptions {
  double cost_target = 0.6;          // cells whose lowest C, eq. (2), is below are polished
  double kept_cost = 0.95;           // cells at or above stay so
  int rings = 3;                     // layers of neighbours whose nodes may move too
  int max_evaluations = 15;          // of the energy and its gradient, a patch
  double gradient_tolerance = 0.05;  // at which a patch counts as optimal, relative to the first
  std::size_t max_cells = 20000;     // a larger patch is left alone
};

struct PolishResult {
  std::size_t patches = 0, improved = 0;
  std::size_t seeds = 0;        // cells below the target at the start
  std::size_t evaluations = 0;  // of one cell, spent
  // Sums over the patches of the energy where it started and the least that was found (before
  // nodes are put back).
  double energy_at_start = 0.0, energy_at_end = 0.0;
  std::vector<SmoothRow> rows;  // one a patch, and one at the end
};

/// Raises low costs. Cells below the target and their rings form patches; in each the sum of
/// (WCN (1 + max(0, 1/tau - 1)^2))^4 over the samples of all touched cells, 1/C with a smooth cap,
/// is minimised over the free nodes by L-BFGS with exact solves across thin cells as initial
/// Hessian. Nodes of cells that came out worse (not certified, below the lowest cost of the patch,
/// out of the kept costs, or clearly lower than they were) are put back until none did; a patch
/// whose mean cost did not rise then is put back whole. Needs certified cells. Deterministic for
/// any number of threads.
/// @param is_free  by high-order node; cells without any are no seeds
/// @param costs    lowest C of every cell of the mesh (1 for cells of order 1); updated
PolishResult polish(CurvedMesh& curved, const std::vector<std::uint8_t>& is_free,
                    std::vector<double>& costs, const PolishOptions& options = {},
                    const SmoothListener& listener = {});

/// Lowest C, eq. (2), of every cell (or of some) at the points of element_cost; 1 for cells of
/// order 1.
[[nodiscard]] std::vector<double> cell_costs(const CurvedMesh& curved);
[[nodiscard]] std::vector<double> cell_costs(const CurvedMesh& curved,
                                             const std::vector<Index>& cells);

}  // namespace camber
