#pragma once
// A smooth geometry from a surface mesh alone, where there is no CAD.
#include <camber/geom/geometry_model.hpp>
#include <camber/reconstruct/features.hpp>

#include <memory>

namespace camber {

/// Geometry through the points of a surface mesh: smooth regions are faces (tag = region + 1),
/// chains of sharp edges curves (chain + 1), corners vertices.
class ReconstructedModel : public GeometryModel {
 public:
  [[nodiscard]] virtual const Features& features() const = 0;
  /// Places where too few points in general position allowed no curved fit; flat there.
  [[nodiscard]] virtual std::size_t flat_corners() const = 0;
};

/// Fits a polynomial of degree 4 to the surroundings of every vertex inside its smooth region (one
/// a side on sharp edges), blends these over the facets, and likewise along chains; patches of
/// order 4 that meet without gaps hold the result. Passes through all points. On smooth parts the
/// distance to the surface that the points were taken from falls with the fifth power of the
/// facets' size; next to sharp edges, where the surroundings are one-sided, with a larger constant.
/// Sources: Jiao and Zha 2008, doi 10.1145/1364901.1364924; Jiao and Wang 2012,
/// doi 10.1007/s00366-011-0228-y.
/// @throws GeometryError if there are no facets or one has no area. Threads: parallel inside.
[[nodiscard]] std::unique_ptr<ReconstructedModel> reconstruct(const FacetMesh& mesh,
                                                              const FeatureOptions& options = {});

}  // namespace camber
