#pragma once
// The patches of a reconstructed surface, searchable by region.
#include <camber/geom/box_tree.hpp>
#include <camber/reconstruct/detail/chain_curve.hpp>
#include <camber/reconstruct/detail/facet_patch.hpp>
#include <camber/reconstruct/features.hpp>

#include <optional>
#include <vector>

namespace camber::detail {

/// A point of a facet.
struct FacetFoot {
  Index facet = k_none;
  SurfaceFoot foot;
};

/// Parameters of a whole region: facet and its own u, v in one pair,
///   U = u + 4 (facet mod 4096),   V = v + 4 (facet div 4096),   -1 <= u, v < 3,
/// so that a search may step a little out of a facet and still means it.
[[nodiscard]] Vec2 packed(Index facet, const Vec2& uv);
[[nodiscard]] std::pair<Index, Vec2> unpacked(const Vec2& uv);

/// Immutable after construction: const calls from many threads.
class FacetSet {
 public:
  /// Patches blend the surfaces fitted at their corners (fit_surface_at, WALF of Jiao and Wang
  /// 2012, doi 10.1007/s00366-011-0228-y):  x(xi) = sum_i w_i(xi) x_i(xi),  w the linear weights,
  /// at the lattice nodes of order 4; on sharp edges they follow the chains.
  FacetSet(const FacetMesh& mesh, const Features& features, const std::vector<ChainCurve>& curves);

  [[nodiscard]] const FacetPatch& patch(Index facet) const { return patches_[at(facet)]; }
  [[nodiscard]] std::size_t count() const { return patches_.size(); }
  [[nodiscard]] const Box& box(int region) const { return regions_[at(region)].box; }
  [[nodiscard]] bool is_planar(int region) const { return regions_[at(region)].is_planar; }

  [[nodiscard]] FacetFoot closest(int region, const Vec3& x, const std::optional<Vec2>& seed) const;
  [[nodiscard]] FacetFoot crossing(int region, const Vec3& x, const Vec3& d, double max_distance,
                                   const std::optional<Vec2>& seed) const;
  /// uv is on an edge that bounds the region.
  [[nodiscard]] bool is_on_rim(Index facet, const Vec2& uv) const;
  /// Corners whose surface could not be fitted by a curved one (degree below 2).
  [[nodiscard]] std::size_t flat_corners() const { return flat_corners_; }

 private:
  struct Region {
    std::vector<Index> facets;
    BoxTree tree;
    Box box;
    bool is_planar = false;
  };
  static constexpr double k_on_edge = 1e-9;

  std::vector<FacetPatch> patches_;
  std::vector<unsigned> sharp_edges_;  // by facet, bits
  std::vector<int> region_of_;
  std::vector<Region> regions_;
  std::size_t flat_corners_ = 0;
};

}  // namespace camber::detail
