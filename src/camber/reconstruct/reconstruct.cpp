#include <camber/base/error.hpp>
#include <camber/reconstruct/detail/facet_model.hpp>
#include <camber/reconstruct/reconstruct.hpp>

#include <fmt/format.h>

namespace camber {

std::unique_ptr<ReconstructedModel> reconstruct(const FacetMesh& mesh,
                                                const FeatureOptions& options) {
  if (mesh.facets.empty()) {
    throw GeometryError("there is no surface to make a geometry from", "the mesh",
                        "give a mesh with boundary faces, or a CAD file with -g");
  }
  for (Index f = 0; at(f) < mesh.facets.size(); ++f) {
    if (mesh.area_vector(f).norm() > 0.0) continue;
    const Vec3& x = mesh.points[at(mesh.facets[at(f)][0])];
    throw GeometryError("a boundary face has no area",
                        fmt::format("at ({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z()),
                        "repair the mesh: faces must have an area");
  }
  return std::make_unique<detail::FacetModel>(
      std::make_shared<const detail::FacetBody>(mesh, find_features(mesh, options)));
}

}  // namespace camber
