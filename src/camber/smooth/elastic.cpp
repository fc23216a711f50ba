#include <camber/smooth/detail/cell_groups.hpp>
#include <camber/smooth/detail/group_solver.hpp>
#include <camber/smooth/elastic.hpp>

#include <cmath>

namespace camber {
namespace {

/// Cells from which on a region grows no further ring.
constexpr std::size_t k_enough_around = 10000;

}  // namespace

ElasticResult relax_elastic(CurvedMesh& curved, const std::vector<Index>& cells,
                            const std::vector<std::uint8_t>& is_free,
                            const ElasticOptions& options) {
  const CurvedMesh straight(curved.linear(), curved.topology(), curved.orders());
  detail::CellEnergy energy(curved, cells, is_free);
  ElasticResult result;
  result.cells = cells;
  result.unknowns = energy.unknowns().size();
  if (result.unknowns == 0) return result;
  const detail::GroupSolver solver = detail::GroupSolver::across_thin_cells(energy);
  result.largest_group = solver.largest_group();

  VecX u = VecX::Zero(energy.size()), r = energy.load(curved, straight), z, Kp;
  solver.solve(r, z);
  VecX p = z;
  double rz = r.dot(z);
  const double first = rz;
  while (result.products < options.max_products &&
         rz > options.tolerance * options.tolerance * first) {
    energy.apply_stiffness(p, Kp);
    ++result.products;
    const double alpha = rz / p.dot(Kp);
    u += alpha * p;
    r -= alpha * Kp;
    solver.solve(r, z);
    const double next = r.dot(z);
    p = z + (next / rz) * p;
    rz = next;
  }
  result.residual = first > 0.0 ? std::sqrt(rz / first) : 0.0;
  result.is_converged = result.residual <= options.tolerance;
  energy.store(energy.positions(straight) + u, curved);
  return result;
}

ElasticResult relax_elastic_around(CurvedMesh& curved, const std::vector<Index>& core, int rings,
                                   const std::vector<std::uint8_t>& is_free,
                                   const ElasticOptions& options) {
  std::vector<Index> grown = core;
  for (int ring = 0; ring < rings && grown.size() < k_enough_around; ++ring) {
    grown = with_neighbours(curved.topology(), grown);
  }
  return relax_elastic(curved, detail::curved_neighbours(curved, grown),
                       detail::nodes_of(curved, grown, is_free), options);
}

}  // namespace camber
