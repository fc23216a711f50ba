#include <camber/smooth/detail/sliding_nodes.hpp>

#include <algorithm>

namespace camber::detail {
namespace {

/// Where the two directions of a surface are closer to parallel than this (a pole) a node stays.
constexpr double k_least_rcond = 1e-8;

Eigen::Matrix<double, 3, 2> tangents_of(const SurfaceSample& s) {
  Eigen::Matrix<double, 3, 2> tangents;
  tangents << s.du, s.dv;
  return tangents;
}

}  // namespace

SlidingNodes::SlidingNodes(const SurfacePatch& patch, const OnSurface& on_surface)
    : on_surface_(on_surface), x_(patch.nodes) {
  for (std::size_t i = 0; i < patch.nodes.size(); ++i) {
    if (!patch.is_free[i]) continue;
    const Eigen::Matrix<double, 3, 2> tangents =
        tangents_of(on_surface(static_cast<Index>(i), patch.uv[i]));
    const Eigen::LLT<Eigen::Matrix2d> metric(tangents.transpose() * tangents);
    if (metric.info() != Eigen::Success || !(metric.rcond() > k_least_rcond)) continue;
    free_nodes_.push_back(static_cast<Index>(i));
    start_.push_back(patch.uv[i]);
    scale_.push_back(metric.matrixU().solve(Eigen::Matrix2d::Identity()));
  }
  tangents_.resize(free_nodes_.size());
}

Vec2 SlidingNodes::parameters(std::size_t k, const VecX& t) const {
  return start_[k] + scale_[k] * t.segment<2>(2 * static_cast<Eigen::Index>(k));
}

const Points& SlidingNodes::place(const VecX& t) {
  for (std::size_t k = 0; k < free_nodes_.size(); ++k) {
    const SurfaceSample s = on_surface_(free_nodes_[k], parameters(k, t));
    x_[at(free_nodes_[k])] = s.point;
    tangents_[k] = tangents_of(s);
  }
  return x_;
}

void SlidingNodes::pull_back(const Points& slope, VecX& gradient) const {
  gradient.resize(size());
  for (std::size_t k = 0; k < free_nodes_.size(); ++k) {
    gradient.segment<2>(2 * static_cast<Eigen::Index>(k)) =
        (tangents_[k] * scale_[k]).transpose() * slope[at(free_nodes_[k])];
  }
}

VecX SlidingNodes::inverse_diagonal(const std::vector<double>& stiffness) const {
  VecX inverse(size());
  for (std::size_t k = 0; k < free_nodes_.size(); ++k) {
    inverse.segment<2>(2 * static_cast<Eigen::Index>(k))
        .setConstant(1.0 / std::max(stiffness[at(free_nodes_[k])], 1e-300));
  }
  return inverse;
}

void SlidingNodes::store(const VecX& t, SurfacePatch& patch) const {
  for (std::size_t k = 0; k < free_nodes_.size(); ++k) {
    const std::size_t node = at(free_nodes_[k]);
    patch.uv[node] = parameters(k, t);
    patch.nodes[node] = on_surface_(free_nodes_[k], patch.uv[node]).point;
  }
}

}  // namespace camber::detail
