#include <camber/base/parallel.hpp>
#include <camber/smooth/detail/group_solver.hpp>

#include <algorithm>
#include <utility>

namespace camber::detail {
namespace {

/// Added to the diagonal, relative to it: groups that rounding left barely definite.
constexpr double k_shift = 1e-14;

}  // namespace

GroupSolver::GroupSolver(std::vector<std::vector<Index>> groups, const std::vector<MatX>& blocks)
    : groups_(std::move(groups)), factors_(blocks.size()) {
  parallel_for(blocks.size(), 32, [&](std::size_t begin, std::size_t end) {
    for (std::size_t g = begin; g < end; ++g) {
      MatX shifted = blocks[g];
      shifted.diagonal() *= 1.0 + k_shift;
      const Eigen::LLT<MatX> factor(shifted);
      factors_[g] = factor.info() == Eigen::Success
                        ? MatX(factor.matrixL())
                        : MatX(shifted.diagonal().cwiseSqrt().asDiagonal());
    }
  });
}

GroupSolver GroupSolver::across_thin_cells(CellEnergy& energy) {
  std::vector<std::vector<Index>> groups = energy.thin_groups();
  const std::vector<MatX> blocks = energy.diagonal_blocks(groups);
  return {std::move(groups), blocks};
}

void GroupSolver::solve(const VecX& r, VecX& z) const {
  z.resize(r.size());
  parallel_for(groups_.size(), 128, [&](std::size_t begin, std::size_t end) {
    Eigen::Matrix<double, Eigen::Dynamic, 3> own;
    for (std::size_t g = begin; g < end; ++g) {
      const std::vector<Index>& group = groups_[g];
      const auto n = static_cast<Eigen::Index>(group.size());
      own.resize(n, 3);
      for (Eigen::Index k = 0; k < n; ++k) {
        own.row(k) = r.segment<3>(3 * group[static_cast<std::size_t>(k)]).transpose();
      }
      const auto lower = factors_[g].triangularView<Eigen::Lower>();
      lower.solveInPlace(own);
      lower.transpose().solveInPlace(own);
      for (Eigen::Index k = 0; k < n; ++k) {
        z.segment<3>(3 * group[static_cast<std::size_t>(k)]) = own.row(k).transpose();
      }
    }
  });
}

double GroupSolver::squared_norm(const VecX& v) const {
  double sum = 0.0;
  Eigen::Matrix<double, Eigen::Dynamic, 3> own;
  for (std::size_t g = 0; g < groups_.size(); ++g) {
    const std::vector<Index>& group = groups_[g];
    own.resize(static_cast<Eigen::Index>(group.size()), 3);
    for (std::size_t k = 0; k < group.size(); ++k) {
      own.row(static_cast<Eigen::Index>(k)) = v.segment<3>(3 * group[k]).transpose();
    }
    sum += (factors_[g].triangularView<Eigen::Lower>().transpose() * own).squaredNorm();
  }
  return sum;
}

std::size_t GroupSolver::largest_group() const {
  std::size_t largest = 0;
  for (const std::vector<Index>& group : groups_) largest = std::max(largest, group.size());
  return largest;
}

}  // namespace camber::detail
