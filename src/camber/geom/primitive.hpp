#pragma once
// Analytic surfaces named in one word, for cases whose geometry needs no CAD file.
#include <camber/geom/geometry_model.hpp>

#include <memory>
#include <string>

namespace camber {

/// True for "sphere:...", "ellipsoid:...", "cylinder:..." and "torus:...".
[[nodiscard]] bool is_primitive(const std::string& text);

/// The whole surface as a model of one face, lengths in the unit of the mesh:
///   sphere:x,y,z,r              centre, radius
///   ellipsoid:x,y,z,a,b,c       centre, semi-axes along x, y, z
///   cylinder:x,y,z,dx,dy,dz,r   centre of one rim, vector to the other, radius; no caps
///   torus:x,y,z,dx,dy,dz,R,r    centre, axis, radius of the ring, radius of the tube
/// @throws OptionError where a number is missing, is none or makes no surface
[[nodiscard]] std::unique_ptr<GeometryModel> make_primitive(const std::string& text);

}  // namespace camber
