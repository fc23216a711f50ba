#pragma once
// How far the surface elements of a file are from the CAD that their tags refer to.
#include <camber/geom/geometry_model.hpp>
#include <camber/mesh/element_list.hpp>
#include <camber/pipeline/report.hpp>

namespace camber {

/// Fills report.surface: shape conformity, eq. (1) of [karman2022], and largest Gauss-point
/// distance of every surface element whose entity tag is that of a CAD face that is not planar,
/// beside the same of its straight copy; by group (elements of one name) and by order. A face
/// counts as over the deviation if its largest distance exceeds `deviation` times its shortest
/// straight edge. Parallel inside.
void measure_surfaces(const MeshData& data, const ElementList& surfaces,
                      const GeometryModel& geometry, double deviation, Report& report);

}  // namespace camber
