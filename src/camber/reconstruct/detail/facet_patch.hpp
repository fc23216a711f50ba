#pragma once
// One polynomial patch over a facet.
#include <camber/basis/shape.hpp>
#include <camber/geom/foot.hpp>
#include <camber/geom/parametric.hpp>

#include <array>
#include <optional>
#include <span>

namespace camber::detail {

inline constexpr int k_patch_order = 4;

/// x(u, v) = sum c_ij u^i v^j over the reference triangle or square of shape.hpp; i + j <= 4 on
/// triangles, i, j <= 4 on quadrilaterals. Outside of it the polynomial goes on.
class FacetPatch final : public ParametricSurface {
 public:
  /// @param nodes  lattice of order 4, canonical order
  FacetPatch(Shape shape, std::span<const Vec3> nodes);

  [[nodiscard]] SurfaceJet jet(const Vec2& uv) const override;
  [[nodiscard]] UvBox domain() const override { return {}; }
  [[nodiscard]] Vec2 periods() const override { return Vec2::Zero(); }
  [[nodiscard]] std::vector<double> breaks(int) const override { return {0.0, 1.0}; }

  /// Nearest point of the facet from `start`, else from where the tangent plane at its centre has
  /// it; a local minimum.
  [[nodiscard]] SurfaceFoot closest(const Vec3& x, const std::optional<Vec2>& start) const;
  /// Crossing with the line x + s d (d unit) inside the facet, if the search finds one.
  [[nodiscard]] std::optional<SurfaceFoot> crossing(const Vec3& x, const Vec3& d,
                                                    const std::optional<Vec2>& start) const;
  /// Contains the facet (its Bezier points).
  [[nodiscard]] const Box& box() const { return box_; }
  [[nodiscard]] double size() const { return size_; }
  [[nodiscard]] Vec3 normal(const Vec2& uv) const;  // unit; zero where singular
  /// Local edges (of shape.hpp, by bits) that uv lies on, within `tolerance`.
  [[nodiscard]] unsigned edges_at(const Vec2& uv, double tolerance) const;

 private:
  [[nodiscard]] bool is_triangle() const { return shape_ == Shape::triangle; }
  [[nodiscard]] Vec2 guess(const Vec3& x) const;

  Shape shape_;
  std::array<Vec3, 25> c_;  // c[5 j + i]
  Box box_;
  double size_;
};

}  // namespace camber::detail
