#include <camber/base/parallel.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/elevate/blend.hpp>
#include <camber/elevate/placement.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace camber {
namespace {

/// A line that meets the CAD this many times farther away than the closest point met another sheet
/// or a grazing flank.
constexpr double k_line_over_closest = 3.0;
/// A stretch of a CAD curve longer than this many chords goes the wrong way round.
constexpr double k_longest_stretch = 4.0;
/// Share of the longest edge that a node may move onto the CAD.
constexpr double k_reach = 2.0;

/// Parameters of the two ends of a mesh edge on its curve, the short way round on closed curves.
std::optional<std::array<double, 2>> stretch_on_curve(Projector& projector,
                                                      const GeometryModel& model, int curve,
                                                      const Vec3& a, const Vec3& b) {
  const Projection foot_a = projector.closest({1, curve}, a),
                   foot_b = projector.closest({1, curve}, b);
  if (foot_a.status == ProjectionStatus::failed || foot_b.status == ProjectionStatus::failed)
    return {};
  const GeometryModel::CurveRange range = model.range(curve);
  const Vec3 first = projector.evaluate_curve(curve, range.first).point;
  const Vec3 last = projector.evaluate_curve(curve, range.last).point;
  const double chord = (b - a).norm();
  const bool is_closed = (first - last).norm() <= 1e-6 * chord + 2.0 * model.tolerance({1, curve});
  const auto candidates = [&](const Projection& foot) {
    std::vector<double> t{foot.uv.x()};
    if (!is_closed) return t;
    if (range.period > 0.0) {
      t.push_back(foot.uv.x() + range.period);
      t.push_back(foot.uv.x() - range.period);
    } else if ((foot.point - first).norm() <= 1e-6 * chord + 2.0 * model.tolerance({1, curve})) {
      t.push_back(range.first);
      t.push_back(range.last);
    }
    return t;
  };
  std::optional<std::array<double, 2>> best;
  double shortest = k_longest_stretch * chord;
  for (double ta : candidates(foot_a)) {
    for (double tb : candidates(foot_b)) {
      if (ta == tb) continue;
      const double length = projector.curve_length(curve, ta, tb);
      if (length < shortest) {
        shortest = length;
        best = {ta, tb};
      }
    }
  }
  return best;
}

Vec3 direction_at(Shape shape, std::span<const Vec3> normal, const Vec3& xi) {
  std::array<double, 4> weight{};
  corner_weights(shape, xi, weight);
  Vec3 direction = Vec3::Zero();
  for (std::size_t i = 0; i < normal.size(); ++i) direction += weight[i] * normal[i];
  return direction;
}

/// How far the nodes of order q slide along the wall before they are moved across it: what the
/// edges slid (on CAD curves, in planes), carried inside. Only what order q adds to `lower`, the
/// slide at order q - 1, is blended: blending is not polynomial, and all of it at once would cost
/// an order of convergence.
/// @param moved  displacements on the lattice of order q; those of the edges are read
Points slid_inwards(Shape shape, int q, std::span<const Vec3> normal, const Points& lower,
                    std::span<const Vec3> moved) {
  Points below(moved.size(), Vec3::Zero()), added(moved.size(), Vec3::Zero());
  if (!lower.empty()) {
    const MatX& elevate = elevation_matrix(shape, q - 1, q);
    for (std::size_t r = 0; r < below.size(); ++r) {
      for (std::size_t c = 0; c < lower.size(); ++c) {
        below[r] += elevate(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) * lower[c];
      }
    }
  }
  for (const std::vector<int>& edge : lattice_map(shape, q).edge_interior) {
    for (int node : edge) {
      const Vec3 across = direction_at(shape, normal, lattice_xi(shape, q)[at(node)]).normalized();
      const Vec3& u = moved[at(node)];
      added[at(node)] = u - u.dot(across) * across - below[at(node)];
    }
  }
  blend_face_interior(shape, q, added);
  for (std::size_t i = 0; i < below.size(); ++i) below[i] += added[i];
  return below;
}

}  // namespace

Placement::Placement(const LinearMesh& mesh, const Topology& topology,
                     const Association& association, const GeometryModel& model, const Wall& wall,
                     int max_order)
    : mesh_(mesh),
      topology_(topology),
      association_(association),
      model_(model),
      wall_(wall),
      max_order_(max_order) {
  for (int q = 2; q <= max_order_; ++q) {
    edge_nodes_[at(q)].resize(wall_.edge_count() * at(q - 1));
    edge_displacement_[at(q)].assign(wall_.edge_count() * at(q + 1), Vec3::Zero());
    std::vector<Index>&nodes = face_node_offset_[at(q)], &all = face_displacement_offset_[at(q)];
    nodes.assign(1, 0);
    all.assign(1, 0);
    for (Index f : wall_.faces) {
      const Shape shape = topology_.face_shape[at(f)];
      nodes.push_back(nodes.back() + static_cast<Index>(interior_nodes(shape, q).size()));
      all.push_back(all.back() + static_cast<Index>(node_count(shape, q)));
    }
    face_nodes_[at(q)].resize(at(nodes.back()));
    face_displacement_[at(q)].assign(at(all.back()), Vec3::Zero());
  }
  edge_unplaced_.assign(wall_.edge_count(), 0);
  edge_cap_.assign(wall_.edge_count(), static_cast<std::uint8_t>(max_order_));
  face_cap_.assign(wall_.face_count(), static_cast<std::uint8_t>(max_order_));
  face_unplaced_.assign(wall_.face_count(), 0);
  find_planes();
  place_edges();
  place_faces();
  measure();
}

void Placement::find_planes() {
  plane_of_edge_.assign(wall_.edge_count(), k_none);
  for (Index f = 0; at(f) < topology_.face_count(); ++f) {
    const Patch* patch = association_.patch_of(f);
    if (!patch || patch->kind != PatchKind::plane || wall_.face_slot[at(f)] != k_none) continue;
    for (int i = 0; i < topology_.corners_of_face(f); ++i) {
      const Index slot = wall_.edge_slot[at(topology_.face2edge[at(f)][at(i)])];
      if (slot != k_none) plane_of_edge_[at(slot)] = association_.face2patch[at(f)];
    }
  }
}

std::span<const Vec3> Placement::edge_nodes(Index slot, int q) const {
  return {edge_nodes_[at(q)].data() + at(slot) * at(q - 1), at(q - 1)};
}
std::span<const Vec3> Placement::edge_displacement(Index slot, int q) const {
  return {edge_displacement_[at(q)].data() + at(slot) * at(q + 1), at(q + 1)};
}
std::span<const Vec3> Placement::face_nodes(Index slot, int q) const {
  const std::vector<Index>& offset = face_node_offset_[at(q)];
  return {face_nodes_[at(q)].data() + offset[at(slot)],
          at(offset[at(slot) + 1] - offset[at(slot)])};
}
std::span<const Vec3> Placement::face_displacement(Index slot, int q) const {
  const std::vector<Index>& offset = face_displacement_offset_[at(q)];
  return {face_displacement_[at(q)].data() + offset[at(slot)],
          at(offset[at(slot) + 1] - offset[at(slot)])};
}

Vec3 Placement::onto_patch(Projector& projector, Index patch, const Vec3& x, const Vec3& direction,
                           double reach, const WallCorner* seed, bool& is_placed) const {
  Projection nearest;
  nearest.distance = std::numeric_limits<double>::infinity();
  std::optional<Projection> crossing;
  for (const GeomEntity& face : association_.patches[at(patch)].group) {
    std::optional<Vec2> uv;
    if (seed && seed->face == face) uv = seed->uv;
    const Projection foot = projector.closest(face, x, uv);
    if (foot.status == ProjectionStatus::failed) continue;
    if (foot.distance < nearest.distance) nearest = foot;
    const std::optional<Projection> hit =
        projector.along_line(face.tag, x, direction, reach, foot.uv);
    if (hit && (!crossing || hit->distance < crossing->distance)) crossing = hit;
  }
  is_placed = nearest.status != ProjectionStatus::failed && nearest.distance <= reach;
  if (!is_placed) return x;
  if (crossing && crossing->distance <= k_line_over_closest * nearest.distance)
    return crossing->point;
  return nearest.point;
}

void Placement::place_edges() {
  parallel_for_with(
      wall_.edge_count(), 64, [&] { return model_.projector(); },
      [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
        for (std::size_t s = begin; s < end; ++s) place_edge(*projector, static_cast<Index>(s));
      });
}

void Placement::place_edge(Projector& projector, Index slot) {
  const Index e = wall_.edges[at(slot)];
  const std::array<Index, 2>& v = topology_.edge2vertex[at(e)];
  const Vec3 &a = mesh_.vertices[at(v[0])], &b = mesh_.vertices[at(v[1])];
  std::optional<std::array<double, 2>> stretch;
  const GeomEntity curve = association_.edge2curve[at(e)];
  if (curve.dim == 1) stretch = stretch_on_curve(projector, model_, curve.tag, a, b);

  const Index face_slot = wall_.edge_faces[at(slot)][0];
  const Index patch = association_.face2patch[at(wall_.faces[at(face_slot)])];
  const WallCorner *corner_a = nullptr, *corner_b = nullptr;
  for (Index c : wall_.face_corners[at(face_slot)]) {
    if (c == k_none) continue;
    if (wall_.corners[at(c)].vertex == v[0]) corner_a = &wall_.corners[at(c)];
    if (wall_.corners[at(c)].vertex == v[1]) corner_b = &wall_.corners[at(c)];
  }
  const Patch* plane = plane_of_edge_[at(slot)] == k_none
                           ? nullptr
                           : &association_.patches[at(plane_of_edge_[at(slot)])];

  std::array<Projection, k_orders> on_curve;
  for (int q = 2; q <= max_order_; ++q) {
    const std::span<Vec3> nodes{edge_nodes_[at(q)].data() + at(slot) * at(q - 1), at(q - 1)};
    const std::span<Vec3> moved{edge_displacement_[at(q)].data() + at(slot) * at(q + 1), at(q + 1)};
    if (stretch) {
      std::array<double, k_orders> fraction{};
      for (int i = 1; i < q; ++i) fraction[at(i - 1)] = static_cast<double>(i) / q;
      projector.divide_curve(curve.tag, (*stretch)[0], (*stretch)[1],
                             std::span(fraction.data(), at(q - 1)),
                             std::span(on_curve.data(), at(q - 1)));
    }
    for (int i = 1; i < q; ++i) {
      const double s = static_cast<double>(i) / q;
      const Vec3 straight = (1.0 - s) * a + s * b;
      Vec3 x = straight;
      if (stretch) {
        x = on_curve[at(i - 1)].point;
      } else {
        Vec3 direction = (1.0 - s) * corner_a->normal + s * corner_b->normal;
        if (plane) direction -= direction.dot(plane->normal) * plane->normal;
        bool is_placed = false;
        x = onto_patch(projector, patch, straight, direction, k_reach * (b - a).norm(), corner_a,
                       is_placed);
        if (plane) x -= (x - plane->origin).dot(plane->normal) * plane->normal;
        if (!is_placed) edge_unplaced_[at(slot)] = 1;
      }
      nodes[at(i - 1)] = x;
      moved[at(i)] = x - straight;
    }
  }
}

void Placement::place_faces() {
  parallel_for_with(
      wall_.face_count(), 32, [&] { return model_.projector(); },
      [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
        for (std::size_t s = begin; s < end; ++s) place_face(*projector, static_cast<Index>(s));
      });
}

void Placement::copy_edges_to_face(Index slot, int q, std::span<Vec3> moved) const {
  const Index f = wall_.faces[at(slot)];
  const LatticeMap& map = lattice_map(topology_.face_shape[at(f)], q);
  for (std::size_t i = 0; i < at(topology_.corners_of_face(f)); ++i) {
    const Index e = topology_.face2edge[at(f)][i];
    const std::span<const Vec3> edge = edge_displacement(wall_.edge_slot[at(e)], q);
    const bool reversed = topology_.edge2vertex[at(e)][0] != topology_.face2vertex[at(f)][i];
    for (std::size_t k = 0; k < map.edge[i].size(); ++k) {
      moved[at(map.edge[i][k])] = edge[reversed ? edge.size() - 1 - k : k];
    }
  }
}

void Placement::set_edge(Index slot, int q, std::span<const Vec3> nodes) {
  const std::array<Index, 2>& v = topology_.edge2vertex[at(wall_.edges[at(slot)])];
  for (int i = 1; i < q; ++i) {
    const double s = static_cast<double>(i) / q;
    const Vec3 straight = (1.0 - s) * mesh_.vertices[at(v[0])] + s * mesh_.vertices[at(v[1])];
    edge_nodes_[at(q)][at(slot) * at(q - 1) + at(i - 1)] = nodes[at(i - 1)];
    edge_displacement_[at(q)][at(slot) * at(q + 1) + at(i)] = nodes[at(i - 1)] - straight;
  }
}

void Placement::set_face(Index slot, int q, std::span<const Vec3> nodes) {
  const Index f = wall_.faces[at(slot)];
  const Shape shape = topology_.face_shape[at(f)];
  const Points straight = straight_face_nodes(mesh_, topology_, f, q);
  const std::span<Vec3> moved{
      face_displacement_[at(q)].data() + face_displacement_offset_[at(q)][at(slot)],
      straight.size()};
  copy_edges_to_face(slot, q, moved);
  const std::span<const int> inner = interior_nodes(shape, q);
  for (std::size_t k = 0; k < inner.size(); ++k) {
    face_nodes_[at(q)][at(face_node_offset_[at(q)][at(slot)]) + k] = nodes[k];
    moved[at(inner[k])] = nodes[k] - straight[at(inner[k])];
  }
}

void Placement::place_face(Projector& projector, Index slot) {
  const Index f = wall_.faces[at(slot)];
  const Shape shape = topology_.face_shape[at(f)];
  const std::size_t n = at(topology_.corners_of_face(f));
  const Index patch = association_.face2patch[at(f)];
  std::array<Vec3, 4> corner;
  std::array<const WallCorner*, 4> wall_corner{};
  double longest = 0.0;
  for (std::size_t i = 0; i < n; ++i) {
    corner[i] = mesh_.vertices[at(topology_.face2vertex[at(f)][i])];
    wall_corner[i] = &wall_.corners[at(wall_.face_corners[at(slot)][i])];
  }
  for (std::size_t i = 0; i < n; ++i)
    longest = std::max(longest, (corner[i] - corner[(i + 1) % n]).norm());
  std::array<Vec3, 4> normal;
  for (std::size_t i = 0; i < n; ++i) normal[i] = wall_corner[i]->normal;

  Points slide;  // of the order before
  for (int q = 2; q <= max_order_; ++q) {
    const Points straight = straight_face_nodes(mesh_, topology_, f, q);
    const std::span<Vec3> moved{
        face_displacement_[at(q)].data() + face_displacement_offset_[at(q)][at(slot)],
        at(node_count(shape, q))};
    const std::span<Vec3> nodes{face_nodes_[at(q)].data() + face_node_offset_[at(q)][at(slot)],
                                interior_nodes(shape, q).size()};
    copy_edges_to_face(slot, q, moved);
    slide = slid_inwards(shape, q, std::span(normal.data(), n), slide, moved);
    std::size_t k = 0;
    for (int node : interior_nodes(shape, q)) {
      const Vec3 direction =
          direction_at(shape, std::span(normal.data(), n), lattice_xi(shape, q)[at(node)]);
      bool is_placed = false;
      const Vec3 start = straight[at(node)] + slide[at(node)];
      const Vec3 x = onto_patch(projector, patch, start, direction, k_reach * longest,
                                wall_corner[0], is_placed);
      if (!is_placed) face_unplaced_[at(slot)] = 1;
      nodes[k++] = x;
      moved[at(node)] = x - straight[at(node)];
    }
  }
}

}  // namespace camber
