#pragma once
// Global searches and arc length on a curve.
#include <camber/geom/box_tree.hpp>
#include <camber/geom/foot.hpp>

#include <optional>
#include <vector>

namespace camber {

/// Nearly straight pieces of a curve with boxes and lengths. Immutable: const calls from many
/// threads.
class CurveTree {
 public:
  /// @param curve kept by reference
  explicit CurveTree(const ParametricCurve& curve);

  /// Diagonal of the box of all pieces: the length that tolerances refer to.
  [[nodiscard]] double size() const { return size_; }
  [[nodiscard]] const Box& box() const { return box_; }
  /// Whole arc length, to about 1e-13 of itself.
  [[nodiscard]] double length() const {
    return pieces_.back().length_before + pieces_.back().length;
  }

  /// Nearest point of the curve, ends included, if nearer than sqrt(bound): else nothing.
  [[nodiscard]] std::optional<CurveFoot> nearest(const Vec3& x, double bound) const;

  /// Arc length from the curve's first point to t; closed curves: any t, counted in turns.
  [[nodiscard]] double length_to(double t) const;
  /// Inverse of length_to, to 1e-13 of the whole length.
  [[nodiscard]] double parameter_at(double length) const;

 private:
  struct Piece {
    double t0, t1;
    double length_before, length;
  };
  void split(double t0, double t1, double rough_length, int depth);
  [[nodiscard]] double stretch(double t0, double t1) const;  // Gauss, one smooth piece

  const ParametricCurve& curve_;
  double size_ = 0.0;
  Box box_;
  std::vector<Piece> pieces_;
  BoxTree tree_;
};

}  // namespace camber
