#include <camber/pipeline/detail/lowered_together.hpp>

#include <algorithm>
#include <limits>

namespace camber {
namespace {

/// A face this many times as high as its edge moves keeps its shape.
constexpr double k_fold = 4.0;

/// How far the nodes of an edge move when its displacement becomes that of order `cap`.
double change(const Placement& placement, Index edge, int cap) {
  const int q = placement.max_order();
  const std::span<const Vec3> now = placement.edge_displacement(edge, q);
  const Points then = placement.capped_edge_displacement(edge, cap, q);
  double largest = 0.0;
  for (std::size_t i = 0; i < now.size(); ++i) {
    largest = std::max(largest, (now[i] - then[i]).norm());
  }
  return largest;
}

/// Distance of the face's farthest corner from the line through the edge.
double height_over(const LinearMesh& mesh, const Topology& topology, Index f, Index e) {
  const std::array<Index, 2>& v = topology.edge2vertex[at(e)];
  const Vec3& a = mesh.vertices[at(v[0])];
  const Vec3 along = (mesh.vertices[at(v[1])] - a).normalized();
  double height = 0.0;
  for (int i = 0; i < topology.corners_of_face(f); ++i) {
    const Vec3 r = mesh.vertices[at(topology.face2vertex[at(f)][at(i)])] - a;
    height = std::max(height, (r - r.dot(along) * along).norm());
  }
  return height;
}

}  // namespace

std::vector<std::pair<Index, int>> lowered_together(
    const LinearMesh& mesh, const Topology& topology, const Association& association,
    const Wall& wall, const Placement& placement, const std::vector<std::pair<Index, int>>& caps) {
  std::vector<int> lowest(wall.face_count(), std::numeric_limits<int>::max());
  std::vector<std::pair<Index, int>> open;
  const auto ask = [&](Index slot, int cap) {
    if (lowest[at(slot)] <= cap) return;
    lowest[at(slot)] = cap;
    open.emplace_back(slot, cap);
  };
  for (const auto& [slot, cap] : caps) ask(slot, std::max(cap, 1));
  for (std::size_t next = 0; next < open.size(); ++next) {
    const auto [slot, cap] = open[next];
    if (lowest[at(slot)] < cap) continue;
    const Index f = wall.faces[at(slot)];
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      const Index e = topology.face2edge[at(f)][at(i)];
      if (cap > 1 && association.edge2curve[at(e)].dim == 1) continue;
      const Index edge = wall.edge_slot[at(e)];
      for (Index other : wall.edge_faces[at(edge)]) {
        if (other == k_none || other == slot || placement.face_cap(other) <= cap) continue;
        const double height = height_over(mesh, topology, wall.faces[at(other)], e);
        if (height < k_fold * change(placement, edge, cap)) ask(other, cap);
      }
    }
  }
  std::vector<std::pair<Index, int>> all;
  for (Index slot = 0; at(slot) < lowest.size(); ++slot) {
    if (lowest[at(slot)] < std::numeric_limits<int>::max()) {
      all.emplace_back(slot, lowest[at(slot)]);
    }
  }
  return all;
}

std::vector<Index> with_wall_ring(const LinearMesh& mesh, const Topology& topology,
                                  const Wall& wall, const std::vector<Index>& slots) {
  std::vector<std::uint8_t> is_near(mesh.vertices.size(), 0);
  const auto corners = [&](Index slot) {
    const Index f = wall.faces[at(slot)];
    return std::span<const Index>(topology.face2vertex[at(f)].data(),
                                  at(topology.corners_of_face(f)));
  };
  for (Index slot : slots) {
    for (Index v : corners(slot)) is_near[at(v)] = 1;
  }
  std::vector<Index> ring;
  for (Index slot = 0; at(slot) < wall.face_count(); ++slot) {
    const std::span<const Index> own = corners(slot);
    if (std::any_of(own.begin(), own.end(), [&](Index v) { return is_near[at(v)] != 0; })) {
      ring.push_back(slot);
    }
  }
  return ring;
}

}  // namespace camber
