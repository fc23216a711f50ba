#include <camber/reconstruct/detail/fans.hpp>

#include <algorithm>
#include <utility>

namespace camber::detail {
namespace {

/// Facets turned further from the axis than this fold over in a height function's plane.
constexpr double k_least_cosine = 0.5;

}  // namespace

Fans find_fans(const FacetMesh& mesh, const Features& features) {
  Fans fans;
  std::array<Index, 4> none;
  none.fill(k_none);
  fans.corner.assign(mesh.facets.size(), none);
  const auto corner_at = [&](Index f, Index v) {
    const std::span<const Index> corners = mesh.corners(f);
    return static_cast<std::size_t>(std::find(corners.begin(), corners.end(), v) - corners.begin());
  };
  std::vector<Index> front;
  fans.facet_offset.push_back(0);
  for (Index first = 0; at(first) < mesh.facets.size(); ++first) {
    const std::span<const Index> corners = mesh.corners(first);
    for (std::size_t i = 0; i < corners.size(); ++i) {
      if (fans.corner[at(first)][i] != k_none) continue;
      const Index v = corners[i], fan = static_cast<Index>(fans.count());
      fans.corner[at(first)][i] = fan;
      front.assign(1, first);
      while (!front.empty()) {
        const Index f = front.back();
        front.pop_back();
        fans.facets.push_back(f);
        const std::size_t n = mesh.corner_count(f), here = corner_at(f, v);
        for (const std::size_t side : {here, (here + n - 1) % n}) {
          const FacetEdge& edge = features.edges[at(features.facet2edge[at(f)][side])];
          if (edge.is_sharp) continue;
          const Index other = edge.facet[0] == f ? edge.facet[1] : edge.facet[0];
          Index& slot = fans.corner[at(other)][corner_at(other, v)];
          if (slot != k_none) continue;
          slot = fan;
          front.push_back(other);
        }
      }
      fans.vertex.push_back(v);
      fans.facet_offset.push_back(static_cast<Index>(fans.facets.size()));
    }
  }
  return fans;
}

Rings rings_around(const FacetMesh& mesh, const Fans& fans, Index fan, std::span<const Vec3> normal,
                   const Vec3& axis, std::size_t enough, int max_rings) {
  Rings rings;
  // Few enough that linear searches beat sets.
  std::vector<Index> vertices{fans.vertex[at(fan)]}, facets, reached{fan}, next;
  const auto add_new = [](std::vector<Index>& list, Index i) {
    if (std::find(list.begin(), list.end(), i) != list.end()) return false;
    list.push_back(i);
    return true;
  };
  std::size_t first_of_ring = 0;
  for (int ring = 0; ring < max_rings && vertices.size() <= enough; ++ring) {
    const std::size_t end = reached.size();
    for (; first_of_ring < end; ++first_of_ring) {
      for (Index f : fans.facets_of(reached[first_of_ring])) {
        if (normal[at(f)].dot(axis) < k_least_cosine || !add_new(facets, f)) continue;
        const std::span<const Index> corners = mesh.corners(f);
        for (std::size_t i = 0; i < corners.size(); ++i) {
          add_new(vertices, corners[i]);
          add_new(reached, fans.corner[at(f)][i]);
        }
      }
    }
    if (ring == 0) rings.first = vertices.size() - 1;
  }
  vertices.erase(vertices.begin());
  rings.vertices = std::move(vertices);
  return rings;
}

}  // namespace camber::detail
