#include <camber/base/by_key.hpp>
#include <camber/base/error.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/mesh/elevate_data.hpp>
#include <camber/mesh/topology.hpp>

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

namespace camber {
namespace {

/// Two neighbours make the same of an edge or face if their nodes differ by no more than this share
/// of its size: far above rounding, far below any gap that matters.
constexpr double k_same = 1e-10;

/// Nodes strictly inside an edge or face, in a frame that all its elements agree on.
struct Entity {
  CornerKey key;
  std::vector<int> slots;  // frame order -> node of the element
};

/// Edge from its smaller to its larger corner.
Entity edge_entity(std::array<Index, 2> corners, const std::vector<int>& slots) {
  Entity entity{corner_key(corners), slots};
  if (corners[0] > corners[1]) std::reverse(entity.slots.begin(), entity.slots.end());
  return entity;
}

/// Face from its smallest corner towards the smaller neighbour of that corner.
/// @param slots  element nodes of all lattice points of the face as the element walks it
Entity face_entity(Shape shape, int order, const std::array<Index, 4>& corners,
                   const std::vector<int>& slots) {
  const std::size_t n = shape == Shape::triangle ? 3 : 4;
  const std::size_t first = static_cast<std::size_t>(
      std::min_element(corners.begin(), corners.begin() + static_cast<std::ptrdiff_t>(n)) -
      corners.begin());
  const bool is_forward = corners[(first + 1) % n] < corners[(first + n - 1) % n];
  // frame_corner[i] = place, in the element's walk, of corner i of the frame.
  std::vector<int> frame_corner(n);
  for (std::size_t i = 0; i < n; ++i) {
    frame_corner[i] = static_cast<int>((is_forward ? first + i : first + n - i) % n);
  }
  Entity entity;
  entity.key = n == 4 ? corner_key(corners)
                      : corner_key(std::array<Index, 3>{corners[0], corners[1], corners[2]});
  const std::vector<int> node = reorient(shape, order, frame_corner);
  for (int inner : interior_nodes(shape, order)) entity.slots.push_back(slots[at(node[at(inner)])]);
  return entity;
}

/// Edges and faces of one element that have nodes inside at this order.
std::vector<Entity> entities_of(Shape shape, int order, std::span<const Index> nodes) {
  const LatticeMap& map = lattice_map(shape, order);
  const auto corner = [&](int i) { return nodes[at(map.corner[at(i)])]; };
  std::vector<Entity> all;
  const std::span<const std::array<int, 2>> shape_edges = edges(shape);
  for (std::size_t e = 0; e < shape_edges.size(); ++e) {
    all.push_back(
        edge_entity({corner(shape_edges[e][0]), corner(shape_edges[e][1])}, map.edge_interior[e]));
  }
  const std::span<const LocalFace> shape_faces = faces(shape);
  for (std::size_t f = 0; f < shape_faces.size(); ++f) {
    if (map.face_interior[f].empty()) continue;
    std::array<Index, 4> v{k_none, k_none, k_none, k_none};
    for (std::size_t i = 0; i < 4; ++i) {
      if (shape_faces[f].corners[i] >= 0) v[i] = corner(shape_faces[f].corners[i]);
    }
    all.push_back(face_entity(shape_faces[f].shape, order, v, map.face[f]));
  }
  return all;
}

class Elevator {
 public:
  Elevator(const MeshData& data, int order) : order_(order), out_(data) {
    for (GlobalId tag : data.point_tags) next_tag_ = std::max(next_tag_, tag + 1);
  }

  MeshData run() {
    if (order_ > 1) {
      for (const ElementBlock& block : out_.blocks) {
        if (block.order == order_ && dimension(block.shape) > 0) register_block(block);
      }
    }
    for (int dim = 1; dim <= 3; ++dim) {
      for (ElementBlock& block : out_.blocks) {
        if (dimension(block.shape) != dim || block.order == order_) continue;
        if (order_ == 1) {
          take_corners(block);
        } else {
          elevate(block);
        }
      }
    }
    drop_unused_points();
    return std::move(out_);
  }

 private:
  void register_block(const ElementBlock& block) {
    const auto stride = at(node_count(block.shape, order_));
    for (std::size_t i = 0; i < block.size(); ++i) {
      const std::span<const Index> nodes = std::span(block.nodes).subspan(i * stride, stride);
      for (const Entity& entity : entities_of(block.shape, order_, nodes)) {
        std::vector<Index> inner;
        Points positions;
        for (int slot : entity.slots) {
          inner.push_back(nodes[at(slot)]);
          positions.push_back(out_.points[at(inner.back())]);
        }
        if (!find(entity.key, positions)) known_.emplace(entity.key, std::move(inner));
      }
    }
  }

  void take_corners(ElementBlock& block) {
    const std::vector<int>& corner = lattice_map(block.shape, block.order).corner;
    const std::vector<int>& place = lattice_map(block.shape, 1).corner;
    const auto stride = at(node_count(block.shape, block.order));
    const std::size_t count = block.size();
    std::vector<Index> nodes(count * corner.size());
    for (std::size_t i = 0; i < count; ++i) {
      for (std::size_t c = 0; c < corner.size(); ++c) {
        nodes[i * corner.size() + at(place[c])] = block.nodes[i * stride + at(corner[c])];
      }
    }
    block.nodes = std::move(nodes);
    block.order = 1;
  }

  void elevate(ElementBlock& block) {
    const int p = block.order;
    const MatX& matrix = elevation_matrix(block.shape, p, order_);
    const std::vector<int>& from = lattice_map(block.shape, p).corner;
    const LatticeMap& map = lattice_map(block.shape, order_);
    const auto stride = at(node_count(block.shape, p));
    const auto new_stride = at(node_count(block.shape, order_));
    const std::size_t count = block.size();
    const EntityKey owner{dimension(block.shape), block.entity};
    std::vector<Index> all(count * new_stride, k_none);
    Points positions(new_stride);
    for (std::size_t i = 0; i < count; ++i) {
      const std::span<const Index> old = std::span(block.nodes).subspan(i * stride, stride);
      const std::span<Index> nodes = std::span(all).subspan(i * new_stride, new_stride);
      for (std::size_t row = 0; row < new_stride; ++row) {
        positions[row] = Vec3::Zero();
        for (std::size_t k = 0; k < stride; ++k) {
          positions[row] += matrix(static_cast<Eigen::Index>(row), static_cast<Eigen::Index>(k)) *
                            out_.points[at(old[k])];
        }
      }
      for (std::size_t c = 0; c < from.size(); ++c) nodes[at(map.corner[c])] = old[at(from[c])];
      for (const Entity& entity : entities_of(block.shape, order_, nodes)) {
        Points wanted;
        for (int slot : entity.slots) wanted.push_back(positions[at(slot)]);
        const std::vector<Index>& inner = find_or_add(entity.key, wanted, owner);
        for (std::size_t k = 0; k < inner.size(); ++k) nodes[at(entity.slots[k])] = inner[k];
      }
      for (std::size_t k = 0; k < new_stride; ++k) {
        if (nodes[k] == k_none) nodes[k] = add_point(positions[k], owner);
      }
    }
    block.nodes = std::move(all);
    block.order = order_;
  }

  /// Nodes that are known for the entity and lie where wanted, or null.
  [[nodiscard]] const std::vector<Index>* find(const CornerKey& key, const Points& wanted) const {
    const auto [begin, end] = known_.equal_range(key);
    if (begin == end) return nullptr;
    Box box;
    for (Index v : key.v) {
      if (v != k_none) box.add(out_.points[at(v)]);
    }
    for (const Vec3& x : wanted) box.add(x);
    const double far = std::max(box.lower.cwiseAbs().maxCoeff(), box.upper.cwiseAbs().maxCoeff());
    const double tolerance =
        k_same * box.diagonal() + 64.0 * std::numeric_limits<double>::epsilon() * far;
    for (auto candidate = begin; candidate != end; ++candidate) {
      const std::vector<Index>& nodes = candidate->second;
      bool is_same = nodes.size() == wanted.size();
      for (std::size_t k = 0; is_same && k < wanted.size(); ++k) {
        is_same = (out_.points[at(nodes[k])] - wanted[k]).norm() <= tolerance;
      }
      if (is_same) return &nodes;
    }
    return nullptr;
  }

  const std::vector<Index>& find_or_add(const CornerKey& key, const Points& wanted,
                                        EntityKey owner) {
    if (const std::vector<Index>* nodes = find(key, wanted)) return *nodes;
    std::vector<Index> nodes;
    for (const Vec3& x : wanted) nodes.push_back(add_point(x, owner));
    return known_.emplace(key, std::move(nodes))->second;
  }

  Index add_point(const Vec3& x, EntityKey owner) {
    out_.points.push_back(x);
    if (!out_.point_tags.empty()) out_.point_tags.push_back(next_tag_++);
    if (!out_.point_entity.empty()) out_.point_entity.push_back(owner);
    if (!out_.point_parameters.empty()) {
      out_.point_parameters.push_back(Vec2::Constant(std::numeric_limits<double>::quiet_NaN()));
    }
    return static_cast<Index>(out_.points.size() - 1);
  }

  void drop_unused_points() {
    std::vector<Index> new_index(out_.points.size(), k_none);
    for (const ElementBlock& block : out_.blocks) {
      for (Index node : block.nodes) new_index[at(node)] = 0;
    }
    Index next = 0;
    for (std::size_t i = 0; i < new_index.size(); ++i) {
      if (new_index[i] == k_none) continue;
      const std::size_t to = at(next);
      out_.points[to] = out_.points[i];
      if (!out_.point_tags.empty()) out_.point_tags[to] = out_.point_tags[i];
      if (!out_.point_entity.empty()) out_.point_entity[to] = out_.point_entity[i];
      if (!out_.point_parameters.empty()) out_.point_parameters[to] = out_.point_parameters[i];
      new_index[i] = next++;
    }
    out_.points.resize(at(next));
    if (!out_.point_tags.empty()) out_.point_tags.resize(at(next));
    if (!out_.point_entity.empty()) out_.point_entity.resize(at(next));
    if (!out_.point_parameters.empty()) out_.point_parameters.resize(at(next));
    for (ElementBlock& block : out_.blocks) {
      for (Index& node : block.nodes) node = new_index[at(node)];
    }
  }

  int order_;
  MeshData out_;
  GlobalId next_tag_ = 1;
  std::unordered_multimap<CornerKey, std::vector<Index>, CornerKeyHash> known_;
};

}  // namespace

MeshData at_order(const MeshData& data, int order) {
  if (order < 1 || order > k_max_order) {
    throw OptionError(fmt::format("order {} is not possible", order), "--order",
                      fmt::format("choose 1..{}", k_max_order));
  }
  for (const ElementBlock& block : data.blocks) {
    if (order == 1 || dimension(block.shape) == 0 || block.order <= order) continue;
    throw OptionError(fmt::format("the mesh holds {} elements of order {}, which order {} cannot "
                                  "represent",
                                  name(block.shape), block.order, order),
                      "--order",
                      fmt::format("choose {}..{}, or 1 for the corners", block.order, k_max_order));
  }
  return Elevator(data, order).run();
}

}  // namespace camber
