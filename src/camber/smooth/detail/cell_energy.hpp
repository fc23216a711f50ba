#pragma once
// An energy summed over cells as a function of the high-order nodes that may move.
#include <camber/mesh/node_map.hpp>
#include <camber/smooth/detail/energy_plan.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace camber::detail {

/// Energy of some cells; the unknowns are all free high-order nodes they depend on, three entries a
/// node. Cells are evaluated in the lanes of the processor, by all threads; sums run in a fixed
/// order, so that results have the same bits for any number of threads and lanes.
class CellEnergy {
 public:
  /// @param cells    sorted, of order 2 or more
  /// @param is_free  by high-order node of the mesh (CurvedMesh::high_order_nodes)
  CellEnergy(const CurvedMesh& curved, const std::vector<Index>& cells,
             const std::vector<std::uint8_t>& is_free);

  [[nodiscard]] const std::vector<Index>& cells() const { return map_.cells(); }
  /// High-order nodes of the mesh that are unknowns, in the order of the vector.
  [[nodiscard]] const std::vector<Index>& unknowns() const { return unknowns_; }
  [[nodiscard]] Eigen::Index size() const {
    return 3 * static_cast<Eigen::Index>(unknowns_.size());
  }
  /// Unknowns that the i-th cell depends on, sorted.
  [[nodiscard]] std::vector<Index> unknowns_of(std::size_t i) const;
  [[nodiscard]] VecX positions(const CurvedMesh& curved) const;
  void store(const VecX& x, CurvedMesh& curved) const;

  /// Sum over cells; fills the gradient. Infinite where the kind says so.
  /// @param least  if given, the smallest det T of all samples (of shape and quality)
  double evaluate(EnergyKind kind, const VecX& x, double delta, VecX& gradient,
                  double* least = nullptr);
  /// K v, K the stiffness of the metric energy |T|^2 / 2: sum over cells and samples of
  /// weight (W^-T grad N_i) . (W^-T grad N_j), the same for each component.
  void apply_stiffness(const VecX& v, VecX& result);
  /// The load of that stiffness from the nodes that are fixed, with the straight copy taken off:
  /// K (x - X) = 0 inside is K v = load for the displacement v of the free nodes.
  [[nodiscard]] VecX load(const CurvedMesh& curved, const CurvedMesh& straight);
  /// Entries of K between the given groups of unknowns: one dense matrix a group.
  [[nodiscard]] std::vector<MatX> diagonal_blocks(const std::vector<std::vector<Index>>& groups);
  /// Groups of unknowns that thin cells tie together: nodes of one cell whose straight places are
  /// nearer than a share of the spacing along it. Every unknown is in one group.
  [[nodiscard]] std::vector<std::vector<Index>> thin_groups() const;

  /// Another sample of a cell (i-th of cells()), where a certificate failed, for the shape energy.
  void add_sample(std::size_t i, const Vec3& xi);
  /// Energy of single cells at the last evaluate(), beside cells().
  [[nodiscard]] const std::vector<double>& cell_energy() const { return cell_energy_; }

 private:
  struct Batch {
    const EnergyPlan* plan;
    std::vector<std::size_t> cells;  // up to as many as there are lanes
  };
  struct Extra {
    std::size_t cell;
    MatX gradient;  // nodes x 3
    Mat3 W_inverse;
  };
  struct Column {
    Index unknown = k_none;  // number, or -1 where fixed
    Vec3 fixed = Vec3::Zero();
  };
  void place_columns(const VecX& x, bool with_fixed);
  [[nodiscard]] Vec3 node(std::size_t row) const;
  /// The unknown that a node is, or -1 if it is fixed or depends on several.
  [[nodiscard]] Index sole_unknown(std::size_t row) const;
  void evaluate_batch(const Batch& batch, EnergyKind kind, double delta);
  double evaluate_extra(const Extra& extra, double delta, double& least);
  void gather_gradient(VecX& gradient) const;

  const LinearMesh& mesh_;
  NodeMap map_;
  std::vector<int> order_;
  int lanes_;
  std::vector<Index> column_of_;         // entry of the map -> local column
  std::vector<std::size_t> row_offset_;  // row -> first of its entries
  std::vector<double> coefficient_;
  std::vector<Column> columns_;
  std::vector<Index> unknowns_;
  std::vector<std::size_t> unknown_offset_;  // unknown -> its (row, coefficient) pairs
  std::vector<std::size_t> unknown_row_;
  std::vector<double> unknown_coefficient_;
  std::vector<Batch> batches_;
  std::vector<Extra> extras_;
  Points value_;  // by column
  Points slope_;  // by row
  std::vector<double> cell_energy_, cell_least_;
};

}  // namespace camber::detail
