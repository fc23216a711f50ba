#include <camber/base/error.hpp>
#include <camber/base/parallel.hpp>
#include <camber/mesh/detail/export_points.hpp>

#include <algorithm>
#include <limits>
#include <set>

namespace camber::detail {
namespace {

constexpr std::size_t k_grain = 2048;

void set_point(MeshData& data, Index i, const Vec3& x, EntityKey key) {
  data.points[at(i)] = x;
  data.point_entity[at(i)] = key;
}

}  // namespace

ExportPoints::ExportPoints(const CurvedMesh& curved, int uniform_order)
    : curved_(curved),
      mesh_(curved.linear()),
      topology_(curved.topology()),
      uniform_(uniform_order) {
  collect_regions();
  mark_used();
  number_points();
}

void ExportPoints::place(MeshData& data) const {
  data.points.resize(count_);
  data.point_tags.resize(count_);
  data.point_entity.resize(count_);
  GlobalId tag = 1;
  for (GlobalId given : mesh_.vertex_tags) tag = std::max(tag, given + 1);
  for (std::size_t i = mesh_.vertices.size(); i < count_; ++i) data.point_tags[i] = tag++;
  place_vertices(data);
  place_edges(data);
  place_faces(data);
  place_cells(data);
}

/// Calls visit(first, last) for neighbours in the list that have one region and order.
template <class Visit>
void ExportPoints::for_each_run(const Visit& visit) const {
  const Index n = static_cast<Index>(mesh_.cell_count());
  for (Index first = 0, c = 0; c < n; first = c) {
    while (++c < n && mesh_.cell_region[at(c)] == mesh_.cell_region[at(first)] &&
           order_of(c) == order_of(first)) {
    }
    visit(first, c);
  }
}

/// A region with one order keeps its tag; else region * 10 + order, or * 100, ... until no tag
/// clashes.
void ExportPoints::collect_regions() {
  std::map<int, std::set<int>> orders;
  for_each_run(
      [&](Index first, Index) { orders[mesh_.cell_region[at(first)]].insert(order_of(first)); });
  std::map<std::pair<int, int>, int> entity_tag;  // (region, order) -> entity
  for (int factor = 10, is_unique = 0; !is_unique; factor *= 10) {
    entity_tag.clear();
    region_of_entity_.clear();
    is_unique = 1;
    for (const auto& [region, held] : orders) {
      for (int order : held) {
        const int tag = held.size() > 1 ? region * factor + order : region;
        entity_tag[{region, order}] = tag;
        is_unique &= region_of_entity_.emplace(tag, region).second;
      }
    }
  }
  cell_entity_.resize(mesh_.cell_count());
  for_each_run([&](Index first, Index last) {
    std::fill(cell_entity_.begin() + first, cell_entity_.begin() + last,
              entity_tag.at({mesh_.cell_region[at(first)], order_of(first)}));
  });
}

void ExportPoints::mark_used() {
  cell_.assign(mesh_.cell_count(), k_none);
  for (Index c = 0; at(c) < mesh_.cell_count(); ++c) {
    const std::size_t p = static_cast<std::size_t>(order_of(c));
    if (p < 2) continue;
    if (edge_[p].empty()) {
      edge_[p].assign(topology_.edge_count(), k_none);
      face_[p].assign(topology_.face_count(), k_none);
    }
    for (Index e : topology_.edges_of_cell(c)) edge_[p][at(e)] = 0;
    for (Index f : topology_.faces_of_cell(c)) face_[p][at(f)] = 0;
  }
  for (const LinearMesh::Line& line : mesh_.lines) {
    const Index e = topology_.find_edge(line.a, line.b);
    if (e == k_none) continue;
    edge_curve_[e] = line.curve;
  }
}

/// Vertices first, then by order the insides of edges, of faces and of cells.
void ExportPoints::number_points() {
  std::size_t next = mesh_.vertices.size();
  const auto number = [&](Index& first, std::size_t count) {
    first = static_cast<Index>(next);
    next += count;
    if (next > static_cast<std::size_t>(std::numeric_limits<Index>::max())) {
      throw MeshError("the curved mesh has more than 2147483647 nodes", "",
                      "choose a lower order or a smaller mesh");
    }
  };
  for (std::size_t q = 2; q < k_orders; ++q) {
    for (Index& first : edge_[q]) {
      if (first != k_none) number(first, q - 1);
    }
  }
  for (std::size_t q = 2; q < k_orders; ++q) {
    for (std::size_t f = 0; f < face_[q].size(); ++f) {
      if (face_[q][f] == k_none) continue;
      number(face_[q][f], interior_nodes(topology_.face_shape[f], static_cast<int>(q)).size());
    }
  }
  for (std::size_t q = 2; q < k_orders; ++q) {
    if (edge_[q].empty()) continue;
    for (std::size_t c = 0; c < cell_.size(); ++c) {
      const int p = order_of(static_cast<Index>(c));
      if (static_cast<std::size_t>(p) != q) continue;
      number(cell_[c], lattice_map(mesh_.cell_shape[c], p).interior.size());
    }
  }
  count_ = next;
}

EntityKey ExportPoints::class_of_edge(Index e) const {
  const auto curve = edge_curve_.find(e);
  if (curve != edge_curve_.end()) return {1, curve->second};
  return {3, entity_of(topology_.cells_of_edge(e)[0])};
}

void ExportPoints::place_vertices(MeshData& data) const {
  std::vector<EntityKey>& key = data.point_entity;
  for (Index c = 0; at(c) < mesh_.cell_count(); ++c) {
    for (Index v : mesh_.cell(c)) {
      if (key[at(v)].dim < 0) key[at(v)] = {3, entity_of(c)};
    }
  }
  for (std::size_t v = 0; v < mesh_.vertices.size(); ++v) {
    const EntityKey given = mesh_.vertex_entity[v];
    if (given.dim >= 0 && given.dim < 3) key[v] = given;
    data.points[v] = mesh_.vertices[v];
    data.point_tags[v] = mesh_.vertex_tags[v];
  }
}

void ExportPoints::place_edges(MeshData& data) const {
  std::vector<Index> patch_of_edge(topology_.edge_count(), k_none);
  for (std::size_t b = 0; b < mesh_.patch_face_shape.size(); ++b) {
    const Index f = topology_.patch_face2face[b];
    for (int i = 0; i < topology_.corners_of_face(f); ++i) {
      Index& owner = patch_of_edge[at(topology_.face2edge[at(f)][static_cast<std::size_t>(i)])];
      if (owner == k_none) owner = static_cast<Index>(b);
    }
  }
  for (std::size_t q = 2; q < k_orders; ++q) {
    parallel_for(edge_[q].size(), k_grain, [&](std::size_t begin, std::size_t end) {
      std::array<Vec3, 8> line;
      for (std::size_t e = begin; e < end; ++e) {
        const Index first = edge_[q][e], b = patch_of_edge[e];
        if (first == k_none) continue;
        EntityKey key = class_of_edge(static_cast<Index>(e));
        if (key.dim == 3 && b != k_none) key = {2, mesh_.patch_face_entity[at(b)]};
        curved_.edge_lattice(static_cast<Index>(e), static_cast<int>(q), line);
        for (std::size_t i = 1; i < q; ++i) {
          set_point(data, first + static_cast<Index>(i - 1), line[i], key);
        }
      }
    });
  }
}

void ExportPoints::place_faces(MeshData& data) const {
  for (std::size_t q = 2; q < k_orders; ++q) {
    parallel_for(face_[q].size(), k_grain, [&](std::size_t begin, std::size_t end) {
      std::array<Vec3, 49> surface;
      for (std::size_t f = begin; f < end; ++f) {
        Index next = face_[q][f];
        if (next == k_none) continue;
        const std::span<const int> inner =
            interior_nodes(topology_.face_shape[f], static_cast<int>(q));
        if (inner.empty()) continue;
        const Index b = topology_.face2patch_face[f];
        const EntityKey key = b != k_none ? EntityKey{2, mesh_.patch_face_entity[at(b)]}
                                          : EntityKey{3, entity_of(topology_.face2cell[f][0])};
        curved_.face_lattice(static_cast<Index>(f), static_cast<int>(q), surface);
        for (int n : inner) set_point(data, next++, surface[static_cast<std::size_t>(n)], key);
      }
    });
  }
}

void ExportPoints::place_cells(MeshData& data) const {
  parallel_for(cell_.size(), k_grain, [&](std::size_t begin, std::size_t end) {
    Points nodes;
    for (std::size_t i = begin; i < end; ++i) {
      const Index c = static_cast<Index>(i);
      Index next = cell_[i];
      if (next == k_none) continue;
      const int q = order_of(c);
      const std::vector<int>& inner = lattice_map(mesh_.cell_shape[i], q).interior;
      if (inner.empty()) continue;
      curved_.gather(c, q, nodes);
      for (int n : inner) {
        set_point(data, next++, nodes[static_cast<std::size_t>(n)], {3, entity_of(c)});
      }
    }
  });
}

}  // namespace camber::detail
