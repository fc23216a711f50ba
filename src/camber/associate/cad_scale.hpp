#pragma once
#include <camber/geom/geometry_model.hpp>
#include <camber/mesh/mesh_data.hpp>
#include <camber/mesh/topology.hpp>

namespace camber {

/// Sets the CAD's scale so that its faces fit the surface elements that carry their tags: of the
/// units in use, the one in which a sample of their nodes lies nearest to the CAD. Works for linear
/// and curved meshes, valid or not, and where boxes of CAD faces are loose.
/// @param scale  mesh length per CAD length; 0: found
/// @return the scale that was set
/// @throws GeometryError if no surface element refers to the CAD or no usual unit makes them fit.
double fit_cad_scale(const MeshData& data, GeometryModel& geometry, double scale = 0.0);

/// The same for a mesh without the CAD's tags: the usual unit in which most of a sample of boundary
/// vertices lie on the CAD, and spread over as much room as it takes.
/// @throws GeometryError if in no usual unit a vertex lies on the CAD
double fit_cad_scale_by_shape(const LinearMesh& mesh, const Topology& topology,
                              GeometryModel& geometry, double scale = 0.0);

}  // namespace camber
