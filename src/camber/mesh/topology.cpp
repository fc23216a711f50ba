#include <camber/base/error.hpp>
#include <camber/base/parallel.hpp>
#include <camber/base/sorted_set.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/mesh/topology.hpp>

#include <algorithm>
#include <atomic>
#include <memory>

#include <fmt/format.h>

namespace camber {
namespace {

/// One use of an edge or face by a cell; `rest` are the corners above the smallest one, sorted.
template <std::size_t N>
struct Use {
  std::array<Index, N> rest;
  Index cell, slot;  // place in cell2edge / cell2face
};

/// Below 0, 0 or above 0 as a is before, equal to or after b. A loop: comparing arrays calls
/// memcmp, which costs more than these few numbers.
template <std::size_t N>
int compared(const std::array<Index, N>& a, const std::array<Index, N>& b) {
  for (std::size_t i = 0; i < N; ++i) {
    if (a[i] != b[i]) return a[i] < b[i] ? -1 : 1;
  }
  return 0;
}

/// Uses by smallest vertex, each bucket sorted by the other corners and then by slot: the order of
/// sorted corner keys, without sorting all at once. Edges or faces are numbered in that order.
template <std::size_t N>
class Buckets {
 public:
  /// @param each_use  calls its last argument with key, cell and slot of every use by the cells of
  ///                  a range; runs twice, for several ranges at once
  template <class EachUse>
  Buckets(std::size_t vertices, std::size_t cells, const EachUse& each_use)
      : first_(vertices + 1, 0), before_((vertices + k_chunk - 1) / k_chunk + 1, 0) {
    const auto all_uses = [&](const auto& take) {
      parallel_for(cells, k_chunk, [&](std::size_t begin, std::size_t end) {
        each_use(static_cast<Index>(begin), static_cast<Index>(end), take);
      });
    };
    // Counts do not depend on the order of adding, and buckets are sorted after.
    const auto add_one = [](Index& count) {
      return std::atomic_ref<Index>(count).fetch_add(1, std::memory_order_relaxed);
    };
    all_uses([&](const CornerKey& key, Index, Index) { add_one(first_[at(key.v[0]) + 1]); });
    for (std::size_t v = 0; v < vertices; ++v) first_[v + 1] += first_[v];
    size_ = at(first_.back());
    uses_ = std::make_unique_for_overwrite<Use<N>[]>(size_);
    {
      std::vector<Index> next(first_.begin(), first_.end() - 1);
      all_uses([&](const CornerKey& key, Index cell, Index slot) {
        Use<N>& use = uses_[at(add_one(next[at(key.v[0])]))];
        std::copy_n(key.v.begin() + 1, N, use.rest.begin());
        use.cell = cell;
        use.slot = slot;
      });
    }
    parallel_for(vertices, k_chunk, [&](std::size_t begin, std::size_t end) {
      Index found = 0;
      for (std::size_t v = begin; v < end; ++v) {
        std::sort(uses_.get() + first_[v], uses_.get() + first_[v + 1],
                  [](const Use<N>& a, const Use<N>& b) {
                    const int order = compared(a.rest, b.rest);
                    return order != 0 ? order < 0 : a.slot < b.slot;
                  });
        for (Index i = first_[v]; i < first_[v + 1]; ++i) found += is_new(v, i);
      }
      before_[begin / k_chunk + 1] = found;
    });
    for (std::size_t chunk = 1; chunk < before_.size(); ++chunk) {
      before_[chunk] += before_[chunk - 1];
    }
  }

  /// Calls visit(number, place, smallest vertex, use, is_new) for every use, in order within an
  /// edge or face; is_new for the first use of each, place among all uses. Runs parallel.
  template <class Visit>
  void visit_all(const Visit& visit) const {
    parallel_for(first_.size() - 1, k_chunk, [&](std::size_t begin, std::size_t end) {
      Index number = before_[begin / k_chunk] - 1;
      for (std::size_t v = begin; v < end; ++v) {
        for (Index i = first_[v]; i < first_[v + 1]; ++i) {
          const bool starts = is_new(v, i);
          number += starts;
          visit(number, i, static_cast<Index>(v), uses_[at(i)], starts);
        }
      }
    });
  }
  /// Uses, and edges or faces.
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] std::size_t count() const { return at(before_.back()); }

 private:
  static constexpr std::size_t k_chunk = 4096;

  [[nodiscard]] bool is_new(std::size_t v, Index i) const {
    return i == first_[v] || compared(uses_[at(i)].rest, uses_[at(i) - 1].rest) != 0;
  }

  std::vector<Index> first_;   // by vertex
  std::vector<Index> before_;  // by chunk of vertices: edges or faces before it
  std::size_t size_ = 0;
  std::unique_ptr<Use<N>[]> uses_;
};

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

/// By cell: number of its edges or faces, summed.
template <class Count>
std::vector<Index> offsets(const LinearMesh& mesh, const Count& count) {
  std::vector<Index> offset(mesh.cell_count() + 1, 0);
  for (std::size_t c = 0; c < mesh.cell_count(); ++c) {
    offset[c + 1] = offset[c] + static_cast<Index>(count(mesh.cell_shape[c]));
  }
  return offset;
}

void build_edges(const LinearMesh& mesh, Topology& topology) {
  topology.cell2edge_offset = offsets(mesh, [](Shape shape) { return edges(shape).size(); });
  topology.cell2edge_reversed.resize(at(topology.cell2edge_offset.back()));
  const Buckets<1> buckets(
      mesh.vertices.size(), mesh.cell_count(), [&](Index begin, Index end, const auto& use) {
        Index slot = topology.cell2edge_offset[at(begin)];
        for (Index c = begin; c < end; ++c) {
          for (const std::array<int, 2>& edge : edges(mesh.cell_shape[at(c)])) {
            const Index a = mesh.cell(c)[static_cast<std::size_t>(edge[0])],
                        b = mesh.cell(c)[static_cast<std::size_t>(edge[1])];
            topology.cell2edge_reversed[at(slot)] = a > b;
            use(CornerKey{{std::min(a, b), std::max(a, b), -1, -1}}, c, slot++);
          }
        }
      });
  topology.cell2edge.resize(buckets.size());
  topology.edge2cell.resize(buckets.size());
  topology.edge2vertex.resize(buckets.count());
  topology.edge2cell_offset.assign(buckets.count() + 1, static_cast<Index>(buckets.size()));
  buckets.visit_all([&](Index e, Index place, Index low, const Use<1>& use, bool is_new) {
    if (is_new) {
      topology.edge2cell_offset[at(e)] = place;
      topology.edge2vertex[at(e)] = {low, use.rest[0]};
    }
    topology.cell2edge[at(use.slot)] = e;
    topology.edge2cell[at(place)] = use.cell;
  });
}

[[noreturn]] void refuse_shared_face(const LinearMesh& mesh, Index a, Index b, Index c) {
  throw MeshError(fmt::format("cells {}, {} and {} share one face", mesh.cell_tags[at(a)],
                              mesh.cell_tags[at(b)], mesh.cell_tags[at(c)]),
                  "mesh topology",
                  "a face may have at most two cells: remove the duplicate or overlapping cell");
}

/// Edges of every face, found among those of its first cell.
void link_face_edges(Topology& topology) {
  topology.face2edge.resize(topology.face_count());
  parallel_for(topology.face_count(), 4096, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const std::span<const Index> v = used(topology.face2vertex[f], topology.face_shape[f]);
      topology.face2edge[f] = {-1, -1, -1, -1};
      for (std::size_t i = 0; i < v.size(); ++i) {
        const auto [a, b] = std::minmax(v[i], v[(i + 1) % v.size()]);
        for (Index e : topology.edges_of_cell(topology.face2cell[f][0])) {
          const std::array<Index, 2>& ends = topology.edge2vertex[at(e)];
          if (ends[0] == a && ends[1] == b) topology.face2edge[f][i] = e;
        }
      }
    }
  });
}

void build_faces(const LinearMesh& mesh, Topology& topology) {
  topology.cell2face_offset = offsets(mesh, [](Shape shape) { return faces(shape).size(); });
  const Buckets<3> buckets(mesh.vertices.size(), mesh.cell_count(),
                           [&](Index begin, Index end, const auto& use) {
                             Index slot = topology.cell2face_offset[at(begin)];
                             for (Index c = begin; c < end; ++c) {
                               for (const LocalFace& face : faces(mesh.cell_shape[at(c)])) {
                                 const std::array<Index, 4> v = corners_of(mesh, c, face);
                                 use(corner_key(used(v, face.shape)), c, slot++);
                               }
                             }
                           });
  topology.cell2face.resize(buckets.size());
  topology.cell2face_view.resize(buckets.size());
  topology.face_shape.resize(buckets.count());
  topology.face2vertex.resize(buckets.count());
  topology.face2cell.resize(buckets.count());
  buckets.visit_all([&](Index f, Index, Index, const Use<3>& here, bool is_new) {
    const std::size_t local =
        static_cast<std::size_t>(here.slot - topology.cell2face_offset[at(here.cell)]);
    const LocalFace& face = faces(mesh.cell_shape[at(here.cell)])[local];
    const std::array<Index, 4> v = corners_of(mesh, here.cell, face);
    std::array<Index, 2>& cells = topology.face2cell[at(f)];
    if (is_new) {
      topology.face_shape[at(f)] = face.shape;
      topology.face2vertex[at(f)] = frame_of(used(v, face.shape));
      cells = {here.cell, k_none};
    } else {
      if (cells[1] != k_none) refuse_shared_face(mesh, cells[0], cells[1], here.cell);
      cells[1] = here.cell;
    }
    topology.cell2face[at(here.slot)] = f;
    const int view = face_view(face.shape, used(v, face.shape), topology.face2vertex[at(f)]);
    if (view < 0) {
      throw MeshError(
          fmt::format("cells {} and {} share four vertices but walk the face differently",
                      mesh.cell_tags[at(cells[0])], mesh.cell_tags[at(here.cell)]),
          "mesh topology", "the quadrilateral face is twisted: repair these cells");
    }
    topology.cell2face_view[at(here.slot)] = static_cast<std::uint8_t>(view);
  });
}

/// The face with these corners; -1 if there is none. Faces are numbered in the order of their keys.
Index find_face(const Topology& topology, const CornerKey& key) {
  Index low = 0, high = static_cast<Index>(topology.face_count());
  const auto key_of = [&](Index f) {
    return corner_key(used(topology.face2vertex[at(f)], topology.face_shape[at(f)]));
  };
  while (low < high) {
    const Index middle = low + (high - low) / 2;
    key_of(middle) < key ? low = middle + 1 : high = middle;
  }
  return at(low) < topology.face_count() && key_of(low) == key ? low : k_none;
}

void link_patch_faces(const LinearMesh& mesh, Topology& topology) {
  topology.face2patch_face.assign(topology.face_count(), k_none);
  topology.patch_face2face.assign(mesh.patch_face_shape.size(), k_none);
  for (std::size_t b = 0; b < mesh.patch_face_shape.size(); ++b) {
    const CornerKey key = corner_key(used(mesh.patch_face_vertices[b], mesh.patch_face_shape[b]));
    const Index found = find_face(topology, key);
    if (found == k_none) {
      const Vec3& x = mesh.vertices[at(key.v[0])];
      throw MeshError(
          fmt::format("a {} of {} is not a face of any cell", name(mesh.patch_face_shape[b]),
                      mesh.entity_name({2, mesh.patch_face_entity[b]})),
          fmt::format("near ({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z()),
          "surface and volume mesh do not belong together: export them from one run");
    }
    const std::size_t f = at(found);
    const std::span<const Index> walk = used(mesh.patch_face_vertices[b], mesh.patch_face_shape[b]);
    if (face_view(topology.face_shape[f], walk, topology.face2vertex[f]) < 0) {
      const Vec3& x = mesh.vertices[at(key.v[0])];
      throw MeshError(fmt::format("a quad of {} walks its corners differently from its cell",
                                  mesh.entity_name({2, mesh.patch_face_entity[b]})),
                      fmt::format("near ({:.6g}, {:.6g}, {:.6g})", x.x(), x.y(), x.z()),
                      "the surface element is twisted: repair it");
    }
    topology.patch_face2face[b] = found;
    // A face listed twice (two physical groups) keeps its first entity.
    Index& owner = topology.face2patch_face[f];
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
  link_face_edges(topology);
  link_patch_faces(mesh, topology);
  return topology;
}

std::vector<Index> with_neighbours(const Topology& topology, const std::vector<Index>& cells) {
  std::vector<Index> grown = cells;
  for (Index c : cells) {
    for (Index e : topology.edges_of_cell(c)) {
      for (Index other : topology.cells_of_edge(e)) grown.push_back(other);
    }
  }
  make_sorted_set(grown);
  return grown;
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

using ViewTable = std::vector<std::vector<std::vector<int>>>;  // [p][view]

std::span<const int> face_view_interior(Shape shape, int view, int p) {
  static const auto make = [](Shape s) {
    ViewTable table(static_cast<std::size_t>(k_max_tested_order) + 1);
    for (int order = 1; order <= k_max_tested_order; ++order) {
      const std::span<const int> inner = interior_nodes(s, order);
      for (int w = 0; static_cast<std::size_t>(w) < face_views(s).size(); ++w) {
        const std::span<const int> frame_node = face_view_nodes(s, w, order);
        std::vector<int>& places = table[static_cast<std::size_t>(order)].emplace_back();
        for (int n : inner) {
          const int stored = frame_node[static_cast<std::size_t>(n)];
          places.push_back(static_cast<int>(std::lower_bound(inner.begin(), inner.end(), stored) -
                                            inner.begin()));
        }
      }
    }
    return table;
  };
  static const ViewTable triangle = make(Shape::triangle);
  static const ViewTable quadrilateral = make(Shape::quadrilateral);
  const ViewTable& table = shape == Shape::triangle ? triangle : quadrilateral;
  return table[static_cast<std::size_t>(p)][static_cast<std::size_t>(view)];
}

std::span<const int> face_view_nodes(Shape shape, int view, int p) {
  static const auto make = [](Shape s) {
    ViewTable table(static_cast<std::size_t>(k_max_tested_order) + 1);
    for (int order = 1; order <= k_max_tested_order; ++order) {
      for (const std::array<int, 4>& v : face_views(s)) {
        const std::size_t n = s == Shape::triangle ? 3 : 4;
        table[static_cast<std::size_t>(order)].push_back(
            reorient(s, order, std::span(v.data(), n)));
      }
    }
    return table;
  };
  static const ViewTable triangle = make(Shape::triangle);
  static const ViewTable quadrilateral = make(Shape::quadrilateral);
  const ViewTable& table = shape == Shape::triangle ? triangle : quadrilateral;
  return table[static_cast<std::size_t>(p)][static_cast<std::size_t>(view)];
}

}  // namespace camber
