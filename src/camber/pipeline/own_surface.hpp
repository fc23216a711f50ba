#pragma once
// Meshes without CAD: curved onto a smooth surface through their own boundary vertices.
#include <camber/associate/given_link.hpp>
#include <camber/pipeline/curve.hpp>
#include <camber/reconstruct/reconstruct.hpp>

#include <array>
#include <map>
#include <memory>

namespace camber {

/// Which face or curve of a reconstructed geometry every boundary entity of a mesh is on, by the
/// node numbers of its file, sorted ([3] = -1 for triangles): valid as long as its boundary is.
struct SurfaceLink {
  std::map<std::array<GlobalId, 4>, int> face;
  std::map<std::array<GlobalId, 2>, int> curve;
};

struct OwnSurface {
  std::unique_ptr<ReconstructedModel> model;
  SurfaceLink link;
};

/// The geometry of all boundary faces, walked so that its normals point out of the cells.
/// @throws GeometryError (reconstruct/reconstruct.hpp)
[[nodiscard]] OwnSurface reconstruct_boundary(const LinearMesh& mesh, const Topology& topology,
                                              const FeatureOptions& options = {});

[[nodiscard]] GivenLink given_link(const SurfaceLink& link, const LinearMesh& mesh,
                                   const Topology& topology);

/// curve() onto reconstruct_boundary(): the link is known, deviations are those to this surface.
/// @throws MeshError, OptionError, GeometryError
[[nodiscard]] CurveResult curve_without_cad(const MeshData& data, const FeatureOptions& features,
                                            CurveOptions options, const Progress& progress = {});
/// The same for less memory: `data` is emptied on the way.
[[nodiscard]] CurveResult curve_without_cad(MeshData&& data, const FeatureOptions& features,
                                            CurveOptions options, const Progress& progress = {});

}  // namespace camber
