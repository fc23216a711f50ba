#pragma once
#include <camber/geom/geometry_model.hpp>
#include <camber/mesh/mesh_data.hpp>

namespace camber {

/// Sets the CAD's scale so that its faces fit the surface elements that carry their tags: the boxes
/// of both are compared for the units in use. Works for linear and curved meshes, valid or not.
/// @param scale  mesh length per CAD length; 0: found
/// @return the scale that was set
/// @throws GeometryError if no surface element refers to the CAD or no usual unit makes the boxes
/// fit.
double fit_cad_scale(const MeshData& data, GeometryModel& geometry, double scale = 0.0);

}  // namespace camber
