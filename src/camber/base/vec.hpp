#pragma once
// Small fixed-size linear algebra, used everywhere.
#include <vector>

#include <Eigen/Dense>

namespace camber {

using Vec2 = Eigen::Vector2d;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;
using MatX = Eigen::MatrixXd;
using VecX = Eigen::VectorXd;
using Points = std::vector<Vec3>;

/// Axis-aligned box; empty until the first point is added.
struct Box {
  Vec3 lower = Vec3::Constant(1e300);
  Vec3 upper = Vec3::Constant(-1e300);

  void add(const Vec3& x) {
    lower = lower.cwiseMin(x);
    upper = upper.cwiseMax(x);
  }
  void add(const Box& b) {
    lower = lower.cwiseMin(b.lower);
    upper = upper.cwiseMax(b.upper);
  }
  [[nodiscard]] bool is_empty() const { return lower.x() > upper.x(); }
  [[nodiscard]] double diagonal() const { return is_empty() ? 0.0 : (upper - lower).norm(); }
  [[nodiscard]] Vec3 centre() const { return 0.5 * (lower + upper); }
};

}  // namespace camber
