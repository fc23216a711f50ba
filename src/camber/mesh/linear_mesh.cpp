#include <camber/base/error.hpp>
#include <camber/mesh/linear_mesh.hpp>
#include <camber/mesh/sew.hpp>
#include <camber/validity/batch.hpp>

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace camber {
namespace {

void append_block(const ElementBlock& block, LinearMesh& mesh) {
  const int corner_total = corner_count(block.shape);
  const int stride = block.shape == Shape::point ? 1 : node_count(block.shape, block.order);
  const std::vector<int> corner = block.shape == Shape::point
                                      ? std::vector<int>{0}
                                      : lattice_map(block.shape, block.order).corner;
  const int dim = dimension(block.shape);
  const std::size_t count = block.size();
  for (std::size_t e = 0; e < count; ++e) {
    const Index* nodes = block.nodes.data() + e * static_cast<std::size_t>(stride);
    std::array<Index, 8> v{-1, -1, -1, -1, -1, -1, -1, -1};
    for (int i = 0; i < corner_total; ++i) {
      v[static_cast<std::size_t>(i)] = nodes[corner[static_cast<std::size_t>(i)]];
    }
    if (dim == 3) {
      mesh.cell_shape.push_back(block.shape);
      mesh.cell_vertices.insert(mesh.cell_vertices.end(), v.begin(), v.begin() + corner_total);
      mesh.cell_offset.push_back(static_cast<Index>(mesh.cell_vertices.size()));
      mesh.cell_region.push_back(block.entity);
      mesh.cell_tags.push_back(block.tags.empty() ? static_cast<GlobalId>(mesh.cell_tags.size() + 1)
                                                  : block.tags[e]);
    } else if (dim == 2) {
      mesh.patch_face_shape.push_back(block.shape);
      mesh.patch_face_vertices.push_back({v[0], v[1], v[2], v[3]});
      mesh.patch_face_entity.push_back(block.entity);
    } else if (dim == 1) {
      mesh.lines.push_back({v[0], v[1], block.entity});
    } else if (mesh.vertex_entity[at(v[0])].dim != 0) {
      // A point element says which CAD vertex a mesh vertex is.
      mesh.vertex_entity[at(v[0])] = {0, block.entity};
    }
  }
}

/// Room for all cells and surface elements, so that nothing grows by doubling.
void reserve_elements(const MeshData& data, LinearMesh& mesh) {
  std::size_t cells = 0, corners = 0, faces = 0;
  for (const ElementBlock& block : data.blocks) {
    const int dim = dimension(block.shape);
    if (dim == 2) faces += block.size();
    if (dim != 3) continue;
    cells += block.size();
    corners += block.size() * static_cast<std::size_t>(corner_count(block.shape));
  }
  mesh.cell_shape.reserve(cells);
  mesh.cell_offset.reserve(cells + 1);
  mesh.cell_vertices.reserve(corners);
  mesh.cell_region.reserve(cells);
  mesh.cell_tags.reserve(cells);
  mesh.patch_face_shape.reserve(faces);
  mesh.patch_face_vertices.reserve(faces);
  mesh.patch_face_entity.reserve(faces);
}

void drop_unused_vertices(LinearMesh& mesh) {
  std::vector<Index> new_index(mesh.vertices.size(), k_none);
  for (Index v : mesh.cell_vertices) new_index[at(v)] = 0;
  Index next = 0;
  for (std::size_t v = 0; v < new_index.size(); ++v) {
    if (new_index[v] == k_none) continue;
    const std::size_t to = at(next);
    mesh.vertices[to] = mesh.vertices[v];
    mesh.vertex_tags[to] = mesh.vertex_tags[v];
    mesh.vertex_entity[to] = mesh.vertex_entity[v];
    new_index[v] = next++;
  }
  mesh.vertices.resize(at(next));
  mesh.vertex_tags.resize(at(next));
  mesh.vertex_entity.resize(at(next));
  for (Index& v : mesh.cell_vertices) v = new_index[at(v)];
  // Surface and curve elements that no cell uses (construction entities) are left behind.
  std::size_t kept = 0;
  for (std::size_t f = 0; f < mesh.patch_face_vertices.size(); ++f) {
    std::array<Index, 4> v = mesh.patch_face_vertices[f];
    bool used = true;
    for (Index& i : v) {
      if (i == k_none) continue;
      i = new_index[at(i)];
      used = used && i != k_none;
    }
    if (!used) continue;
    mesh.patch_face_vertices[kept] = v;
    mesh.patch_face_shape[kept] = mesh.patch_face_shape[f];
    mesh.patch_face_entity[kept] = mesh.patch_face_entity[f];
    ++kept;
  }
  mesh.patch_face_vertices.resize(kept);
  mesh.patch_face_shape.resize(kept);
  mesh.patch_face_entity.resize(kept);
  std::vector<LinearMesh::Line> lines;
  for (const LinearMesh::Line& line : mesh.lines) {
    const Index a = new_index[at(line.a)], b = new_index[at(line.b)];
    if (a != k_none && b != k_none) lines.push_back({a, b, line.curve});
  }
  mesh.lines = std::move(lines);
}

void refuse_inverted_cells(const LinearMesh& mesh, const std::string& source) {
  const std::size_t n = mesh.cell_count();
  const std::vector<Verdict> verdicts = quick_verdicts(n, [&](std::size_t c, Points& nodes) {
    const Shape shape = mesh.cell_shape[c];
    const std::vector<int>& corner = lattice_map(shape, 1).corner;
    const std::span<const Index> v = mesh.cell(static_cast<Index>(c));
    nodes.resize(v.size());
    for (std::size_t i = 0; i < v.size(); ++i) {
      nodes[static_cast<std::size_t>(corner[i])] = mesh.vertices[at(v[i])];
    }
    return ElementKind{shape, 1};
  });
  const auto is_bad = [](Verdict verdict) { return verdict != Verdict::valid; };
  const auto bad =
      static_cast<std::size_t>(std::count_if(verdicts.begin(), verdicts.end(), is_bad));
  if (bad == 0) return;
  std::string list;
  int listed = 0;
  for (std::size_t c = 0; c < n && listed < 10; ++c) {
    if (!is_bad(verdicts[c])) continue;
    Vec3 centre = Vec3::Zero();
    for (Index v : mesh.cell(static_cast<Index>(c))) centre += mesh.vertices[at(v)];
    centre /= static_cast<double>(mesh.cell(static_cast<Index>(c)).size());
    list += fmt::format("{}{} {} at ({:.6g}, {:.6g}, {:.6g})", listed ? "; " : "",
                        name(mesh.cell_shape[c]), mesh.cell_tags[c], centre.x(), centre.y(),
                        centre.z());
    ++listed;
  }
  throw MeshError(fmt::format("{} of {} linear cells are inverted or degenerate: {}{}", bad, n,
                              list, bad > 10 ? "; ..." : ""),
                  source,
                  "curving starts from a valid linear mesh: repair these cells in the mesher");
}

}  // namespace

std::string LinearMesh::entity_name(EntityKey key) const {
  for (const EntityRecord& record : entities) {
    if (record.key == key && !record.name.empty()) return record.name;
  }
  constexpr std::array<const char*, 4> kind{"vertex", "curve", "surface", "volume"};
  return fmt::format(
      "{} {}", key.dim >= 0 && key.dim < 4 ? kind[static_cast<std::size_t>(key.dim)] : "entity",
      key.tag);
}

LinearMesh build_linear_mesh(const MeshData& data) {
  LinearMesh mesh;
  mesh.vertices = data.points;
  mesh.vertex_tags = data.point_tags;
  if (mesh.vertex_tags.empty()) {
    mesh.vertex_tags.resize(mesh.vertices.size());
    for (std::size_t i = 0; i < mesh.vertices.size(); ++i) {
      mesh.vertex_tags[i] = static_cast<GlobalId>(i + 1);
    }
  }
  mesh.vertex_entity = data.point_entity;
  mesh.vertex_entity.resize(mesh.vertices.size());
  mesh.entities = data.entities;
  mesh.physical_names = data.physical_names;
  reserve_elements(data, mesh);
  mesh.cell_offset.push_back(0);
  for (const ElementBlock& block : data.blocks) {
    if (block.order > 1 && dimension(block.shape) == 3) {
      throw MeshError(
          fmt::format("the mesh is already curved: it holds {} elements of order {}",
                      name(block.shape), block.order),
          data.source,
          "give the linear mesh, or straighten this one with: camber convert IN OUT --order 1");
    }
    append_block(block, mesh);
  }
  if (mesh.cell_shape.empty()) {
    throw MeshError(
        "the mesh has no volume cells (tet, pyramid, prism, hex)", data.source,
        "export the volume mesh; in Gmsh put it in a physical group or set Mesh.SaveAll=1");
  }
  mesh.sewn_vertices = sew_coincident_vertices(mesh);
  drop_unused_vertices(mesh);
  for (const Vec3& x : mesh.vertices) mesh.box.add(x);
  refuse_inverted_cells(mesh, data.source);
  return mesh;
}

}  // namespace camber
