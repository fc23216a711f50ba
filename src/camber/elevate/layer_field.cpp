#include <camber/elevate/layer_field.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <camber/base/parallel.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/elevate/blend.hpp>

namespace camber {
namespace {

std::size_t sz(int i) { return static_cast<std::size_t>(i); }

/// Two walls whose CAD normals differ by more than this (cosine of 30 degrees) across a concave edge are
/// different walls to the field.
constexpr double k_sharp_cosine = 0.866;
/// A still patch damps the normal displacement of points nearer to it than this many wall distances.
constexpr double k_damping_range = 2.0;
/// The decay must end before the middle between two facing walls.
constexpr double k_gap_share = 0.9;

Index root_of(std::vector<Index>& parent, Index i) {
  while (parent[at(i)] != i) i = parent[at(i)] = parent[at(parent[at(i)])];
  return i;
}

Vec3 face_centre(const LinearMesh& mesh, const Topology& topology, Index f) {
  Vec3 centre = Vec3::Zero();
  const int n = topology.corners_of_face(f);
  for (int i = 0; i < n; ++i) centre += mesh.vertices[at(topology.face2vertex[at(f)][sz(i)])] / n;
  return centre;
}

/// Multilinear weights of the corners (corner order) at xi.
void vertex_weights(Shape shape, const Vec3& xi, std::span<double> weight) {
  std::array<double, 8> N{};
  lagrange_values(shape, 1, xi, std::span(N.data(), weight.size()));
  const std::vector<int>& corner = lattice_map(shape, 1).corner;
  for (std::size_t i = 0; i < weight.size(); ++i) weight[i] = N[sz(corner[i])];
}

}  // namespace

double decay(double s) {
  if (s >= 1.0) return 0.0;
  if (s <= 0.0) return 1.0;
  return (1.0 - s) * (1.0 - s) * (1.0 + 2.0 * s);
}

LayerField::LayerField(const LinearMesh& mesh, const Topology& topology, const Association& association,
                       const Wall& wall, const Placement& placement, const Columns& columns,
                       const LayerFieldOptions& options)
    : mesh_(mesh), topology_(topology), association_(association), wall_(wall), placement_(placement),
      columns_(columns) {
  find_lengths(options);
  build_trees();
  limit_lengths_in_gaps();
  find_constraints();
}

void LayerField::find_lengths(const LayerFieldOptions& options) {
  const std::size_t n = mesh_.vertices.size();
  length_.assign(n, 0.0);
  face_displacement_.assign(wall_.face_count(), 0.0);
  std::vector<double> sum(n, 0.0), largest(n, 0.0);
  std::vector<int> count(n, 0);
  for (Index e : wall_.edges) {
    const std::array<Index, 2>& v = topology_.edge2vertex[at(e)];
    const double length = (mesh_.vertices[at(v[0])] - mesh_.vertices[at(v[1])]).norm();
    for (Index i : v) {
      sum[at(i)] += length;
      ++count[at(i)];
    }
  }
  const int q = placement_.max_order();
  for (std::size_t s = 0; s < wall_.face_count() && q >= 2; ++s) {
    for (const Vec3& d : placement_.face_displacement(static_cast<Index>(s), q)) {
      face_displacement_[s] = std::max(face_displacement_[s], d.norm());
    }
    const Index f = wall_.faces[s];
    for (int i = 0; i < topology_.corners_of_face(f); ++i) {
      double& d = largest[at(topology_.face2vertex[at(f)][sz(i)])];
      d = std::max(d, face_displacement_[s]);
    }
  }
  for (std::size_t v = 0; v < n; ++v) {
    if (count[v] == 0) continue;
    length_[v] = std::max(options.reach * sum[v] / count[v], options.reach_per_sagitta * largest[v]);
  }
}

void LayerField::build_trees() {
  // Labels: walls joined over every edge but sharp concave ones.
  std::vector<Index> parent(wall_.face_count());
  std::iota(parent.begin(), parent.end(), 0);
  const auto corner_normal = [&](Index slot, Index vertex) {
    for (Index c : wall_.face_corners[at(slot)]) {
      if (c != k_none && wall_.corners[at(c)].vertex == vertex) return wall_.corners[at(c)].normal;
    }
    return wall_.facet_normal[at(slot)];
  };
  for (std::size_t s = 0; s < wall_.edge_count(); ++s) {
    const auto [a, b] = wall_.edge_faces[s];
    if (b == k_none) continue;
    const Index e = wall_.edges[s];
    double cosine = 1.0;
    for (Index v : topology_.edge2vertex[at(e)]) {
      cosine = std::min(cosine, corner_normal(a, v).dot(corner_normal(b, v)));
    }
    const Vec3& foot = mesh_.vertices[at(topology_.edge2vertex[at(e)][0])];
    const bool is_concave =
        (face_centre(mesh_, topology_, wall_.faces[at(b)]) - foot).dot(wall_.facet_normal[at(a)]) < 0.0;
    if (is_concave && cosine < k_sharp_cosine) continue;
    parent[at(root_of(parent, a))] = root_of(parent, b);
  }
  std::vector<int> label_of_root(wall_.face_count(), -1);
  std::vector<int> labels(wall_.face_count());
  label_count_ = 0;
  for (std::size_t s = 0; s < wall_.face_count(); ++s) {
    int& label = label_of_root[at(root_of(parent, static_cast<Index>(s)))];
    if (label < 0) label = label_count_++;
    labels[s] = label;
  }
  wall_tree_ = FaceTree(mesh_, topology_, wall_.faces, labels);
  for (Index f = 0; at(f) < topology_.face_count(); ++f) {
    const Index patch = association_.face2patch[at(f)];
    if (patch != k_none && !wall_.is_wall_patch[at(patch)]) still_faces_.push_back(f);
  }
  still_tree_ = FaceTree(mesh_, topology_, still_faces_, std::vector<int>(still_faces_.size(), 0));
  for (double l : length_) longest_ = std::max(longest_, l);
}

/// Shrinks a ball that touches the wall at v from inside the fluid until it is empty: its radius is the
/// distance to the middle between v and a wall facing it.
void LayerField::limit_lengths_in_gaps() {
  std::vector<Vec3> inward(mesh_.vertices.size(), Vec3::Zero());
  for (const WallCorner& corner : wall_.corners) inward[at(corner.vertex)] -= corner.normal;
  parallel_for(mesh_.vertices.size(), 1024, [&](std::size_t begin, std::size_t end) {
    for (std::size_t v = begin; v < end; ++v) {
      if (length_[v] == 0.0 || inward[v].norm() == 0.0) continue;
      const Vec3 n = inward[v].normalized();
      const Vec3& x = mesh_.vertices[v];
      double radius = length_[v] / k_gap_share;
      for (int pass = 0; pass < 20; ++pass) {
        FaceHit hit;
        if (!wall_tree_.nearest(x + radius * n, radius * (1.0 - 1e-6), hit)) break;
        const Vec3 chord = hit.point - x;
        if (wall_.facet_normal[at(hit.item)].dot(n) < 0.3 || chord.dot(n) <= 0.0) break;
        const double smaller = chord.squaredNorm() / (2.0 * chord.dot(n));
        if (smaller >= radius * (1.0 - 1e-6)) break;
        radius = smaller;
      }
      length_[v] = std::min(length_[v], k_gap_share * radius);
    }
  });
}

void LayerField::find_constraints() {
  edge_constraint_.assign(topology_.edge_count(), k_none);
  face_constraint_.assign(topology_.face_count(), k_none);
  std::vector<Index> constraint_of_patch(association_.patches.size(), k_none);
  for (Index f : still_faces_) {
    const Index p = association_.face2patch[at(f)];
    Index& own = constraint_of_patch[at(p)];
    if (own == k_none) {
      const Patch& patch = association_.patches[at(p)];
      own = static_cast<Index>(constraints_.size());
      Constraint constraint;
      constraint.kind = patch.kind == PatchKind::plane ? Constraint::Kind::plane : Constraint::Kind::fixed;
      constraint.origin = patch.origin;
      constraint.a = patch.normal;
      constraints_.push_back(constraint);
    }
    face_constraint_[at(f)] = own;
    for (int i = 0; i < topology_.corners_of_face(f); ++i) {
      Index& edge = edge_constraint_[at(topology_.face2edge[at(f)][sz(i)])];
      if (edge == k_none) {
        edge = own;
      } else if (edge != own) {
        // Two still patches meet: the edge may move along the line of two planes only.
        const Constraint first = constraints_[at(edge)], second = constraints_[at(own)];
        Constraint both;
        both.kind = Constraint::Kind::fixed;
        const Vec3 along = first.a.cross(second.a);
        const bool are_planes =
            first.kind == Constraint::Kind::plane && second.kind == Constraint::Kind::plane;
        if (are_planes && along.norm() < 1e-6) continue;
        if (are_planes) {
          both.kind = Constraint::Kind::line;
          both.a = along.normalized();
          both.origin = mesh_.vertices[at(topology_.face2vertex[at(f)][sz(i)])];
        }
        edge = static_cast<Index>(constraints_.size());
        constraints_.push_back(both);
      }
    }
  }
}

Vec3 LayerField::constrained(const Constraint& constraint, const Vec3& x) {
  switch (constraint.kind) {
    case Constraint::Kind::plane:
      return x - (x - constraint.origin).dot(constraint.a) * constraint.a;
    case Constraint::Kind::line:
      return constraint.origin + (x - constraint.origin).dot(constraint.a) * constraint.a;
    case Constraint::Kind::free:
    case Constraint::Kind::fixed: break;
  }
  return x;
}

Vec3 LayerField::constrained_move(const Constraint& constraint, const Vec3& u) {
  switch (constraint.kind) {
    case Constraint::Kind::plane: return u - u.dot(constraint.a) * constraint.a;
    case Constraint::Kind::line: return u.dot(constraint.a) * constraint.a;
    case Constraint::Kind::fixed: return Vec3::Zero();
    case Constraint::Kind::free: break;
  }
  return u;
}

Vec3 LayerField::constrained_edge_point(Index e, const Vec3& x) const {
  const Index k = edge_constraint_[at(e)];
  return k == k_none ? x : constrained(constraints_[at(k)], x);
}

Vec3 LayerField::constrained_face_point(Index f, const Vec3& x) const {
  const Index k = face_constraint_[at(f)];
  return k == k_none ? x : constrained(constraints_[at(k)], x);
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
    length += weight[sz(i)] * length_[at(topology_.face2vertex[at(f)][sz(i)])];
  }
  return length;
}

LayerField::Foot LayerField::foot_of(std::span<const Index> vertices, std::array<Index, 2> column_slots) const {
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
    return std::all_of(base.begin(), end, [&](Index b) { return std::find(v.begin(), v.end(), b) != v.end(); });
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
    foot.xi[i] = corner_xi[static_cast<std::size_t>(std::find(v.begin(), v.end(), base[i]) - v.begin())];
  }
  return foot;
}

Vec3 LayerField::damped_by_still_patches(const Vec3& x, double wall_distance, const Vec3& u) const {
  if (still_tree_.is_empty() || wall_distance <= 0.0) return u;
  FaceHit hit;
  if (!still_tree_.nearest(x, k_damping_range * wall_distance, hit)) return u;
  const double share = decay(hit.distance / (k_damping_range * wall_distance));
  const Patch& patch = *association_.patch_of(still_faces_[at(hit.item)]);
  if (patch.kind == PatchKind::plane) return u - share * u.dot(patch.normal) * patch.normal;
  return (1.0 - share) * u;
}

Vec3 LayerField::displacement(const Vec3& x, int q, const Foot* foot, std::span<const double> weights) const {
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
    return damped_by_still_patches(x, z, decay(z / length) * wall_displacement(slot, xi, q));
  }
  thread_local std::vector<FaceHit> hits;
  if (label_count_ <= 1) {
    hits.resize(1);
    if (!wall_tree_.nearest(x, longest_, hits[0])) return Vec3::Zero();
  } else {
    wall_tree_.nearest_per_label(x, longest_, hits);
  }
  const int own_label = slot != k_none ? wall_tree_.label(slot) : (hits.empty() ? -1 : wall_tree_.label(hits[0].item));
  Vec3 sum = Vec3::Zero();
  double total = 0.0, nearest = std::numeric_limits<double>::infinity();
  const auto add = [&](Index s, const Vec3& at_xi, double distance, double l) {
    if (distance >= l) return;
    const double phi = decay(distance / l);
    const double weight = phi / std::max(distance * distance, 1e-300);
    sum += weight * phi * wall_displacement(s, at_xi, q);
    total += weight;
    nearest = std::min(nearest, distance);
  };
  if (has_column) {
    if (slot != k_none) {
      add(slot, xi, z, length);
    } else if (z < length) {
      const double phi = decay(z / length);
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
  const Index k = edge_constraint_[at(e)];
  if (k == k_none) return;
  for (Vec3& move : u) move = constrained_move(constraints_[at(k)], move);
}

void LayerField::face(Index f, int q, std::span<Vec3> u) const {
  if (u.empty()) return;
  const Index slot = wall_.face_slot[at(f)];
  const Shape shape = topology_.face_shape[at(f)];
  const std::span<const int> inner = interior_nodes(shape, q);
  if (slot != k_none) {
    const std::span<const Vec3> d = placement_.face_displacement(slot, q);
    for (std::size_t i = 0; i < u.size(); ++i) u[i] = d[sz(inner[i])];
    return;
  }
  const std::size_t n = sz(topology_.corners_of_face(f));
  const std::span<const Index> v(topology_.face2vertex[at(f)].data(), n);
  std::array<Index, 2> column_slots{k_none, k_none};
  for (std::size_t i = 0; i < 2; ++i) {
    const Index c = topology_.face2cell[at(f)][i];
    if (c != k_none) column_slots[i] = columns_.cell_face_slot[at(c)];
  }
  const Foot foot = foot_of(v, column_slots);
  for (std::size_t i = 0; i < u.size(); ++i) {
    std::array<double, 4> weight{};
    corner_weights(shape, lattice_xi(shape, q)[sz(inner[i])], weight);
    Vec3 x = Vec3::Zero();
    for (std::size_t k = 0; k < n; ++k) x += weight[k] * mesh_.vertices[at(v[k])];
    u[i] = displacement(x, q, &foot, std::span(weight.data(), n));
  }
  const Index k = face_constraint_[at(f)];
  if (k == k_none) return;
  for (Vec3& move : u) move = constrained_move(constraints_[at(k)], move);
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
    vertex_weights(shape, lattice_xi(shape, q)[sz(inner[i])], used);
    Vec3 x = Vec3::Zero();
    for (std::size_t k = 0; k < v.size(); ++k) x += weight[k] * mesh_.vertices[at(v[k])];
    u[i] = displacement(x, q, &foot, used);
  }
}

}  // namespace camber
