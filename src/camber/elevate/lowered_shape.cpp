// Wall faces whose shape is of a lower order than they could have.
#include <camber/base/sorted_set.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/elevate/blend.hpp>
#include <camber/elevate/placement.hpp>

#include <algorithm>

namespace camber {
std::vector<Index> Placement::lower(const std::vector<std::pair<Index, int>>& caps) {
  std::vector<Index> edges, changed;
  for (const auto& [slot, wanted] : caps) {
    const std::uint8_t cap = static_cast<std::uint8_t>(std::max(1, wanted));
    if (face_cap_[at(slot)] <= cap) continue;
    face_cap_[at(slot)] = cap;
    changed.push_back(slot);
    const Index f = wall_.faces[at(slot)];
    for (int i = 0; i < topology_.corners_of_face(f); ++i) {
      const Index e = topology_.face2edge[at(f)][at(i)], edge = wall_.edge_slot[at(e)];
      if (association_.edge2curve[at(e)].dim == 1 && cap > 1) continue;
      if (edge_cap_[at(edge)] <= cap) continue;
      edge_cap_[at(edge)] = cap;
      edges.push_back(edge);
    }
  }
  for (Index edge : edges) {
    cap_edge(edge);
    for (Index slot : wall_.edge_faces[at(edge)]) {
      if (slot != k_none) changed.push_back(slot);
    }
  }
  make_sorted_set(changed);
  const std::unique_ptr<Projector> projector = model_.projector();
  for (Index slot : changed) {
    place_face(*projector, slot);
    cap_face(slot);
  }
  return changed;
}

Points Placement::capped_edge_displacement(Index slot, int cap, int q) const {
  Points capped(at(q + 1), Vec3::Zero());
  if (cap < 2) return capped;
  const std::span<const Vec3> low = edge_displacement(slot, cap);
  const MatX& elevate = elevation_matrix(Shape::line, cap, q);
  for (int i = 0; i <= q; ++i) {
    for (int k = 0; k <= cap; ++k) capped[at(i)] += elevate(i, k) * low[at(k)];
  }
  return capped;
}

void Placement::cap_edge(Index slot) {
  const int cap = edge_cap_[at(slot)];
  const std::array<Index, 2>& v = topology_.edge2vertex[at(wall_.edges[at(slot)])];
  const Vec3 &a = mesh_.vertices[at(v[0])], &b = mesh_.vertices[at(v[1])];
  for (int q = cap + 1; q <= max_order_; ++q) {
    const std::span<Vec3> moved{edge_displacement_[at(q)].data() + at(slot) * at(q + 1), at(q + 1)};
    const std::span<Vec3> nodes{edge_nodes_[at(q)].data() + at(slot) * at(q - 1), at(q - 1)};
    const Points capped = capped_edge_displacement(slot, cap, q);
    for (int i = 1; i < q; ++i) {
      const double s = static_cast<double>(i) / q;
      moved[at(i)] = capped[at(i)];
      nodes[at(i - 1)] = (1.0 - s) * a + s * b + capped[at(i)];
    }
  }
}

/// Above its cap a face is the cap's polynomial plus what its edges do beyond that, blended
/// inwards.
void Placement::cap_face(Index slot) {
  const int cap = face_cap_[at(slot)];
  const Index f = wall_.faces[at(slot)];
  const Shape shape = topology_.face_shape[at(f)];
  for (int q = cap + 1; q <= max_order_; ++q) {
    const std::span<Vec3> moved{
        face_displacement_[at(q)].data() + face_displacement_offset_[at(q)][at(slot)],
        at(node_count(shape, q))};
    const std::span<Vec3> nodes{face_nodes_[at(q)].data() + face_node_offset_[at(q)][at(slot)],
                                interior_nodes(shape, q).size()};
    Points low(moved.size(), Vec3::Zero());
    if (cap > 1) {
      const MatX& elevate = elevation_matrix(shape, cap, q);
      const std::span<const Vec3> capped = face_displacement(slot, cap);
      for (std::size_t r = 0; r < low.size(); ++r) {
        for (std::size_t c = 0; c < capped.size(); ++c) {
          low[r] += elevate(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) * capped[c];
        }
      }
    }
    Points beyond(moved.size(), Vec3::Zero());
    copy_edges_to_face(slot, q, beyond);
    for (const std::vector<int>& edge : lattice_map(shape, q).edge_interior) {
      for (int node : edge) beyond[at(node)] -= low[at(node)];
    }
    blend_face_interior(shape, q, beyond);
    const Points straight = straight_face_nodes(mesh_, topology_, f, q);
    std::size_t k = 0;
    for (int node : interior_nodes(shape, q)) {
      moved[at(node)] = low[at(node)] + beyond[at(node)];
      nodes[k++] = straight[at(node)] + moved[at(node)];
    }
  }
}

}  // namespace camber
