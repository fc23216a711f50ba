#pragma once
// Shape of wall faces as an energy: the surface form of the weighted condition number.
#include <camber/smooth/surface_patch.hpp>

#include <vector>

namespace camber::detail {

/// Sum over faces of the mean of |T|^2 / (2 h(tau)), T = J W^-1 (3 x 2), tau = (dT/dx x dT/dy) . n,
/// h of smooth/distortion.hpp, n the unit interpolation of the corner normals: see smooth_surface.
/// Samples: Gauss points with weights of sum 1 a face, and the lattice of twice the order with
/// little weight, so that corners and edges are watched.
class SurfaceEnergy {
 public:
  /// Ideal shapes (W) are taken from the nodes as they are in the patch.
  explicit SurfaceEnergy(const SurfacePatch& patch);

  /// @param x      positions of all nodes of the patch
  /// @param delta  regularisation; 0: infinite where some tau <= 0
  /// @param slope  dE/dx is added, node by node
  /// @param least  if given, the least tau of all samples
  double evaluate(const Points& x, double delta, Points& slope, double* least = nullptr) const;
  /// Adds each node's share of the energy's metric part: sum of weight |dN/dx W^-1|^2.
  void add_stiffness(std::vector<double>& stiffness) const;
  [[nodiscard]] double least_tau(const Points& x) const;
  [[nodiscard]] std::size_t face_count() const { return faces_.size(); }

 private:
  struct Sample {
    Eigen::Matrix2d W_inverse;
    double weight = 0.0;
    Vec3 normal;
    MatX gradient;  // nodes x 2
  };
  struct Face {
    std::vector<Index> nodes;
    std::vector<Sample> samples;
  };
  [[nodiscard]] static Face sample(const SurfacePatch& patch, const SurfaceFace& face);

  std::vector<Face> faces_;
};

}  // namespace camber::detail
