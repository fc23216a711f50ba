#pragma once
#include <camber/geom/geometry_model.hpp>
#include <camber/mesh/mesh_data.hpp>

namespace camber {

/// Sets the CAD's scale so that its faces fit the surface elements that carry their tags: of the
/// units in use, the one in which a sample of their nodes lies nearest to the CAD. Works for linear
/// and curved meshes, valid or not, and where boxes of CAD faces are loose.
/// @param scale  mesh length per CAD length; 0: found
/// @return the scale that was set
/// @throws GeometryError if no surface element refers to the CAD or no usual unit makes them fit.
double fit_cad_scale(const MeshData& data, GeometryModel& geometry, double scale = 0.0);

}  // namespace camber
