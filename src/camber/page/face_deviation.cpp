#include <camber/base/parallel.hpp>
#include <camber/elevate/placement.hpp>
#include <camber/page/face_deviation.hpp>

#include <algorithm>
#include <limits>

namespace camber {
namespace {

/// Distance to the group; `seed` are the parameters of the point before, on the same single face.
double distance(Projector& projector, const GeometryGroup& group, const Vec3& x,
                std::optional<Vec2>& seed) {
  if (group.size() > 1) return project_to_group(projector, group, x).distance;
  const Projection foot = projector.closest(group.front(), x, seed);
  if (foot.status != ProjectionStatus::failed) seed = foot.uv;
  return foot.distance;
}

/// The face of order 1 with the same corners.
Points linear_nodes(Shape shape, int order, const Points& nodes) {
  const std::vector<int>& from = lattice_map(shape, order).corner;
  const std::vector<int>& to = lattice_map(shape, 1).corner;
  Points flat(to.size());
  for (std::size_t c = 0; c < to.size(); ++c) {
    flat[static_cast<std::size_t>(to[c])] = nodes[static_cast<std::size_t>(from[c])];
  }
  return flat;
}

}  // namespace

bool is_curved(const GeometryGroup& group, const GeometryModel& geometry) {
  return std::any_of(group.begin(), group.end(), [&](const GeomEntity& entity) {
    return entity.dim == 2 && !geometry.is_planar(entity.tag);
  });
}

SurfaceDeviation surface_deviation(const ElementList& cells, const std::vector<BoundaryFace>& faces,
                                   const std::vector<GeometryGroup>& groups,
                                   const Tessellation& tessellation,
                                   const GeometryModel& geometry) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  SurfaceDeviation result{std::vector<double>(faces.size(), nan),
                          std::vector<double>(faces.size(), nan),
                          std::vector<double>(tessellation.points.size(), nan)};
  parallel_for_with(
      faces.size(), 32, [&] { return geometry.projector(); },
      [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
        Points nodes;
        for (std::size_t f = begin; f < end; ++f) {
          if (!is_curved(groups[f], geometry)) continue;
          const Shape shape = gather_face(cells, faces[f], nodes);
          result.face[f] =
              measure_face(*projector, groups[f], shape, cells.order(faces[f].cell), nodes, nullptr)
                  .maximum;
          const Points flat = linear_nodes(shape, cells.order(faces[f].cell), nodes);
          result.linear[f] = measure_face(*projector, groups[f], shape, 1, flat, nullptr).maximum;
          std::optional<Vec2> seed;
          for (std::size_t i = tessellation.first_point[f]; i < tessellation.first_point[f + 1];
               ++i) {
            result.point[i] = distance(*projector, groups[f], tessellation.points[i], seed);
          }
        }
      });
  return result;
}

}  // namespace camber
