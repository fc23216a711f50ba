#pragma once
// The unknowns of everything that slides wall nodes along the CAD: surface parameters.
#include <camber/smooth/surface_patch.hpp>

#include <vector>

namespace camber::detail {

/// The free nodes of a patch as functions of one vector t, two entries a node:
/// uv = uv0 + M t, M chosen so that dx/dt has orthonormal columns at the start; x = S(uv).
/// Nodes where the two directions of the surface are parallel (poles) stay.
class SlidingNodes {
 public:
  SlidingNodes(const SurfacePatch& patch, const OnSurface& on_surface);

  [[nodiscard]] Eigen::Index size() const {
    return 2 * static_cast<Eigen::Index>(free_nodes_.size());
  }
  /// All nodes of the patch at t; valid until the next call.
  const Points& place(const VecX& t);
  /// dE/dt from dE/dx of all nodes, at the last place().
  void pull_back(const Points& slope, VecX& gradient) const;
  /// One over a positive stiffness of each node, for every unknown.
  [[nodiscard]] VecX inverse_diagonal(const std::vector<double>& stiffness) const;
  /// Puts the free nodes of a patch (the one it was made from) to where t says.
  void store(const VecX& t, SurfacePatch& patch) const;

 private:
  [[nodiscard]] Vec2 parameters(std::size_t k, const VecX& t) const;

  const OnSurface& on_surface_;
  std::vector<Index> free_nodes_;
  std::vector<Vec2> start_;
  std::vector<Eigen::Matrix2d> scale_;
  Points x_;
  std::vector<Eigen::Matrix<double, 3, 2>> tangents_;
};

}  // namespace camber::detail
