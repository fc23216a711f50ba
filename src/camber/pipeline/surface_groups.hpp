#pragma once
// Which faces of a geometry the surface elements of a mesh lie on, where no tags say it.
#include <camber/geom/geometry_model.hpp>
#include <camber/mesh/mesh_data.hpp>

#include <vector>

namespace camber {

/// By surface element, in the order of ElementList(data, 2): the one face of the geometry that all
/// its corners lie on, by place alone; empty where there is none. Linear and curved meshes, valid
/// or not. A corner lies on a face if it is nearer than 1e-4 of the smaller of the geometry's and
/// the mesh's size and than a tenth of the element's longest edge [mesh length]; of several faces
/// the one with the smallest sum of distances of corners and centre, then the lowest number.
/// Threads: parallel inside, one projector each; the same answer for any number of them.
[[nodiscard]] std::vector<GeometryGroup> surface_groups_by_place(const MeshData& data,
                                                                 const GeometryModel& geometry);

}  // namespace camber
