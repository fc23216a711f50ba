#pragma once
// Iterative perturbation-based smoothing, the paper's section 2.2.5, as a whole.
#include <camber/smooth/marching/elevation.hpp>
#include <camber/smooth/marching/marcher.hpp>
#include <camber/smooth/smooth_row.hpp>

#include <vector>

namespace camber {

struct MarchingOptions {
  double relaxation = 0.05;  // the paper's
  double threshold = 0.95;   // convergence: nodes of a higher cost do not move
  int max_sweeps = 400;      // of one pass
  /// A pass ends when its best state was not bettered for so many sweeps by at least `least_gain`
  /// in cost.
  int patience = 50;
  double least_gain = 1e-4;
  /// Sweeps between deviation tests in the volume; doubled after a test that raises nothing.
  int deviation_interval = 50;
  int release_sweeps = 50;         // of a released interface in such a test
  double volume_deviation = 0.05;  // share of a cell's shortest edge
  int max_order = 4;
};

/// Faces that are smoothed together.
struct MarchingSurface {
  std::vector<Index> faces;
  FixedEntities fixed;  // edges and faces whose nodes must not move meanwhile
};

/// Boundary that may be smoothed, and what depends on it.
struct MarchingBoundary {
  std::vector<MarchingSurface> surfaces;  // one after the other
  OntoBoundary onto;                      // keeps their nodes where they belong
  /// Carries the change of a surface from `before` to `after` on to the nodes that are not on it:
  /// the transfer of 2.2.4. Nothing is carried if it is empty.
  std::function<void(const CurvedMesh& before, CurvedMesh& after)> carry;
};

struct MarchingResult {
  std::vector<SmoothRow> rows;
  std::size_t raised_cells = 0;    // in order
  std::vector<Index> uncertified;  // cells at the end, sorted
};

/// Surface smoothing, the transfer of what it changed, then volume smoothing with the boundary
/// fixed. Smoothing goes in passes: the first with normalised Jacobians of sub-simplices; while
/// elements are not certified one more with another level of subdivision, up to two. Every pass
/// leaves the best state it saw: fewest negative elements; of those the highest mean cost while
/// some are negative, else the highest biased average, eq. (5), of the elements' lowest costs, if
/// the worst is not below that of the first. In the volume the deviation test runs every
/// `deviation_interval` sweeps, and raises cells (elevation.hpp); `curved` then gets other orders.
/// Vertices stay. In debug builds neighbours of different order are checked to share their shape
/// before, during and after. Source: [karman2022] 2.2.5. Deterministic for any number of threads.
/// @param listener  gets every row as it is made; what it throws leaves `curved` between two sweeps
MarchingResult smooth_by_marching(CurvedMesh& curved, const MarchingBoundary& boundary,
                                  const MarchingOptions& options,
                                  const SmoothListener& listener = {});

}  // namespace camber
