#pragma once
// The curve through a chain of sharp edges.
#include <camber/geom/curve_tree.hpp>
#include <camber/reconstruct/detail/facet_patch.hpp>
#include <camber/reconstruct/features.hpp>

#include <array>
#include <memory>
#include <vector>

namespace camber::detail {

/// Polynomials of order 4 from vertex to vertex; vertex i is at t = i. Each blends the curves
/// fitted at its two ends (fit_curve_at):  x(s) = (1 - s) x_a(s) + s x_b(s)  at s = k / 4.
class ChainCurve final : public ParametricCurve {
 public:
  ChainCurve(const FacetMesh& mesh, const Chain& chain);

  [[nodiscard]] CurveJet jet(double t) const override;
  [[nodiscard]] double first() const override { return 0.0; }
  [[nodiscard]] double last() const override { return static_cast<double>(segments_.size()); }
  [[nodiscard]] double period() const override { return is_closed_ ? last() : 0.0; }
  [[nodiscard]] std::vector<double> breaks() const override;

  /// The five nodes of a segment, from vertex i to i + 1.
  [[nodiscard]] const std::array<Vec3, k_patch_order + 1>& nodes(std::size_t segment) const {
    return nodes_[segment];
  }
  [[nodiscard]] std::size_t segment_count() const { return segments_.size(); }

 private:
  bool is_closed_;
  std::vector<std::array<Vec3, k_patch_order + 1>> nodes_, segments_;  // segments: of s^k
};

}  // namespace camber::detail
