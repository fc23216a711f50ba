#include <camber/base/parallel.hpp>
#include <camber/basis/lattice.hpp>
#include <camber/mesh/element_list.hpp>
#include <camber/pipeline/surface_groups.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace camber {
namespace {

/// Of the size: what associate_by_shape() takes for a vertex on the CAD as well.
constexpr double k_distance_tolerance = 1e-4;
/// Of an element's longest edge: small elements beside a large body are not near everything.
constexpr double k_edge_share = 0.1;

double size_of(const MeshData& data, const GeometryModel& geometry) {
  Box box;
  for (const Vec3& x : data.points) box.add(x);
  const double of_geometry = geometry.box().diagonal();  // not finite for an endless cylinder
  return std::isfinite(of_geometry) ? std::min(box.diagonal(), of_geometry) : box.diagonal();
}

/// Corners of the element, then their mean.
Points places_of(const MeshData& data, const ElementList& surfaces, std::size_t i) {
  Points places;
  Vec3 centre = Vec3::Zero();
  const std::span<const Index> nodes = surfaces.nodes(i);
  for (const int corner : lattice_map(surfaces.shape(i), surfaces.order(i)).corner) {
    places.push_back(data.points[at(nodes[static_cast<std::size_t>(corner)])]);
    centre += places.back();
  }
  places.push_back(centre / static_cast<double>(places.size()));
  return places;
}

double longest_edge(const Points& places) {
  double longest = 0.0;
  for (std::size_t a = 0; a + 1 < places.size(); ++a) {
    for (std::size_t b = 0; b < a; ++b) longest = std::max(longest, (places[a] - places[b]).norm());
  }
  return longest;
}

/// Sum of the distances of corners and centre; infinite if a corner is farther than `reach`.
double distance_of(Projector& projector, const Box& box, int face, const Points& places,
                   double reach) {
  constexpr double k_far = std::numeric_limits<double>::infinity();
  const Vec3 margin = Vec3::Constant(reach);
  for (std::size_t c = 0; c + 1 < places.size(); ++c) {
    const Vec3& x = places[c];
    if ((x.array() < (box.lower - margin).array()).any()) return k_far;
    if ((x.array() > (box.upper + margin).array()).any()) return k_far;
  }
  double sum = 0.0;
  for (std::size_t c = 0; c < places.size(); ++c) {
    const double distance = projector.closest({2, face}, places[c]).distance;
    if (c + 1 < places.size() && !(distance <= reach)) return k_far;
    sum += distance;
  }
  return sum;
}

}  // namespace

std::vector<GeometryGroup> surface_groups_by_place(const MeshData& data,
                                                   const GeometryModel& geometry) {
  const ElementList surfaces(data, 2);
  const double size = size_of(data, geometry);
  std::vector<Box> boxes;
  for (int face = 1; face <= geometry.count(2); ++face) boxes.push_back(geometry.box({2, face}));
  std::vector<GeometryGroup> groups(surfaces.size());
  parallel_for_with(
      surfaces.size(), 32, [&] { return geometry.projector(); },
      [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
        for (std::size_t i = begin; i < end; ++i) {
          const Points places = places_of(data, surfaces, i);
          const double reach =
              std::min(k_distance_tolerance * size, k_edge_share * longest_edge(places));
          double nearest = std::numeric_limits<double>::infinity();
          for (int face = 1; face <= geometry.count(2); ++face) {
            const Box& box = boxes[static_cast<std::size_t>(face - 1)];
            const double distance = distance_of(*projector, box, face, places, reach);
            if (!(distance < nearest)) continue;
            nearest = distance;
            groups[i] = {{2, face}};
          }
        }
      });
  return groups;
}

}  // namespace camber
