#include <camber/basis/lagrange.hpp>
#include <camber/elevate/blend.hpp>
#include <camber/elevate/layer_field.hpp>
#include <camber/elevate/wall_sides.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace camber {
namespace {

/// A still plane damps the normal displacement of points nearer to it than this many wall
/// distances.
constexpr double k_plane_range = 2.0;
/// A still patch that is not planar damps all displacement of points nearer than this many wall
/// distances z, by its distance d over d + k_balance z: with that many z between, no kink of the
/// patch is felt, and nothing is lost at the wall. Both found on bench/ladder's inner and capped
/// bodies, where a short sharp range tangles hexahedra of order 4 under ragged tops.
constexpr double k_patch_range = 8.0, k_balance = 0.75;

/// Share of the displacement that a still patch of that kind takes away, 0 at its range.
double damping_of(PatchKind kind, double distance, double wall_distance) {
  if (kind == PatchKind::plane) return decay(distance / (k_plane_range * wall_distance));
  const double reached = distance / (distance + k_balance * wall_distance);
  return decay(reached * (k_patch_range + k_balance) / k_patch_range);
}

/// Multilinear weights of the corners (corner order) at xi.
void vertex_weights(Shape shape, const Vec3& xi, std::span<double> weight) {
  std::array<double, 8> N{};
  lagrange_values(shape, 1, xi, std::span(N.data(), weight.size()));
  const std::vector<int>& corner = lattice_map(shape, 1).corner;
  for (std::size_t i = 0; i < weight.size(); ++i) weight[i] = N[at(corner[i])];
}

}  // namespace

LayerField::LayerField(const LinearMesh& mesh, const Topology& topology,
                       const Association& association, const Wall& wall, const Placement& placement,
                       const Columns& columns, const LayerFieldOptions& options)
    : mesh_(mesh),
      topology_(topology),
      association_(association),
      wall_(wall),
      placement_(placement),
      columns_(columns),
      decay_(options.decay),
      length_(decay_lengths(mesh, topology, wall, placement, columns, options)) {
  const std::vector<int> sides = wall_sides(mesh_, topology_, wall_);
  for (int side : sides) label_count_ = std::max(label_count_, side + 1);
  wall_tree_ = FaceTree(mesh_, topology_, wall_.faces, sides);
  limit_lengths_in_gaps(mesh_, wall_, wall_tree_, length_);
  for (double l : length_) longest_ = std::max(longest_, l);
  for (Index f = 0; at(f) < topology_.face_count(); ++f) {
    const Index patch = association_.face2patch[at(f)];
    if (patch != k_none && !wall_.is_wall_patch[at(patch)]) still_faces_.push_back(f);
  }
  still_tree_ = FaceTree(mesh_, topology_, still_faces_, std::vector<int>(still_faces_.size(), 0));
  constraints_ = MotionConstraints(mesh_, topology_, association_, still_faces_);
}

double LayerField::share(double s) const {
  return decay_ == Decay::cell ? std::clamp(1.0 - s, 0.0, 1.0) : decay(s);
}

Vec3 LayerField::wall_displacement(Index slot, const Vec3& xi, int q) const {
  const Shape shape = topology_.face_shape[at(wall_.faces[at(slot)])];
  std::array<double, 49> N{};
  const std::span<const Vec3> d = placement_.face_displacement(slot, q);
  lagrange_values(shape, q, xi, std::span(N.data(), d.size()));
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 0; i < d.size(); ++i) sum += N[i] * d[i];
  return sum;
}

double LayerField::wall_length(Index slot, const Vec3& xi) const {
  const Index f = wall_.faces[at(slot)];
  std::array<double, 4> weight{};
  corner_weights(topology_.face_shape[at(f)], xi, weight);
  double length = 0.0;
  for (int i = 0; i < topology_.corners_of_face(f); ++i) {
    length += weight[at(i)] * length_[at(topology_.face2vertex[at(f)][at(i)])];
  }
  return length;
}

LayerField::Foot LayerField::foot_of(std::span<const Index> vertices,
                                     std::array<Index, 2> column_slots) const {
  Foot foot;
  std::array<Index, 8> base{};
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    base[i] = columns_.base[at(vertices[i])];
    if (base[i] == k_none) return foot;
    foot.z[i] = columns_.height[at(vertices[i])];
    foot.length[i] = length_[at(base[i])];
  }
  const auto end = base.begin() + static_cast<std::ptrdiff_t>(vertices.size());
  if (std::all_of(base.begin(), end, [&](Index b) { return b == base[0]; })) {
    foot.is_vertex = true;
    return foot;
  }
  const auto holds_all = [&](Index slot) {
    if (slot == k_none) return false;
    const std::array<Index, 4>& v = topology_.face2vertex[at(wall_.faces[at(slot)])];
    return std::all_of(base.begin(), end,
                       [&](Index b) { return std::find(v.begin(), v.end(), b) != v.end(); });
  };
  Index slot = k_none;
  for (Index candidate : column_slots) {
    if (slot == k_none && holds_all(candidate)) slot = candidate;
  }
  if (slot == k_none) {
    // Standing on a wall edge: any wall face on that edge will do.
    const auto other = std::find_if(base.begin(), end, [&](Index b) { return b != base[0]; });
    const Index e = topology_.find_edge(base[0], *other);
    if (e == k_none || wall_.edge_slot[at(e)] == k_none) return foot;
    const Index candidate = wall_.edge_faces[at(wall_.edge_slot[at(e)])][0];
    if (!holds_all(candidate)) return foot;
    slot = candidate;
  }
  foot.slot = slot;
  const Index f = wall_.faces[at(slot)];
  const std::span<const Vec3> corner_xi = corners(topology_.face_shape[at(f)]);
  for (std::size_t i = 0; i < vertices.size(); ++i) {
    const std::array<Index, 4>& v = topology_.face2vertex[at(f)];
    foot.xi[i] =
        corner_xi[static_cast<std::size_t>(std::find(v.begin(), v.end(), base[i]) - v.begin())];
  }
  return foot;
}

Vec3 LayerField::damped_by_still_patches(const Vec3& x, double wall_distance, const Vec3& u) const {
  if (still_tree_.is_empty() || wall_distance <= 0.0) return u;
  FaceHit hit;
  if (!still_tree_.nearest(x, k_patch_range * wall_distance, hit)) return u;
  const Patch& patch = *association_.patch_of(still_faces_[at(hit.item)]);
  const double damping = damping_of(patch.kind, hit.distance, wall_distance);
  if (patch.kind == PatchKind::plane) return u - damping * u.dot(patch.normal) * patch.normal;
  return (1.0 - damping) * u;
}

Vec3 LayerField::displacement(const Vec3& x, int q, const Foot* foot,
                              std::span<const double> weights) const {
  const bool has_column = foot && (foot->is_vertex || foot->slot != k_none);
  Index slot = k_none;
  Vec3 xi = Vec3::Zero();
  double z = 0.0, length = 0.0;
  if (has_column) {
    slot = foot->slot;
    for (std::size_t i = 0; i < weights.size(); ++i) {
      z += weights[i] * foot->z[i];
      length += weights[i] * foot->length[i];
      if (slot != k_none) xi += weights[i] * foot->xi[i];
    }
  }
  if (has_column && label_count_ <= 1) {
    if (slot == k_none || z >= length) return Vec3::Zero();
    return damped_by_still_patches(x, z, share(z / length) * wall_displacement(slot, xi, q));
  }
  thread_local std::vector<FaceHit> hits;
  if (label_count_ <= 1) {
    hits.resize(1);
    if (!wall_tree_.nearest(x, longest_, hits[0])) return Vec3::Zero();
  } else {
    wall_tree_.nearest_per_label(x, longest_, hits);
  }
  const int own_label = slot != k_none ? wall_tree_.label(slot)
                                       : (hits.empty() ? -1 : wall_tree_.label(hits[0].item));
  Vec3 sum = Vec3::Zero();
  double total = 0.0, nearest = std::numeric_limits<double>::infinity();
  const auto add = [&](Index s, const Vec3& at_xi, double distance, double l) {
    if (distance >= l) return;
    const double phi = share(distance / l);
    const double weight = phi / std::max(distance * distance, 1e-300);
    sum += weight * phi * wall_displacement(s, at_xi, q);
    total += weight;
    nearest = std::min(nearest, distance);
  };
  if (has_column) {
    if (slot != k_none) {
      add(slot, xi, z, length);
    } else if (z < length) {
      const double phi = share(z / length);
      total += phi / std::max(z * z, 1e-300);
      nearest = z;
    }
  }
  for (const FaceHit& hit : hits) {
    if (has_column && wall_tree_.label(hit.item) == own_label) continue;
    add(hit.item, hit.xi, hit.distance, wall_length(hit.item, hit.xi));
  }
  if (total == 0.0) return Vec3::Zero();
  return damped_by_still_patches(x, nearest, sum / total);
}

void LayerField::edge(Index e, int q, std::span<Vec3> u) const {
  const Index slot = wall_.edge_slot[at(e)];
  if (slot != k_none) {
    const std::span<const Vec3> d = placement_.edge_displacement(slot, q);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = d[i + 1];
    return;
  }
  const std::array<Index, 2>& v = topology_.edge2vertex[at(e)];
  const Foot foot = foot_of(v, {k_none, k_none});
  for (std::size_t i = 0; i < u.size(); ++i) {
    const double s = static_cast<double>(i + 1) / q;
    const std::array<double, 2> weight{1.0 - s, s};
    const Vec3 x = weight[0] * mesh_.vertices[at(v[0])] + weight[1] * mesh_.vertices[at(v[1])];
    u[i] = displacement(x, q, &foot, weight);
  }
  for (Vec3& move : u) move = constraints_.edge_move(e, move);
}

void LayerField::face(Index f, int q, std::span<Vec3> u) const {
  if (u.empty()) return;
  const Index slot = wall_.face_slot[at(f)];
  const Shape shape = topology_.face_shape[at(f)];
  const std::span<const int> inner = interior_nodes(shape, q);
  if (slot != k_none) {
    const std::span<const Vec3> d = placement_.face_displacement(slot, q);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = d[at(inner[i])];
    return;
  }
  const std::size_t n = at(topology_.corners_of_face(f));
  const std::span<const Index> v(topology_.face2vertex[at(f)].data(), n);
  std::array<Index, 2> column_slots{k_none, k_none};
  for (std::size_t i = 0; i < 2; ++i) {
    const Index c = topology_.face2cell[at(f)][i];
    if (c != k_none) column_slots[i] = columns_.cell_face_slot[at(c)];
  }
  const Foot foot = foot_of(v, column_slots);
  for (std::size_t i = 0; i < u.size(); ++i) {
    std::array<double, 4> weight{};
    corner_weights(shape, lattice_xi(shape, q)[at(inner[i])], weight);
    Vec3 x = Vec3::Zero();
    for (std::size_t k = 0; k < n; ++k) x += weight[k] * mesh_.vertices[at(v[k])];
    u[i] = displacement(x, q, &foot, std::span(weight.data(), n));
  }
  for (Vec3& move : u) move = constraints_.face_move(f, move);
}

void LayerField::cell(Index c, int q, std::span<Vec3> u) const {
  if (u.empty()) return;
  const Shape shape = mesh_.cell_shape[at(c)];
  const std::span<const Index> v = mesh_.cell(c);
  const Foot foot = foot_of(v, {columns_.cell_face_slot[at(c)], k_none});
  const std::vector<int>& inner = lattice_map(shape, q).interior;
  for (std::size_t i = 0; i < u.size(); ++i) {
    std::array<double, 8> weight{};
    const std::span<double> used(weight.data(), v.size());
    vertex_weights(shape, lattice_xi(shape, q)[at(inner[i])], used);
    Vec3 x = Vec3::Zero();
    for (std::size_t k = 0; k < v.size(); ++k) x += weight[k] * mesh_.vertices[at(v[k])];
    u[i] = displacement(x, q, &foot, used);
  }
}

}  // namespace camber
