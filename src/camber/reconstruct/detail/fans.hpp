#pragma once
// Facets round a vertex that sharp edges do not part.
#include <camber/reconstruct/features.hpp>

#include <array>
#include <span>
#include <vector>

namespace camber::detail {

/// A fan: the facets at one vertex that are connected across edges that are not sharp. A vertex
/// inside a smooth region has one fan; one on a sharp edge has one on each side.
struct Fans {
  std::vector<Index> vertex;                 // fan -> its vertex
  std::vector<Index> facet_offset, facets;   // fan -> facets
  std::vector<std::array<Index, 4>> corner;  // facet, corner -> fan

  [[nodiscard]] std::size_t count() const { return vertex.size(); }
  [[nodiscard]] std::span<const Index> facets_of(Index fan) const {
    return {facets.data() + facet_offset[at(fan)],
            static_cast<std::size_t>(facet_offset[at(fan) + 1] - facet_offset[at(fan)])};
  }
};

[[nodiscard]] Fans find_fans(const FacetMesh& mesh, const Features& features);

/// Vertices around a fan, in rings: those of its own facets, then those of the fans of these, and
/// so on, never across a sharp edge. Sorted by ring; the fan's vertex itself is left out. Stops
/// after the ring with which there are at least `enough`, or after `max_rings`.
/// @param normal  by facet, unit; facets turned by more than 60 degrees from `axis` are passed over
struct Rings {
  std::vector<Index> vertices;
  std::size_t first = 0;  // how many of them are of the first ring
};
[[nodiscard]] Rings rings_around(const FacetMesh& mesh, const Fans& fans, Index fan,
                                 std::span<const Vec3> normal, const Vec3& axis, std::size_t enough,
                                 int max_rings);

}  // namespace camber::detail
