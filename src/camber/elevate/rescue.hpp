#pragma once
// The last rungs of the ladder: they always end in a certified mesh, because u = 0 is one.
#include <camber/mesh/curved_mesh.hpp>
#include <camber/validity/element_validity.hpp>

#include <vector>

namespace camber {

struct RescueResult {
  std::vector<Index>
      scaled_back;           // cells that were not certified and whose displacement was reduced
  std::vector<double> kept;  // share of the displacement kept, beside scaled_back
  int passes = 0;
};

/// Cells of order >= 2 that are not certified valid, in order of cell number.
[[nodiscard]] std::vector<Index> uncertified_cells(const CurvedMesh& curved,
                                                   const std::vector<Index>& candidates);

/// Reduces the displacement from the straight copy on the edges, faces and inside of every
/// uncertified cell, by halves and then to nothing, until all cells are certified. Only cells that
/// share a reduced entity are tested again. Deterministic; parallel inside.
RescueResult scale_back(CurvedMesh& curved, const std::vector<Index>& uncertified);

}  // namespace camber
