#include <camber/geom/geometry_model.hpp>

#include <limits>

namespace camber {

Projection project_to_group(Projector& projector, const GeometryGroup& group, const Vec3& x) {
  Projection best;
  best.point = x;
  best.distance = std::numeric_limits<double>::infinity();
  for (const GeomEntity& entity : group) {
    const Projection p = projector.closest(entity, x);
    if (p.status != ProjectionStatus::failed && p.distance < best.distance) best = p;
  }
  return best;
}

}  // namespace camber
