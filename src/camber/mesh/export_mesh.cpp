#include <camber/base/error.hpp>
#include <camber/base/parallel.hpp>
#include <camber/mesh/detail/export_points.hpp>
#include <camber/mesh/export_mesh.hpp>

#include <algorithm>
#include <array>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

namespace camber {
namespace {

constexpr std::size_t k_export_grain = 2048;

class Exporter {
 public:
  Exporter(const CurvedMesh& curved, int uniform_order)
      : curved_(curved),
        mesh_(curved.linear()),
        topology_(curved.topology()),
        uniform_(uniform_order),
        points_(curved, uniform_order) {}

  /// @param placed  called when the nodes of the curved mesh are no longer needed
  template <class Placed>
  MeshData run(ExportMap* map, const Placed& placed) {
    points_.place(data_);
    placed();
    write_cell_blocks(map);
    write_patch_blocks(map);
    write_line_blocks(map);
    write_entities();
    return std::move(data_);
  }

 private:
  [[nodiscard]] int patch_order(Index f) const {
    return points_.order_of(topology_.face2cell[at(f)][0]);
  }

  void put_edge(Index e, int p, bool reversed, const std::vector<int>& slots, Index* nodes) const {
    const Index first = points_.first_of_edge(e, p);
    for (std::size_t k = 0; k < slots.size(); ++k) {
      nodes[slots[k]] = first + static_cast<Index>(reversed ? slots.size() - 1 - k : k);
    }
  }

  /// Face interior nodes into `slots` (all lattice nodes of the face as the viewer walks it).
  void put_face(Index f, int p, int view, const std::vector<int>& slots, Index* nodes) const {
    const Shape shape = topology_.face_shape[at(f)];
    const std::span<const int> inner = interior_nodes(shape, p);
    const std::span<const int> place = face_view_interior(shape, view, p);
    const Index first = points_.first_of_face(f, p);
    for (std::size_t k = 0; k < inner.size(); ++k) {
      nodes[slots[static_cast<std::size_t>(inner[k])]] = first + place[k];
    }
  }

  void write_cell_blocks(ExportMap* map) {
    using Key = std::tuple<int, Shape, int>;
    std::map<Key, std::vector<Index>> groups;
    // Cells of a kind mostly follow each other: the map is asked once a run.
    Key last{};
    std::vector<Index>* cells_of_last = nullptr;
    for (Index c = 0; at(c) < mesh_.cell_count(); ++c) {
      const Key key{points_.entity_of(c), mesh_.cell_shape[at(c)], points_.order_of(c)};
      if (!cells_of_last || key != last) cells_of_last = &groups[key];
      last = key;
      cells_of_last->push_back(c);
    }
    for (auto& [key, cells] : groups) {
      const auto [entity, shape, p] = key;
      ElementBlock block{shape, p, entity, {}, {}};
      const std::size_t stride = static_cast<std::size_t>(node_count(shape, p));
      block.nodes.resize(cells.size() * stride);
      block.tags.resize(cells.size());
      const LatticeMap& lattice = lattice_map(shape, p);
      parallel_for(cells.size(), k_export_grain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
          cell_nodes(cells[i], p, lattice, block.nodes.data() + i * stride);
          block.tags[i] = mesh_.cell_tags[at(cells[i])];
        }
      });
      if (map) {
        map->cell.insert(map->cell.end(), cells.begin(), cells.end());
        map->face.insert(map->face.end(), cells.size(), k_none);
      }
      data_.blocks.push_back(std::move(block));
      cells = {};
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
    const Index first = points_.first_of_cell(c);
    for (std::size_t i = 0; i < map.interior.size(); ++i) {
      nodes[map.interior[i]] = first + static_cast<Index>(i);
    }
  }

  /// Surface elements keep the corner order of the file, which may be any of the face's views.
  void write_patch_blocks(ExportMap* map) {
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
        if (!map) continue;
        map->cell.push_back(k_none);
        map->face.push_back(topology_.patch_face2face[at(b)]);
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
  void write_line_blocks(ExportMap* map) {
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
          const Index first = points_.first_of_edge(topology_.find_edge(a, b), key.second);
          for (std::size_t k = 1; k + 1 < stride; ++k) {
            nodes[k] = first + static_cast<Index>(a < b ? k - 1 : stride - 2 - k);
          }
        }
        block.tags.push_back(0);
        if (!map) continue;
        map->cell.push_back(k_none);
        map->face.push_back(k_none);
      }
      data_.blocks.push_back(std::move(block));
    }
  }

  void write_entities() {
    data_.physical_names = mesh_.physical_names;
    std::set<EntityKey> present;
    for (const ElementBlock& block : data_.blocks)
      present.insert({dimension(block.shape), block.entity});
    EntityKey last;
    for (const EntityKey& key : data_.point_entity) {
      if (key != last) present.insert(key);
      last = key;
    }
    for (const EntityKey& key : present) {
      EntityRecord record;
      record.key = key;
      EntityKey origin = key;
      if (key.dim == 3) origin.tag = points_.region_of(key.tag);
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
  detail::ExportPoints points_;
  MeshData data_;
};

void refuse_uniform_order(const CurvedMesh& curved, int uniform_order) {
  if (uniform_order == 0) return;
  int highest = 1;
  for (std::uint8_t p : curved.orders().cell) highest = std::max(highest, static_cast<int>(p));
  if (uniform_order < highest || uniform_order > k_max_order) {
    throw OptionError(
        fmt::format("uniform order {} is not possible", uniform_order), "--uniform",
        fmt::format("the mesh holds order {}; choose {}..{}", highest, highest, k_max_order));
  }
}

}  // namespace

MeshData export_mesh(const CurvedMesh& curved, int uniform_order, ExportMap* map) {
  refuse_uniform_order(curved, uniform_order);
  return Exporter(curved, uniform_order).run(map, [] {});
}

MeshData export_mesh(CurvedMesh&& curved, int uniform_order, ExportMap* map) {
  refuse_uniform_order(curved, uniform_order);
  return Exporter(curved, uniform_order).run(map, [&] { curved.release_nodes(); });
}

}  // namespace camber
