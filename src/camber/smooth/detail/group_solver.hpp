#pragma once
// An approximate inverse of a stiffness: exact on groups of unknowns, nothing between them.
#include <camber/smooth/detail/cell_energy.hpp>
#include <camber/smooth/lbfgs.hpp>

#include <vector>

namespace camber::detail {

/// Dense Cholesky factors of the blocks of K over groups of nodes, the same for each component: of
/// a layered mesh the lines across the layers, where K is stiff by the square of the aspect ratio,
/// and single nodes elsewhere.
class GroupSolver : public InitialHessian {
 public:
  /// @param blocks  symmetric positive definite, one a group (CellEnergy::diagonal_blocks)
  GroupSolver(std::vector<std::vector<Index>> groups, const std::vector<MatX>& blocks);
  /// Over the thin groups of an energy.
  [[nodiscard]] static GroupSolver across_thin_cells(CellEnergy& energy);

  /// z = B^-1 r, three entries a node.
  void solve(const VecX& r, VecX& z) const override;
  [[nodiscard]] double squared_norm(const VecX& v) const override;
  [[nodiscard]] std::size_t largest_group() const;

 private:
  std::vector<std::vector<Index>> groups_;
  std::vector<MatX> factors_;  // lower triangular
};

}  // namespace camber::detail
