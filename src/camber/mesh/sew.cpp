#include <camber/base/by_key.hpp>
#include <camber/mesh/sew.hpp>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <numeric>
#include <tuple>
#include <vector>

namespace camber {
namespace {

std::tuple<double, double, double> coordinates(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

/// True if two vertices are at one place. One pass with a hash: sorting them all costs more than
/// the rest of reading, and hardly any mesh has such vertices.
bool has_twins(const Points& vertices) {
  std::size_t places = 16;
  while (places < 2 * vertices.size()) places *= 2;
  std::vector<Index> table(places, k_none);
  for (Index v = 0; at(v) < vertices.size(); ++v) {
    const Vec3& x = vertices[at(v)];
    std::uint64_t hash = 0;
    for (double c : x) {
      // Adding zero makes one zero of both.
      hash = (hash ^ std::bit_cast<std::uint64_t>(c + 0.0)) * 0x9e3779b97f4a7c15ULL;
      hash ^= hash >> 29;
    }
    std::size_t place = hash & (places - 1);
    for (; table[place] != k_none; place = (place + 1) & (places - 1)) {
      if (vertices[at(table[place])] == x) return true;
    }
    table[place] = v;
  }
  return false;
}

/// Groups of two or more vertices at one place, each sorted by index.
std::vector<std::vector<Index>> coincident_groups(const Points& vertices) {
  std::vector<Index> order(vertices.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](Index a, Index b) {
    const auto xa = coordinates(vertices[at(a)]), xb = coordinates(vertices[at(b)]);
    return xa != xb ? xa < xb : a < b;
  });
  std::vector<std::vector<Index>> groups;
  for (std::size_t i = 0; i < order.size();) {
    std::size_t j = i + 1;
    while (j < order.size() && vertices[at(order[j])] == vertices[at(order[i])]) ++j;
    if (j - i > 1) {
      groups.emplace_back(order.begin() + static_cast<std::ptrdiff_t>(i),
                          order.begin() + static_cast<std::ptrdiff_t>(j));
    }
    i = j;
  }
  return groups;
}

std::vector<CornerKey> face_keys_of_cells(const LinearMesh& mesh) {
  std::vector<CornerKey> keys;
  for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
    for (const LocalFace& face : faces(mesh.cell_shape[at(c)])) {
      std::vector<Index> v;
      for (int corner : face.corners) {
        if (corner >= 0) v.push_back(mesh.cell(c)[static_cast<std::size_t>(corner)]);
      }
      keys.push_back(corner_key(v));
    }
  }
  std::sort(keys.begin(), keys.end());
  return keys;
}

/// Vertices of boundary faces that no surface element lists.
std::vector<std::uint8_t> vertices_of_loose_faces(const LinearMesh& mesh) {
  std::vector<CornerKey> listed;
  for (std::size_t b = 0; b < mesh.patch_face_shape.size(); ++b) {
    const std::size_t n = mesh.patch_face_shape[b] == Shape::triangle ? 3 : 4;
    listed.push_back(corner_key(
        std::vector<Index>(mesh.patch_face_vertices[b].begin(),
                           mesh.patch_face_vertices[b].begin() + static_cast<std::ptrdiff_t>(n))));
  }
  std::sort(listed.begin(), listed.end());
  const std::vector<CornerKey> keys = face_keys_of_cells(mesh);
  std::vector<std::uint8_t> is_loose(mesh.vertices.size(), 0);
  for (std::size_t i = 0; i < keys.size();) {
    std::size_t j = i + 1;
    while (j < keys.size() && keys[j] == keys[i]) ++j;
    if (j - i == 1 && !std::binary_search(listed.begin(), listed.end(), keys[i])) {
      for (Index v : keys[i].v) {
        if (v >= 0) is_loose[at(v)] = 1;
      }
    }
    i = j;
  }
  return is_loose;
}

}  // namespace

std::size_t sew_coincident_vertices(LinearMesh& mesh) {
  if (!has_twins(mesh.vertices)) return 0;
  const std::vector<std::vector<Index>> groups = coincident_groups(mesh.vertices);
  if (groups.empty()) return 0;
  const std::vector<std::uint8_t> is_loose = vertices_of_loose_faces(mesh);
  std::vector<Index> merged(mesh.vertices.size());
  std::iota(merged.begin(), merged.end(), 0);
  std::size_t removed = 0;
  for (const std::vector<Index>& group : groups) {
    Index kept = k_none;
    for (Index v : group) {
      if (!is_loose[at(v)]) continue;
      if (kept == k_none) {
        kept = v;
        continue;
      }
      merged[at(v)] = kept;
      ++removed;
      // The better classified of the two names the vertex.
      EntityKey &a = mesh.vertex_entity[at(kept)], &b = mesh.vertex_entity[at(v)];
      if (b.dim >= 0 && (a.dim < 0 || b.dim < a.dim)) a = b;
    }
  }
  if (removed == 0) return 0;
  for (Index& v : mesh.cell_vertices) v = merged[at(v)];
  for (std::array<Index, 4>& face : mesh.patch_face_vertices) {
    for (Index& v : face) {
      if (v >= 0) v = merged[at(v)];
    }
  }
  for (LinearMesh::Line& line : mesh.lines) {
    line.a = merged[at(line.a)];
    line.b = merged[at(line.b)];
  }
  return removed;
}

}  // namespace camber
