#include <camber/base/error.hpp>
#include <camber/mesh/export_mesh.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

namespace camber {
namespace {

constexpr std::size_t k_orders = static_cast<std::size_t>(k_max_order) + 1;

/// File nodes of one kind of entity (edges, faces, cells) by order: first[q][i] is the first point
/// of entity i at order q, or -1.
using FirstPoint = std::array<std::vector<Index>, k_orders>;

class Exporter {
 public:
  Exporter(const CurvedMesh& curved, int uniform_order)
      : curved_(curved),
        mesh_(curved.linear()),
        topology_(curved.topology()),
        uniform_(uniform_order) {}

  MeshData run(ExportMap* map) {
    collect_regions();
    mark_used();
    place_vertices();
    place_edges();
    place_faces();
    place_cells();
    write_cell_blocks();
    write_patch_blocks();
    write_line_blocks();
    write_entities();
    if (map) *map = std::move(map_);
    return std::move(data_);
  }

 private:
  [[nodiscard]] int order_of(Index c) const {
    return uniform_ > 0 ? uniform_ : curved_.cell_order(c);
  }
  [[nodiscard]] int entity_of(Index c) const {
    return entity_tag_.at({mesh_.cell_region[at(c)], order_of(c)});
  }
  [[nodiscard]] int patch_order(Index f) const { return order_of(topology_.face2cell[at(f)][0]); }

  /// A region with one order keeps its tag; else region * 10 + order, or * 100, ... until no tag
  /// clashes.
  void collect_regions() {
    std::map<int, std::set<int>> orders;
    for (Index c = 0; at(c) < mesh_.cell_count(); ++c) {
      orders[mesh_.cell_region[at(c)]].insert(order_of(c));
    }
    for (int factor = 10;; factor *= 10) {
      entity_tag_.clear();
      region_of_entity_.clear();
      bool is_unique = true;
      for (const auto& [region, held] : orders) {
        for (int order : held) {
          const int tag = held.size() > 1 ? region * factor + order : region;
          entity_tag_[{region, order}] = tag;
          is_unique = region_of_entity_.emplace(tag, region).second && is_unique;
        }
      }
      if (is_unique) return;
    }
  }

  void mark_used() {
    for (std::size_t q = 2; q < k_orders; ++q) {
      edge_[q].assign(topology_.edge_count(), k_none);
      face_[q].assign(topology_.face_count(), k_none);
      cell_[q].assign(mesh_.cell_count(), k_none);
    }
    for (Index c = 0; at(c) < mesh_.cell_count(); ++c) {
      const std::size_t p = static_cast<std::size_t>(order_of(c));
      if (p < 2) continue;
      for (Index e : topology_.edges_of_cell(c)) edge_[p][at(e)] = 0;
      for (Index f : topology_.faces_of_cell(c)) face_[p][at(f)] = 0;
      cell_[p][at(c)] = 0;
    }
    for (const LinearMesh::Line& line : mesh_.lines) {
      const Index e = topology_.find_edge(line.a, line.b);
      if (e == k_none) continue;
      edge_curve_[e] = line.curve;
    }
  }

  EntityKey class_of_edge(Index e) const {
    const auto curve = edge_curve_.find(e);
    if (curve != edge_curve_.end()) return {1, curve->second};
    return {3, entity_of(topology_.cells_of_edge(e)[0])};
  }

  void add_point(const Vec3& x, EntityKey key, GlobalId tag) {
    data_.points.push_back(x);
    data_.point_tags.push_back(tag);
    data_.point_entity.push_back(key);
  }

  void place_vertices() {
    std::vector<EntityKey> key(mesh_.vertices.size());
    for (Index c = 0; at(c) < mesh_.cell_count(); ++c) {
      for (Index v : mesh_.cell(c)) {
        if (key[at(v)].dim < 0) key[at(v)] = {3, entity_of(c)};
      }
    }
    for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
      const EntityKey given = mesh_.vertex_entity[v];
      if (given.dim >= 0 && given.dim < 3) key[v] = given;
      add_point(mesh_.vertices[v], key[v], mesh_.vertex_tags[v]);
      next_tag_ = std::max(next_tag_, mesh_.vertex_tags[v] + 1);
    }
  }

  void place_edges() {
    std::vector<Index> patch_of_edge(topology_.edge_count(), k_none);
    for (std::size_t b = 0; b < mesh_.patch_face_shape.size(); ++b) {
      const Index f = topology_.patch_face2face[b];
      for (int i = 0; i < topology_.corners_of_face(f); ++i) {
        Index& owner = patch_of_edge[at(topology_.face2edge[at(f)][static_cast<std::size_t>(i)])];
        if (owner == k_none) owner = static_cast<Index>(b);
      }
    }
    std::array<Vec3, 8> line;
    for (std::size_t q = 2; q < k_orders; ++q) {
      for (Index e = 0; at(e) < topology_.edge_count(); ++e) {
        if (edge_[q][at(e)] == k_none) continue;
        edge_[q][at(e)] = static_cast<Index>(data_.points.size());
        EntityKey key = class_of_edge(e);
        const Index b = patch_of_edge[at(e)];
        if (key.dim == 3 && b != k_none) key = {2, mesh_.patch_face_entity[at(b)]};
        curved_.edge_lattice(e, static_cast<int>(q), line);
        for (std::size_t i = 1; i < q; ++i) add_point(line[i], key, next_tag_++);
      }
    }
  }

  void place_faces() {
    std::array<Vec3, 49> surface;
    for (std::size_t q = 2; q < k_orders; ++q) {
      for (Index f = 0; at(f) < topology_.face_count(); ++f) {
        if (face_[q][at(f)] == k_none) continue;
        face_[q][at(f)] = static_cast<Index>(data_.points.size());
        const Index b = topology_.face2patch_face[at(f)];
        const EntityKey key = b != k_none ? EntityKey{2, mesh_.patch_face_entity[at(b)]}
                                          : EntityKey{3, entity_of(topology_.face2cell[at(f)][0])};
        curved_.face_lattice(f, static_cast<int>(q), surface);
        for (int n : interior_nodes(topology_.face_shape[at(f)], static_cast<int>(q))) {
          add_point(surface[static_cast<std::size_t>(n)], key, next_tag_++);
        }
      }
    }
  }

  void place_cells() {
    Points nodes;
    for (std::size_t q = 2; q < k_orders; ++q) {
      for (Index c = 0; at(c) < mesh_.cell_count(); ++c) {
        if (cell_[q][at(c)] == k_none) continue;
        cell_[q][at(c)] = static_cast<Index>(data_.points.size());
        const std::vector<int>& inner =
            lattice_map(mesh_.cell_shape[at(c)], static_cast<int>(q)).interior;
        if (inner.empty()) continue;
        curved_.gather(c, static_cast<int>(q), nodes);
        for (int n : inner)
          add_point(nodes[static_cast<std::size_t>(n)], {3, entity_of(c)}, next_tag_++);
      }
    }
  }

  void put_edge(Index e, int p, bool reversed, const std::vector<int>& slots, Index* nodes) const {
    const Index first = edge_[static_cast<std::size_t>(p)][at(e)];
    for (std::size_t k = 0; k < slots.size(); ++k) {
      nodes[slots[k]] = first + static_cast<Index>(reversed ? slots.size() - 1 - k : k);
    }
  }

  /// Face interior nodes into `slots` (all lattice nodes of the face as the viewer walks it).
  void put_face(Index f, int p, int view, const std::vector<int>& slots, Index* nodes) const {
    const Shape shape = topology_.face_shape[at(f)];
    const std::span<const int> inner = interior_nodes(shape, p);
    const std::span<const int> frame_node = face_view_nodes(shape, view, p);
    const Index first = face_[static_cast<std::size_t>(p)][at(f)];
    for (int n : inner) {
      const int stored = frame_node[static_cast<std::size_t>(n)];
      const auto place = std::lower_bound(inner.begin(), inner.end(), stored) - inner.begin();
      nodes[slots[static_cast<std::size_t>(n)]] = first + static_cast<Index>(place);
    }
  }

  void write_cell_blocks() {
    std::map<std::tuple<int, Shape, int>, std::vector<Index>> groups;
    for (Index c = 0; at(c) < mesh_.cell_count(); ++c) {
      groups[{entity_of(c), mesh_.cell_shape[at(c)], order_of(c)}].push_back(c);
    }
    for (const auto& [key, cells] : groups) {
      const auto [entity, shape, p] = key;
      ElementBlock block{shape, p, entity, {}, {}};
      const std::size_t stride = static_cast<std::size_t>(node_count(shape, p));
      block.nodes.resize(cells.size() * stride);
      const LatticeMap& map = lattice_map(shape, p);
      for (std::size_t i = 0; i < cells.size(); ++i) {
        cell_nodes(cells[i], p, map, block.nodes.data() + i * stride);
        block.tags.push_back(mesh_.cell_tags[at(cells[i])]);
        map_.cell.push_back(cells[i]);
        map_.face.push_back(k_none);
      }
      data_.blocks.push_back(std::move(block));
    }
  }

  void cell_nodes(Index c, int p, const LatticeMap& map, Index* nodes) const {
    const std::span<const Index> v = mesh_.cell(c);
    for (std::size_t i = 0; i < v.size(); ++i) nodes[map.corner[i]] = v[i];
    if (p < 2) return;
    const std::span<const Index> cell_edges = topology_.edges_of_cell(c);
    for (std::size_t i = 0; i < cell_edges.size(); ++i) {
      const bool reversed =
          topology_.cell2edge_reversed[at(topology_.cell2edge_offset[at(c)]) + i] != 0;
      put_edge(cell_edges[i], p, reversed, map.edge_interior[i], nodes);
    }
    const std::span<const Index> cell_faces = topology_.faces_of_cell(c);
    for (std::size_t i = 0; i < cell_faces.size(); ++i) {
      const int view = topology_.cell2face_view[at(topology_.cell2face_offset[at(c)]) + i];
      put_face(cell_faces[i], p, view, map.face[i], nodes);
    }
    const Index first = cell_[static_cast<std::size_t>(p)][at(c)];
    for (std::size_t i = 0; i < map.interior.size(); ++i) {
      nodes[map.interior[i]] = first + static_cast<Index>(i);
    }
  }

  /// Surface elements keep the corner order of the file, which may be any of the face's views.
  void write_patch_blocks() {
    std::map<std::tuple<int, Shape, int>, std::vector<Index>> groups;
    for (std::size_t b = 0; b < mesh_.patch_face_shape.size(); ++b) {
      const Index f = topology_.patch_face2face[b];
      if (topology_.face2patch_face[at(f)] != static_cast<Index>(b)) continue;
      groups[{mesh_.patch_face_entity[b], mesh_.patch_face_shape[b], patch_order(f)}].push_back(
          static_cast<Index>(b));
    }
    for (const auto& [key, patch_faces] : groups) {
      const auto [entity, shape, p] = key;
      ElementBlock block{shape, p, entity, {}, {}};
      const std::size_t stride = static_cast<std::size_t>(node_count(shape, p));
      block.nodes.resize(patch_faces.size() * stride);
      for (std::size_t i = 0; i < patch_faces.size(); ++i) {
        const Index b = patch_faces[i];
        patch_nodes(b, p, block.nodes.data() + i * stride);
        block.tags.push_back(0);
        map_.cell.push_back(k_none);
        map_.face.push_back(topology_.patch_face2face[at(b)]);
      }
      data_.blocks.push_back(std::move(block));
    }
  }

  void patch_nodes(Index b, int p, Index* nodes) const {
    const Shape shape = mesh_.patch_face_shape[at(b)];
    const Index f = topology_.patch_face2face[at(b)];
    const LatticeMap& map = lattice_map(shape, p);
    const std::array<Index, 4>& v = mesh_.patch_face_vertices[at(b)];
    const std::size_t n = shape == Shape::triangle ? 3 : 4;
    for (std::size_t i = 0; i < n; ++i) nodes[map.corner[i]] = v[i];
    if (p < 2) return;
    for (std::size_t i = 0; i < n; ++i) {
      const Index a = v[i], b2 = v[(i + 1) % n];
      put_edge(topology_.find_edge(a, b2), p, a > b2, map.edge_interior[i], nodes);
    }
    std::vector<int> slots(static_cast<std::size_t>(node_count(shape, p)));
    for (std::size_t k = 0; k < slots.size(); ++k) slots[k] = static_cast<int>(k);
    // build_topology has refused twisted surface elements.
    put_face(f, p, face_view(shape, std::span(v.data(), n), topology_.face2vertex[at(f)]), slots,
             nodes);
  }

  /// A line takes the lowest order at which its edge is written: one that a neighbouring cell has.
  void write_line_blocks() {
    std::map<std::pair<int, int>, std::vector<const LinearMesh::Line*>> groups;
    for (const LinearMesh::Line& line : mesh_.lines) {
      const Index e = topology_.find_edge(line.a, line.b);
      if (e == k_none) continue;
      int p = uniform_ > 0 ? uniform_ : curved_.edge_order(e);
      groups[{line.curve, p}].push_back(&line);
    }
    for (const auto& [key, lines] : groups) {
      ElementBlock block{Shape::line, key.second, key.first, {}, {}};
      const std::size_t stride = static_cast<std::size_t>(key.second) + 1;
      block.nodes.resize(lines.size() * stride);
      for (std::size_t i = 0; i < lines.size(); ++i) {
        Index* nodes = block.nodes.data() + i * stride;
        const Index a = lines[i]->a, b = lines[i]->b;
        nodes[0] = a;
        nodes[stride - 1] = b;
        if (key.second > 1) {
          const Index first =
              edge_[static_cast<std::size_t>(key.second)][at(topology_.find_edge(a, b))];
          for (std::size_t k = 1; k + 1 < stride; ++k) {
            nodes[k] = first + static_cast<Index>(a < b ? k - 1 : stride - 2 - k);
          }
        }
        block.tags.push_back(0);
        map_.cell.push_back(k_none);
        map_.face.push_back(k_none);
      }
      data_.blocks.push_back(std::move(block));
    }
  }

  void write_entities() {
    data_.physical_names = mesh_.physical_names;
    std::set<EntityKey> present;
    for (const ElementBlock& block : data_.blocks)
      present.insert({dimension(block.shape), block.entity});
    for (const EntityKey& key : data_.point_entity) present.insert(key);
    for (const EntityKey& key : present) {
      EntityRecord record;
      record.key = key;
      EntityKey origin = key;
      if (key.dim == 3) origin.tag = region_of_entity_.at(key.tag);
      for (const EntityRecord& given : mesh_.entities) {
        if (given.key == origin) {
          record.name = given.name;
          record.physical_tags = given.physical_tags;
        }
      }
      data_.entities.push_back(std::move(record));
    }
    number_elements();
  }

  /// Surface and curve elements get numbers after those of the cells.
  void number_elements() {
    GlobalId next = 1;
    for (GlobalId tag : mesh_.cell_tags) next = std::max(next, tag + 1);
    for (ElementBlock& block : data_.blocks) {
      if (dimension(block.shape) == 3) continue;
      for (GlobalId& tag : block.tags) tag = next++;
    }
  }

  const CurvedMesh& curved_;
  const LinearMesh& mesh_;
  const Topology& topology_;
  int uniform_;
  std::map<std::pair<int, int>, int> entity_tag_;  // (region, order) -> entity
  std::map<int, int> region_of_entity_;
  std::map<Index, int> edge_curve_;
  FirstPoint edge_, face_, cell_;
  GlobalId next_tag_ = 1;
  MeshData data_;
  ExportMap map_;
};

}  // namespace

MeshData export_mesh(const CurvedMesh& curved, int uniform_order, ExportMap* map) {
  if (uniform_order > 0) {
    int highest = 1;
    for (std::uint8_t p : curved.orders().cell) highest = std::max(highest, static_cast<int>(p));
    if (uniform_order < highest || uniform_order > k_max_order) {
      throw OptionError(
          fmt::format("uniform order {} is not possible", uniform_order), "--uniform",
          fmt::format("the mesh holds order {}; choose {}..{}", highest, highest, k_max_order));
    }
  }
  return Exporter(curved, uniform_order).run(map);
}

}  // namespace camber
