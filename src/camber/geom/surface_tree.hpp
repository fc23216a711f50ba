#pragma once
// Global searches on a surface: nearly flat patches in a box tree, local searches from the near
// ones.
#include <camber/geom/box_tree.hpp>
#include <camber/geom/foot.hpp>

#include <functional>
#include <memory>
#include <vector>

namespace camber {

/// Patches of a surface over a parameter rectangle, each turning by less than about 25 degrees,
/// with boxes that contain them. Immutable: const calls from many threads.
class SurfaceTree {
 public:
  /// @param surface kept by reference
  /// @param limits  part of the domain to cover (a face's parameter rectangle)
  SurfaceTree(const ParametricSurface& surface, const UvBox& limits);

  /// Diagonal of the box of all patches: the length that tolerances refer to.
  [[nodiscard]] double size() const { return size_; }
  [[nodiscard]] const UvBox& limits() const { return limits_; }
  [[nodiscard]] std::size_t patch_count() const { return patches_.size(); }
  /// Contains every patch; larger than the surface by a part of the patch size.
  [[nodiscard]] const Box& box() const { return box_; }

  /// Offers feet of x in patches nearer than sqrt(bound()) to `take`, which may lower the bound.
  /// Every local minimum nearer than the bound whose patch holds one minimum is among them; the
  /// same foot may be offered more than once. All are within the limits.
  void feet(const Vec3& x, const std::function<double()>& bound,
            const std::function<void(const SurfaceFoot&)>& take) const;

  /// Offers crossings with the line x + s d (d unit) in patches entered at |s| < bound().
  void crossings(const Vec3& x, const Vec3& d, const std::function<double()>& bound,
                 const std::function<void(const SurfaceFoot&)>& take) const;

 private:
  struct Patch {
    UvBox uv;
    Vec3 centre, du, dv;  // S at the centre, half extents along u and v
    double deviation;     // |S - (centre + a du + b dv)|, |a|, |b| <= 1, is at most this
  };
  void split(const UvBox& uv, int depth);

  const ParametricSurface& surface_;
  UvBox limits_;
  double size_ = 0.0;
  Box box_;
  std::vector<Patch> patches_;
  std::vector<Box> boxes_;
  BoxTree tree_;
};

}  // namespace camber
