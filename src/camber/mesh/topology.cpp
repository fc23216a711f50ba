#include <camber/base/error.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/mesh/topology.hpp>

#include <algorithm>

#include <fmt/format.h>

namespace camber {
namespace {

/// One occurrence of an edge or face in a cell, to be sorted by key.
struct Occurrence {
  CornerKey key;
  Index cell;
  Index slot;  // place in cell2edge / cell2face
};

bool precedes(const Occurrence& a, const Occurrence& b) {
  if (a.key != b.key) return a.key < b.key;
  return a.slot < b.slot;
}

/// Corners of a face in its frame, from any cyclic listing.
std::array<Index, 4> frame_of(std::span<const Index> corners) {
  const std::size_t n = corners.size();
  const std::size_t start =
      static_cast<std::size_t>(std::min_element(corners.begin(), corners.end()) - corners.begin());
  const Index next = corners[(start + 1) % n], previous = corners[(start + n - 1) % n];
  std::array<Index, 4> frame{-1, -1, -1, -1};
  for (std::size_t i = 0; i < n; ++i) {
    frame[i] = next < previous ? corners[(start + i) % n] : corners[(start + n - i) % n];
  }
  return frame;
}

std::vector<std::array<int, 4>> make_views(int n) {
  std::vector<std::array<int, 4>> views;
  for (int direction : {1, -1}) {
    for (int start = 0; start < n; ++start) {
      std::array<int, 4> view{-1, -1, -1, -1};
      for (int i = 0; i < n; ++i) {
        view[static_cast<std::size_t>(i)] = ((start + direction * i) % n + n) % n;
      }
      views.push_back(view);
    }
  }
  return views;
}

std::array<Index, 4> corners_of(const LinearMesh& mesh, Index cell, const LocalFace& face) {
  std::array<Index, 4> v{-1, -1, -1, -1};
  for (std::size_t i = 0; i < 4; ++i) {
    if (face.corners[i] >= 0) v[i] = mesh.cell(cell)[static_cast<std::size_t>(face.corners[i])];
  }
  return v;
}

std::span<const Index> used(const std::array<Index, 4>& v, Shape shape) {
  return {v.data(), shape == Shape::triangle ? std::size_t{3} : std::size_t{4}};
}

void build_edges(const LinearMesh& mesh, Topology& topology) {
  std::vector<Occurrence> all;
  topology.cell2edge_offset.push_back(0);
  for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
    for (const std::array<int, 2>& edge : edges(mesh.cell_shape[at(c)])) {
      const std::array<Index, 2> v{mesh.cell(c)[static_cast<std::size_t>(edge[0])],
                                   mesh.cell(c)[static_cast<std::size_t>(edge[1])]};
      topology.cell2edge_reversed.push_back(v[0] > v[1]);
      all.push_back({corner_key(v), c, static_cast<Index>(all.size())});
    }
    topology.cell2edge_offset.push_back(static_cast<Index>(all.size()));
  }
  std::sort(all.begin(), all.end(), precedes);
  topology.cell2edge.resize(all.size());
  topology.edge2cell_offset.push_back(0);
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (i == 0 || all[i].key != all[i - 1].key) {
      if (i > 0) topology.edge2cell_offset.push_back(static_cast<Index>(i));
      topology.edge2vertex.push_back({all[i].key.v[0], all[i].key.v[1]});
    }
    topology.cell2edge[at(all[i].slot)] = static_cast<Index>(topology.edge2vertex.size() - 1);
    topology.edge2cell.push_back(all[i].cell);
  }
  topology.edge2cell_offset.push_back(static_cast<Index>(all.size()));
}

[[noreturn]] void refuse_shared_face(const LinearMesh& mesh, Index a, Index b, Index c) {
  throw MeshError(fmt::format("cells {}, {} and {} share one face", mesh.cell_tags[at(a)],
                              mesh.cell_tags[at(b)], mesh.cell_tags[at(c)]),
                  "mesh topology",
                  "a face may have at most two cells: remove the duplicate or overlapping cell");
}

void build_faces(const LinearMesh& mesh, Topology& topology) {
  std::vector<Occurrence> all;
  topology.cell2face_offset.push_back(0);
  for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
    for (const LocalFace& face : faces(mesh.cell_shape[at(c)])) {
      const std::array<Index, 4> v = corners_of(mesh, c, face);
      all.push_back({corner_key(used(v, face.shape)), c, static_cast<Index>(all.size())});
    }
    topology.cell2face_offset.push_back(static_cast<Index>(all.size()));
  }
  std::sort(all.begin(), all.end(), precedes);
  topology.cell2face.resize(all.size());
  topology.cell2face_view.resize(all.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    const Occurrence& here = all[i];
    const std::size_t local =
        static_cast<std::size_t>(here.slot - topology.cell2face_offset[at(here.cell)]);
    const LocalFace& face = faces(mesh.cell_shape[at(here.cell)])[local];
    const std::array<Index, 4> v = corners_of(mesh, here.cell, face);
    if (i == 0 || here.key != all[i - 1].key) {
      topology.face_shape.push_back(face.shape);
      topology.face2vertex.push_back(frame_of(used(v, face.shape)));
      topology.face2cell.push_back({here.cell, k_none});
    } else {
      std::array<Index, 2>& cells = topology.face2cell.back();
      if (cells[1] != k_none) refuse_shared_face(mesh, cells[0], cells[1], here.cell);
      cells[1] = here.cell;
    }
    topology.cell2face[at(here.slot)] = static_cast<Index>(topology.face_shape.size() - 1);
    const int view = face_view(face.shape, used(v, face.shape), topology.face2vertex.back());
    if (view < 0) {
      throw MeshError(
          fmt::format("cells {} and {} share four vertices but walk the face differently",
                      mesh.cell_tags[at(topology.face2cell.back()[0])],
                      mesh.cell_tags[at(here.cell)]),
          "mesh topology", "the quadrilateral face is twisted: repair these cells");
    }
    topology.cell2face_view[at(here.slot)] = static_cast<std::uint8_t>(view);
  }
  topology.face2edge.resize(topology.face_count());
  for (std::size_t f = 0; f < topology.face_count(); ++f) {
    const std::span<const Index> v = used(topology.face2vertex[f], topology.face_shape[f]);
    topology.face2edge[f] = {-1, -1, -1, -1};
    for (std::size_t i = 0; i < v.size(); ++i) {
      topology.face2edge[f][i] = topology.find_edge(v[i], v[(i + 1) % v.size()]);
    }
  }
}

void link_patch_faces(const LinearMesh& mesh, Topology& topology) {
  std::vector<std::pair<CornerKey, Index>> by_key;
  by_key.reserve(topology.face_count());
  for (std::size_t f = 0; f < topology.face_count(); ++f) {
    by_key.emplace_back(corner_key(used(topology.face2vertex[f], topology.face_shape[f])),
                        static_cast<Index>(f));
  }
  std::sort(by_key.begin(), by_key.end());
  topology.face2patch_face.assign(topology.face_count(), k_none);
  topology.patch_face2face.assign(mesh.patch_face_shape.size(), k_none);
  for (std::size_t b = 0; b < mesh.patch_face_shape.size(); ++b) {
    const CornerKey key = corner_key(used(mesh.patch_face_vertices[b], mesh.patch_face_shape[b]));
    const auto found = std::lower_bound(by_key.begin(), by_key.end(), std::pair{key, Index{-1}});
    if (found == by_key.end() || found->first != key) {
      const Vec3& x = mesh.vertices[at(key.v[0])];
      throw MeshError(
          fmt::format("a {} of {} is not a face of any cell", name(mesh.patch_face_shape[b]),
                      mesh.entity_name({2, mesh.patch_face_entity[b]})),
          fmt::format("near ({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z()),
          "surface and volume mesh do not belong together: export them from one run");
    }
    const std::size_t f = at(found->second);
    const std::span<const Index> walk = used(mesh.patch_face_vertices[b], mesh.patch_face_shape[b]);
    if (face_view(topology.face_shape[f], walk, topology.face2vertex[f]) < 0) {
      const Vec3& x = mesh.vertices[at(key.v[0])];
      throw MeshError(fmt::format("a quad of {} walks its corners differently from its cell",
                                  mesh.entity_name({2, mesh.patch_face_entity[b]})),
                      fmt::format("near ({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z()),
                      "the surface element is twisted: repair it");
    }
    topology.patch_face2face[b] = found->second;
    // A face listed twice (two physical groups) keeps its first entity.
    Index& owner = topology.face2patch_face[at(found->second)];
    if (owner == k_none) owner = static_cast<Index>(b);
  }
}

}  // namespace

Index Topology::find_edge(Index a, Index b) const {
  const std::array<Index, 2> key{std::min(a, b), std::max(a, b)};
  const auto found = std::lower_bound(edge2vertex.begin(), edge2vertex.end(), key);
  if (found == edge2vertex.end() || *found != key) return k_none;
  return static_cast<Index>(found - edge2vertex.begin());
}

Topology build_topology(const LinearMesh& mesh) {
  Topology topology;
  build_edges(mesh, topology);
  build_faces(mesh, topology);
  link_patch_faces(mesh, topology);
  return topology;
}

std::span<const std::array<int, 4>> face_views(Shape shape) {
  static const std::vector<std::array<int, 4>> triangle = make_views(3);
  static const std::vector<std::array<int, 4>> quadrilateral = make_views(4);
  return shape == Shape::triangle ? triangle : quadrilateral;
}

int face_view(Shape shape, std::span<const Index> viewer, const std::array<Index, 4>& frame) {
  const std::span<const std::array<int, 4>> views = face_views(shape);
  for (std::size_t w = 0; w < views.size(); ++w) {
    bool same = true;
    for (std::size_t i = 0; i < viewer.size(); ++i) {
      same = same && viewer[i] == frame[static_cast<std::size_t>(views[w][i])];
    }
    if (same) return static_cast<int>(w);
  }
  return -1;
}

Points straight_face_nodes(const LinearMesh& mesh, const Topology& topology, Index f, int q) {
  std::array<Vec3, 4> corner;
  const std::size_t n = static_cast<std::size_t>(topology.corners_of_face(f));
  for (std::size_t i = 0; i < n; ++i) corner[i] = mesh.vertices[at(topology.face2vertex[at(f)][i])];
  return straight_nodes(topology.face_shape[at(f)], q, std::span(corner.data(), n));
}

std::span<const int> face_view_nodes(Shape shape, int view, int p) {
  using Table = std::vector<std::vector<std::vector<int>>>;  // [p][view]
  static const auto make = [](Shape s) {
    Table table(static_cast<std::size_t>(k_max_tested_order) + 1);
    for (int order = 1; order <= k_max_tested_order; ++order) {
      for (const std::array<int, 4>& v : face_views(s)) {
        const std::size_t n = s == Shape::triangle ? 3 : 4;
        table[static_cast<std::size_t>(order)].push_back(
            reorient(s, order, std::span(v.data(), n)));
      }
    }
    return table;
  };
  static const Table triangle = make(Shape::triangle);
  static const Table quadrilateral = make(Shape::quadrilateral);
  const Table& table = shape == Shape::triangle ? triangle : quadrilateral;
  return table[static_cast<std::size_t>(p)][static_cast<std::size_t>(view)];
}

}  // namespace camber
