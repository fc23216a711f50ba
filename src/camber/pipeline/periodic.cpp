#include <camber/associate/association.hpp>
#include <camber/base/by_key.hpp>
#include <camber/base/error.hpp>
#include <camber/base/number_list.hpp>
#include <camber/base/sorted_set.hpp>
#include <camber/elevate/rescue.hpp>
#include <camber/pipeline/periodic.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <unordered_map>

#include <fmt/format.h>

namespace camber {
namespace {

/// Of the mesh's size: partners may be this far from one another's image.
constexpr double k_match = 1e-6;

std::vector<double> numbers_of(const std::string& text, std::string_view list) {
  return comma_separated(list, [&](std::string_view word) {
    throw OptionError(fmt::format("'{}' of '{}' is no number", word, text), "--periodic",
                      "give dx,dy,dz or x,y,z,ax,ay,az,degrees");
  });
}

RigidMotion rotation_about(const Vec3& point, const Vec3& axis, double angle) {
  RigidMotion motion;
  motion.rotation = Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
  motion.translation = point - motion.rotation * point;
  return motion;
}

/// Boundary faces of one patch of the file.
std::vector<Index> faces_of(const LinearMesh& mesh, const Topology& topology,
                            const std::string& name) {
  std::vector<Index> found;
  for (const auto& [entity, faces] : boundary_faces_by_entity(mesh, topology)) {
    if (entity == 0) continue;
    const bool is_meant = name == mesh.entity_name({2, entity}) || name == std::to_string(entity) ||
                          name == fmt::format("surface {}", entity);
    if (is_meant) found.insert(found.end(), faces.begin(), faces.end());
  }
  if (found.empty()) {
    throw OptionError(fmt::format("the mesh has no patch {}", name), "--periodic",
                      "camber info MESH lists its patches");
  }
  return found;
}

std::vector<Index> vertices_of(const Topology& topology, const std::vector<Index>& faces) {
  std::vector<Index> vertices;
  for (Index f : faces) {
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      vertices.push_back(topology.face2vertex[at(f)][static_cast<std::size_t>(i)]);
    }
  }
  make_sorted_set(vertices);
  return vertices;
}

Vec3 mean_of(const LinearMesh& mesh, const std::vector<Index>& vertices) {
  Vec3 sum = Vec3::Zero();
  for (Index v : vertices) sum += mesh.vertices[at(v)];
  return sum / static_cast<double>(vertices.size());
}

/// Nearest of some vertices, by their place along x.
class Nearest {
 public:
  Nearest(const LinearMesh& mesh, std::vector<Index> vertices)
      : mesh_(mesh), vertices_(std::move(vertices)) {
    std::sort(vertices_.begin(), vertices_.end(), [&](Index a, Index b) {
      return std::pair(mesh.vertices[at(a)].x(), a) < std::pair(mesh.vertices[at(b)].x(), b);
    });
  }
  /// -1 if none is within `reach`.
  [[nodiscard]] Index to(const Vec3& x, double reach) const {
    auto place =
        std::lower_bound(vertices_.begin(), vertices_.end(), x.x() - reach,
                         [&](Index v, double value) { return mesh_.vertices[at(v)].x() < value; });
    Index best = k_none;
    for (; place != vertices_.end() && mesh_.vertices[at(*place)].x() <= x.x() + reach; ++place) {
      const double distance = (mesh_.vertices[at(*place)] - x).norm();
      if (distance > reach) continue;
      reach = distance;
      best = *place;
    }
    return best;
  }

 private:
  const LinearMesh& mesh_;
  std::vector<Index> vertices_;
};

/// True if the motion maps every vertex onto one of `target`.
bool maps(const LinearMesh& mesh, const std::vector<Index>& vertices, const Nearest& target,
          const RigidMotion& motion) {
  return std::all_of(vertices.begin(), vertices.end(), [&](Index v) {
    return target.to(motion(mesh.vertices[at(v)]), k_match * mesh.size()) != k_none;
  });
}

/// Rotations about the line in which the planes of two patches meet.
std::vector<RigidMotion> rotations_between(const LinearMesh& mesh, const Topology& topology,
                                           const std::vector<Index>& from,
                                           const std::vector<Index>& to) {
  Vec3 origin_a, normal_a, origin_b, normal_b;
  const double flat = k_match * mesh.size();
  if (!fit_plane(mesh, topology, from, flat, origin_a, normal_a) ||
      !fit_plane(mesh, topology, to, flat, origin_b, normal_b)) {
    return {};
  }
  const Vec3 axis = normal_a.cross(normal_b);
  if (axis.norm() < 1e-9) return {};
  Mat3 planes;
  planes << normal_a.transpose(), normal_b.transpose(), axis.transpose();
  const Vec3 point = planes.fullPivLu().solve(
      Vec3(normal_a.dot(origin_a), normal_b.dot(origin_b), axis.dot(origin_a)));
  const double angle = std::atan2(axis.norm(), normal_a.dot(normal_b));
  std::vector<RigidMotion> motions;
  for (double turn : {angle, angle - std::numbers::pi, -angle, std::numbers::pi - angle}) {
    motions.push_back(rotation_about(point, axis, turn));
  }
  return motions;
}

RigidMotion find_motion(const LinearMesh& mesh, const Topology& topology, const PeriodicPair& pair,
                        const std::vector<Index>& from, const std::vector<Index>& to) {
  const std::vector<Index> a = vertices_of(topology, from), b = vertices_of(topology, to);
  if (a.size() != b.size() || from.size() != to.size()) {
    throw OptionError(
        fmt::format("patches {} and {} are no periodic pair: {} and {} faces, {} and {} vertices",
                    pair.from, pair.to, from.size(), to.size(), a.size(), b.size()),
        "--periodic", "mesh one as a copy of the other");
  }
  const Nearest target(mesh, b);
  std::vector<RigidMotion> candidates;
  if (pair.motion) {
    candidates.push_back(*pair.motion);
  } else {
    candidates.emplace_back();
    candidates.back().translation = mean_of(mesh, b) - mean_of(mesh, a);
    for (const RigidMotion& motion : rotations_between(mesh, topology, from, to)) {
      candidates.push_back(motion);
    }
  }
  for (const RigidMotion& motion : candidates) {
    if (maps(mesh, a, target, motion)) return motion;
  }
  throw OptionError(
      fmt::format("{} maps the vertices of patch {} onto those of {} within {:.3g}",
                  pair.motion ? "the motion given does not" : "no translation or rotation",
                  pair.from, pair.to, k_match * mesh.size()),
      "--periodic",
      "mesh one as a copy of the other, or give the motion: NAME=OTHER:dx,dy,dz or "
      "NAME=OTHER:x,y,z,ax,ay,az,degrees");
}

}  // namespace

PeriodicPair parse_periodic(const std::string& text) {
  const std::size_t equals = text.find('='), colon = text.rfind(':');
  const bool has_motion =
      colon != std::string::npos && equals != std::string::npos && colon > equals;
  PeriodicPair pair;
  pair.from = text.substr(0, equals);
  if (equals != std::string::npos) {
    pair.to = text.substr(equals + 1, has_motion ? colon - equals - 1 : std::string::npos);
  }
  if (pair.from.empty() || pair.to.empty() || pair.from == pair.to) {
    throw OptionError(fmt::format("'{}' names no two patches", text), "--periodic",
                      "give NAME=OTHER, both patches of the mesh");
  }
  if (!has_motion) return pair;
  const std::vector<double> n = numbers_of(text, std::string_view(text).substr(colon + 1));
  if (n.size() == 3) {
    pair.motion.emplace();
    pair.motion->translation = {n[0], n[1], n[2]};
  } else if (n.size() == 7 && Vec3(n[3], n[4], n[5]).norm() > 0.0) {
    pair.motion =
        rotation_about({n[0], n[1], n[2]}, {n[3], n[4], n[5]}, n[6] * std::numbers::pi / 180.0);
  } else {
    throw OptionError(fmt::format("'{}' is no motion", text.substr(colon + 1)), "--periodic",
                      "give dx,dy,dz, or x,y,z,ax,ay,az,degrees with an axis that has a length");
  }
  return pair;
}

PeriodicMatch::PeriodicMatch(const LinearMesh& mesh, const Topology& topology,
                             const std::vector<PeriodicPair>& pairs) {
  for (const PeriodicPair& pair : pairs) match(mesh, topology, pair);
}

void PeriodicMatch::match(const LinearMesh& mesh, const Topology& topology,
                          const PeriodicPair& pair) {
  const std::vector<Index> from = faces_of(mesh, topology, pair.from),
                           to = faces_of(mesh, topology, pair.to);
  PeriodicRow row{pair.from, pair.to, find_motion(mesh, topology, pair, from, to)};
  const Nearest target(mesh, vertices_of(topology, to));
  std::vector<Index> image(mesh.vertices.size(), k_none);
  for (Index v : vertices_of(topology, from)) {
    const Vec3 x = row.motion(mesh.vertices[at(v)]);
    image[at(v)] = target.to(x, k_match * mesh.size());
    row.largest_mismatch =
        std::max(row.largest_mismatch, (mesh.vertices[at(image[at(v)])] - x).norm());
  }
  std::unordered_map<CornerKey, Index, CornerKeyHash> face_of;
  const auto corners = [&](Index f) {
    return std::vector<Index>(topology.face2vertex[at(f)].begin(),
                              topology.face2vertex[at(f)].begin() + topology.corners_of_face(f));
  };
  for (Index f : to) face_of[corner_key(corners(f))] = f;
  std::map<Index, Index> edge_partner;
  for (Index f : from) {
    std::vector<Index> mapped = corners(f);
    for (Index& v : mapped) v = image[at(v)];
    const auto found = face_of.find(corner_key(mapped));
    if (found == face_of.end()) {
      throw OptionError(fmt::format("patches {} and {} have the same vertices but other faces",
                                    pair.from, pair.to),
                        "--periodic", "mesh one as a copy of the other");
    }
    faces_.push_back({f, found->second, rows_.size()});
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      const Index e = topology.face2edge[at(f)][static_cast<std::size_t>(i)];
      const std::array<Index, 2>& v = topology.edge2vertex[at(e)];
      edge_partner[e] = topology.find_edge(image[at(v[0])], image[at(v[1])]);
    }
  }
  for (const auto& [e, partner] : edge_partner) edges_.push_back({e, partner, rows_.size()});
  row.faces = from.size();
  row.edges = edge_partner.size();
  rows_.push_back(row);
  image_.push_back(std::move(image));
}

bool PeriodicMatch::ask_for_partners(const OrderField& orders, OrderRequests& requests) const {
  bool has_asked = false;
  const auto unify = [&](const std::vector<std::uint8_t>& order, std::vector<std::uint8_t>& asked,
                         const Partner& partner) {
    const std::uint8_t most = std::max(order[at(partner.from)], order[at(partner.to)]);
    for (Index side : {partner.from, partner.to}) {
      if (order[at(side)] == most) continue;
      asked[at(side)] = most;
      has_asked = true;
    }
  };
  for (const Partner& partner : edges_) unify(orders.edge, requests.edge, partner);
  for (const Partner& partner : faces_) unify(orders.face, requests.face, partner);
  return has_asked;
}

void PeriodicMatch::copy_edge(CurvedMesh& curved, const Partner& partner) const {
  const std::array<Index, 2>& from = curved.topology().edge2vertex[at(partner.from)];
  const std::array<Index, 2>& to = curved.topology().edge2vertex[at(partner.to)];
  const bool is_reversed = image_[partner.pair][at(from[0])] != to[0];
  const std::span<const Vec3> x = std::as_const(curved).edge_nodes(partner.from);
  const std::span<Vec3> y = curved.edge_nodes(partner.to);
  for (std::size_t k = 0; k < y.size(); ++k) {
    y[k] = rows_[partner.pair].motion(x[is_reversed ? x.size() - 1 - k : k]);
  }
}

void PeriodicMatch::copy_face(CurvedMesh& curved, const Partner& partner) const {
  const Topology& topology = curved.topology();
  const int q = curved.face_order(partner.to);
  const Shape shape = topology.face_shape[at(partner.to)];
  const std::size_t n = static_cast<std::size_t>(topology.corners_of_face(partner.to));
  const std::array<Index, 4>&from = topology.face2vertex[at(partner.from)],
                          &to = topology.face2vertex[at(partner.to)];
  std::vector<int> corner_of_from(n);
  for (std::size_t i = 0; i < n; ++i) {
    std::size_t k = 0;
    while (image_[partner.pair][at(from[k])] != to[i]) ++k;
    corner_of_from[i] = static_cast<int>(k);
  }
  const std::vector<int> place = reorient(shape, q, corner_of_from);
  const std::span<const int> inner = interior_nodes(shape, q);
  std::vector<std::size_t> inner_of(static_cast<std::size_t>(node_count(shape, q)), 0);
  for (std::size_t k = 0; k < inner.size(); ++k) inner_of[static_cast<std::size_t>(inner[k])] = k;
  const std::span<const Vec3> x = std::as_const(curved).face_nodes(partner.from);
  const std::span<Vec3> y = curved.face_nodes(partner.to);
  for (std::size_t k = 0; k < inner.size(); ++k) {
    const int node = place[static_cast<std::size_t>(inner[k])];
    y[k] = rows_[partner.pair].motion(x[inner_of[static_cast<std::size_t>(node)]]);
  }
}

void PeriodicMatch::copy(CurvedMesh& curved) {
  if (is_empty()) return;
  const CurvedMesh before = curved;
  const Topology& topology = curved.topology();
  std::vector<Index> touched;
  std::vector<std::uint8_t> is_edge_copied(edges_.size(), 0), is_face_copied(faces_.size(), 0);
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    if (curved.edge_order(edges_[i].from) != curved.edge_order(edges_[i].to)) continue;
    copy_edge(curved, edges_[i]);
    is_edge_copied[i] = 1;
    const std::span<const Index> around = topology.cells_of_edge(edges_[i].to);
    touched.insert(touched.end(), around.begin(), around.end());
  }
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    if (curved.face_order(faces_[i].from) != curved.face_order(faces_[i].to)) continue;
    copy_face(curved, faces_[i]);
    is_face_copied[i] = 1;
    touched.push_back(topology.face2cell[at(faces_[i].to)][0]);
  }
  make_sorted_set(touched);
  const auto put_back = [](std::uint8_t& is_copied, std::span<Vec3> now,
                           std::span<const Vec3> then) {
    if (is_copied) std::copy(then.begin(), then.end(), now.begin());
    is_copied = 0;
  };
  // Ends: with everything put back all are certified as before.
  for (std::vector<Index> bad; !(bad = uncertified_cells(curved, touched)).empty();) {
    const auto is_bad = [&](Index c) { return std::binary_search(bad.begin(), bad.end(), c); };
    std::size_t left = 0;
    for (std::size_t i = 0; i < edges_.size(); ++i) {
      const Index e = edges_[i].to;
      const std::span<const Index> around = topology.cells_of_edge(e);
      if (std::none_of(around.begin(), around.end(), is_bad)) continue;
      left += is_edge_copied[i];
      put_back(is_edge_copied[i], curved.edge_nodes(e), before.edge_nodes(e));
    }
    for (std::size_t i = 0; i < faces_.size(); ++i) {
      const Index f = faces_[i].to;
      if (!is_bad(topology.face2cell[at(f)][0])) continue;
      left += is_face_copied[i];
      put_back(is_face_copied[i], curved.face_nodes(f), before.face_nodes(f));
    }
    if (left == 0) break;  // not certified before either
  }
  const auto count = [&](const Partner& partner, std::uint8_t is_copied, std::span<const Vec3> now,
                         std::span<const Vec3> then) {
    PeriodicRow& row = rows_[partner.pair];
    row.refused += is_copied ? 0U : 1U;
    for (std::size_t k = 0; k < now.size(); ++k) {
      row.largest_change = std::max(row.largest_change, (now[k] - then[k]).norm());
    }
  };
  for (std::size_t i = 0; i < edges_.size(); ++i) {
    const Index e = edges_[i].to;
    count(edges_[i], is_edge_copied[i], std::as_const(curved).edge_nodes(e), before.edge_nodes(e));
  }
  for (std::size_t i = 0; i < faces_.size(); ++i) {
    const Index f = faces_[i].to;
    count(faces_[i], is_face_copied[i], std::as_const(curved).face_nodes(f), before.face_nodes(f));
  }
}

}  // namespace camber
