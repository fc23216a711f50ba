#pragma once
// The displacement of the wall spread into the volume by one linear solve.
#include <camber/mesh/curved_mesh.hpp>

#include <cstdint>
#include <vector>

namespace camber {

struct ElasticOptions {
  double tolerance = 1e-7;  // of the residual, in the norm of the approximate inverse
  int max_products = 400;
};
struct ElasticResult {
  int products = 0;       // with the stiffness
  double residual = 0.0;  // relative, at the end
  bool is_converged = true;
  std::vector<Index> cells;  // sorted: those whose nodes took part
  std::size_t unknowns = 0, largest_group = 0;
};

/// Minimises sum over cells of the mean of |T - I|^2, T = A W^-1, over the displacement of the free
/// nodes: elasticity without coupling of the components (nu = 0), equal weight per cell, that is
/// stiffness 1 / volume. The solution does not depend on what the free nodes were. Conjugate
/// gradients, preconditioned by exact solves across thin cells (detail/group_solver.hpp); same bits
/// for any number of threads.
/// @param cells    sorted, of order 2 or more: those whose nodes take part
/// @param is_free  by high-order node
ElasticResult relax_elastic(CurvedMesh& curved, const std::vector<Index>& cells,
                            const std::vector<std::uint8_t>& is_free,
                            const ElasticOptions& options = {});

/// The same around some cells only: nodes of the cells within `rings` of them move, all others
/// stay.
ElasticResult relax_elastic_around(CurvedMesh& curved, const std::vector<Index>& core, int rings,
                                   const std::vector<std::uint8_t>& is_free,
                                   const ElasticOptions& options = {});

}  // namespace camber
