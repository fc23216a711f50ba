#pragma once
// How far the pictured surface is from the CAD.
#include <camber/geom/geometry_model.hpp>
#include <camber/page/tessellation.hpp>

#include <vector>

namespace camber {

/// Distances of the surface to its CAD [length]; NaN where a face has no CAD or only planar one.
struct SurfaceDeviation {
  std::vector<double> face;    // largest at the Gauss points, as in the report
  std::vector<double> linear;  // the same of the flat faces through the corners
  std::vector<double> point;   // by point of the tessellation
};

/// @param groups  by face: the CAD faces it lies on; empty for none
/// Threads: parallel inside, one projector each.
[[nodiscard]] SurfaceDeviation surface_deviation(const ElementList& cells,
                                                 const std::vector<BoundaryFace>& faces,
                                                 const std::vector<GeometryGroup>& groups,
                                                 const Tessellation& tessellation,
                                                 const GeometryModel& geometry);

/// True if the group has a CAD face that is not planar: what deviations are measured on.
[[nodiscard]] bool is_curved(const GeometryGroup& group, const GeometryModel& geometry);

}  // namespace camber
