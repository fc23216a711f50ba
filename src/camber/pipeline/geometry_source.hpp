#pragma once
// Geometry that is no CAD file: analytic surfaces and finer linear meshes.
#include <camber/pipeline/options.hpp>
#include <camber/reconstruct/reconstruct.hpp>

#include <memory>
#include <string>

namespace camber {

/// True for what make_geometry() takes: an analytic surface (geom/primitive.hpp), an .stl file or a
/// .msh file.
[[nodiscard]] bool is_geometry_without_cad(const std::string& source);

/// The analytic surface; or a smooth geometry (reconstruct/reconstruct.hpp) through the triangles
/// of the STL file or the surface elements of the mesh, of which only the corners count. Lengths in
/// the unit of the mesh to be curved; such a geometry has no tags for it.
/// @throws OptionError, FileError, GeometryError
[[nodiscard]] std::unique_ptr<GeometryModel> make_geometry(const std::string& source,
                                                           const FeatureOptions& features = {});

/// What such a geometry means for a run unless the options say otherwise: it is linked by shape,
/// in the unit of the mesh.
void link_without_cad(CurveOptions& options);

}  // namespace camber
