#include <camber/basis/lattice.hpp>
#include <camber/mesh/split_cells.hpp>
#include <camber/validity/element_validity.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

namespace camber {
namespace {

struct Part {
  Shape shape = Shape::tetrahedron;
  std::vector<Index> corners;
  int region = 0;
};

/// Parts of a cell seen from `centre`, corners as shape.hpp wants them: base, then apex.
std::vector<Part> parts_of(Shape shape, std::span<const Index> corners, Index centre, int region) {
  std::vector<Part> parts;
  for (const LocalFace& face : faces(shape)) {
    const bool is_triangle = face.shape == Shape::triangle;
    Part part{is_triangle ? Shape::tetrahedron : Shape::pyramid, {}, region};
    // Backwards: counter-clockwise seen from the centre, as a base is from its apex.
    for (std::size_t i = is_triangle ? 3 : 4; i-- > 0;) {
      part.corners.push_back(corners[static_cast<std::size_t>(face.corners[i])]);
    }
    part.corners.push_back(centre);
    parts.push_back(std::move(part));
  }
  return parts;
}

bool is_positive(const Part& part, const Points& vertices) {
  const std::vector<int>& corner = lattice_map(part.shape, 1).corner;
  Points nodes(part.corners.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[static_cast<std::size_t>(corner[i])] = vertices[at(part.corners[i])];
  }
  return quick_verdict(part.shape, 1, nodes) == Verdict::valid;
}

void append(LinearMesh& mesh, Shape shape, std::span<const Index> corners, int region,
            GlobalId tag) {
  mesh.cell_shape.push_back(shape);
  mesh.cell_vertices.insert(mesh.cell_vertices.end(), corners.begin(), corners.end());
  mesh.cell_offset.push_back(static_cast<Index>(mesh.cell_vertices.size()));
  mesh.cell_region.push_back(region);
  mesh.cell_tags.push_back(tag);
}

/// The mesh without some cells and with others behind the rest.
void replace_cells(LinearMesh& mesh, const std::vector<std::uint8_t>& is_gone,
                   const std::vector<Part>& added) {
  const LinearMesh before = mesh;
  mesh.cell_shape.clear();
  mesh.cell_offset.assign(1, 0);
  mesh.cell_vertices.clear();
  mesh.cell_region.clear();
  mesh.cell_tags.clear();
  GlobalId tag = 0;
  for (Index c = 0; at(c) < before.cell_count(); ++c) {
    tag = std::max(tag, before.cell_tags[at(c)]);
    if (is_gone[at(c)]) continue;
    append(mesh, before.cell_shape[at(c)], before.cell(c), before.cell_region[at(c)],
           before.cell_tags[at(c)]);
  }
  for (const Part& part : added) append(mesh, part.shape, part.corners, part.region, ++tag);
}

/// Shape of a tet, 1 for the regular one; 0 if its volume is not positive.
double tet_shape(const std::array<Vec3, 4>& x) {
  const double volume = (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]) / 6.0;
  if (!(volume > 0.0)) return 0.0;
  double squares = 0.0;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t j = i + 1; j < 4; ++j) squares += (x[i] - x[j]).squaredNorm();
  }
  return 12.0 * std::cbrt(9.0 * volume * volume) / squares;
}

/// A tet below this shape is no gain over what it would replace.
constexpr double k_flat = 0.02;
/// Tets with all corners to be avoided rank below all others that are not flat.
constexpr double k_avoided = 1e-3;
constexpr std::size_t k_longest_ring = 12;

/// The vertices around edge CD, counter-clockwise seen from D; empty if they are no closed ring of
/// tets.
std::vector<Index> ring_of(const LinearMesh& mesh, std::span<const Index> cells, Index c, Index d) {
  std::map<Index, Index> next;
  for (Index cell : cells) {
    if (mesh.cell_shape[at(cell)] != Shape::tetrahedron) return {};
    std::vector<Index> others;
    for (Index v : mesh.cell(cell)) {
      if (v != c && v != d) others.push_back(v);
    }
    const Vec3& o = mesh.vertices[at(c)];
    const double volume = (mesh.vertices[at(d)] - o)
                              .cross(mesh.vertices[at(others[0])] - o)
                              .dot(mesh.vertices[at(others[1])] - o);
    if (volume < 0.0) std::swap(others[0], others[1]);
    next[others[0]] = others[1];
  }
  std::vector<Index> ring{next.begin()->first};
  while (ring.size() <= cells.size()) {
    const auto found = next.find(ring.back());
    if (found == next.end()) return {};
    if (found->second == ring.front()) break;
    ring.push_back(found->second);
  }
  if (ring.size() != cells.size() || ring.size() < 3 || ring.size() > k_longest_ring) return {};
  return ring;
}

/// Best triangulation of a ring by its worst tet: Klincsek's recursion over chains i..j.
class RingFilling {
 public:
  RingFilling(const LinearMesh& mesh, std::vector<Index> ring, Index c, Index d,
              const std::vector<std::uint8_t>& avoided)
      : mesh_(mesh), ring_(std::move(ring)), c_(c), d_(d), avoided_(avoided) {
    const std::size_t n = ring_.size();
    best_.assign(n * n, std::numeric_limits<double>::infinity());
    apex_.assign(n * n, 0);
    for (std::size_t length = 2; length < n; ++length) {
      for (std::size_t i = 0; i + length < n; ++i) {
        const std::size_t j = i + length;
        best_[i * n + j] = -1.0;
        for (std::size_t k = i + 1; k < j; ++k) {
          const double worst = std::min({value(i, k, j), best_[i * n + k], best_[k * n + j]});
          if (worst > best_[i * n + j]) {
            best_[i * n + j] = worst;
            apex_[i * n + j] = k;
          }
        }
      }
    }
  }

  [[nodiscard]] double worst() const { return best_[ring_.size() - 1]; }

  void collect(int region, std::vector<Part>& tets) const {
    collect(0, ring_.size() - 1, region, tets);
  }

 private:
  [[nodiscard]] double value(std::size_t i, std::size_t k, std::size_t j) const {
    return std::min(value_of({ring_[i], ring_[k], ring_[j], d_}),
                    value_of({ring_[j], ring_[k], ring_[i], c_}));
  }
  [[nodiscard]] double value_of(const std::array<Index, 4>& tet) const {
    std::array<Vec3, 4> x;
    bool is_avoided = true;
    for (std::size_t i = 0; i < 4; ++i) {
      x[i] = mesh_.vertices[at(tet[i])];
      is_avoided = is_avoided && avoided_[at(tet[i])];
    }
    const double shape = tet_shape(x);
    if (shape < k_flat) return 0.0;
    return is_avoided ? k_avoided * shape : shape;
  }
  void collect(std::size_t i, std::size_t j, int region, std::vector<Part>& tets) const {
    if (j < i + 2) return;
    const std::size_t k = apex_[i * ring_.size() + j];
    tets.push_back({Shape::tetrahedron, {ring_[i], ring_[k], ring_[j], d_}, region});
    tets.push_back({Shape::tetrahedron, {ring_[j], ring_[k], ring_[i], c_}, region});
    collect(i, k, region, tets);
    collect(k, j, region, tets);
  }

  const LinearMesh& mesh_;
  std::vector<Index> ring_;
  Index c_, d_;
  const std::vector<std::uint8_t>& avoided_;
  std::vector<double> best_;
  std::vector<std::size_t> apex_;
};

/// Shares of the way from the middle of the edge to the middle of its ring at which a new vertex is
/// tried.
constexpr std::array<double, 9> k_star_shares{0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9};

/// Two tets from a new vertex over each edge of the ring, one to each end of the edge CD.
std::vector<Part> star_of(const std::vector<Index>& ring, Index c, Index d, Index centre,
                          int region) {
  std::vector<Part> tets;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Index p = ring[i], q = ring[(i + 1) % ring.size()];
    tets.push_back({Shape::tetrahedron, {p, q, centre, d}, region});
    tets.push_back({Shape::tetrahedron, {q, p, centre, c}, region});
  }
  return tets;
}

/// Puts the last vertex of the mesh where the worst tet of its star is best; returns that shape.
double place_star(LinearMesh& mesh, const std::vector<Part>& star, const Vec3& from,
                  const Vec3& to) {
  Vec3& x = mesh.vertices.back();
  Vec3 best_place = from;
  double best = 0.0;
  for (double share : k_star_shares) {
    x = from + share * (to - from);
    double worst = 1.0;
    for (const Part& tet : star) {
      std::array<Vec3, 4> corners;
      for (std::size_t i = 0; i < 4; ++i) corners[i] = mesh.vertices[at(tet.corners[i])];
      worst = std::min(worst, tet_shape(corners));
    }
    if (worst <= best) continue;
    best = worst;
    best_place = x;
  }
  x = best_place;
  return best;
}

}  // namespace

LinearMesh split_from_centre(const LinearMesh& mesh, const std::vector<Index>& cells,
                             std::vector<Index>* split) {
  LinearMesh result = mesh;
  if (split) split->clear();
  GlobalId vertex_tag = 0;
  for (GlobalId tag : mesh.vertex_tags) vertex_tag = std::max(vertex_tag, tag);

  std::vector<std::uint8_t> is_gone(mesh.cell_count(), 0);
  std::vector<Part> added;
  for (Index c : cells) {
    const std::span<const Index> corners = mesh.cell(c);
    const int region = mesh.cell_region[at(c)];
    Vec3 centre = Vec3::Zero();
    for (Index v : corners) centre += mesh.vertices[at(v)];
    result.vertices.emplace_back(centre / static_cast<double>(corners.size()));
    const std::vector<Part> parts = parts_of(
        mesh.cell_shape[at(c)], corners, static_cast<Index>(result.vertices.size() - 1), region);
    if (!std::all_of(parts.begin(), parts.end(),
                     [&](const Part& part) { return is_positive(part, result.vertices); })) {
      result.vertices.pop_back();
      continue;
    }
    result.vertex_tags.push_back(++vertex_tag);
    result.vertex_entity.push_back(EntityKey{3, region});
    added.insert(added.end(), parts.begin(), parts.end());
    is_gone[at(c)] = 1;
    if (split) split->push_back(c);
  }
  replace_cells(result, is_gone, added);
  return result;
}

namespace {

/// A surface element of the file uses the edge.
bool is_on_patch(const Topology& topology, Index e) {
  for (Index c : topology.cells_of_edge(e)) {
    for (Index f : topology.faces_of_cell(c)) {
      const std::array<Index, 4>& sides = topology.face2edge[at(f)];
      if (topology.face2patch_face[at(f)] != k_none &&
          std::find(sides.begin(), sides.end(), e) != sides.end()) {
        return true;
      }
    }
  }
  return false;
}

}  // namespace

std::pair<LinearMesh, std::size_t> remove_edges(const LinearMesh& mesh, const Topology& topology,
                                                const std::vector<Index>& edges,
                                                const std::vector<std::uint8_t>& avoided) {
  LinearMesh result = mesh;
  GlobalId vertex_tag = 0;
  for (GlobalId tag : mesh.vertex_tags) vertex_tag = std::max(vertex_tag, tag);
  std::vector<std::uint8_t> is_gone(mesh.cell_count(), 0);
  std::vector<Part> added;
  std::size_t removed = 0;
  for (Index e : edges) {
    const std::span<const Index> cells = topology.cells_of_edge(e);
    const int region = mesh.cell_region[at(cells.front())];
    if (std::any_of(cells.begin(), cells.end(),
                    [&](Index c) { return is_gone[at(c)] || mesh.cell_region[at(c)] != region; })) {
      continue;
    }
    if (is_on_patch(topology, e)) continue;
    const auto [c, d] = topology.edge2vertex[at(e)];
    const std::vector<Index> ring = ring_of(mesh, cells, c, d);
    if (ring.empty()) continue;

    const RingFilling filling(mesh, ring, c, d, avoided);
    std::vector<Part> tets;
    if (filling.worst() < k_flat) {  // flat, or with corners to be avoided
      Vec3 middle = Vec3::Zero();
      for (Index v : ring) middle += mesh.vertices[at(v)] / static_cast<double>(ring.size());
      result.vertices.emplace_back(middle);
      tets = star_of(ring, c, d, static_cast<Index>(result.vertices.size() - 1), region);
      const Vec3 edge_middle = 0.5 * (mesh.vertices[at(c)] + mesh.vertices[at(d)]);
      if (place_star(result, tets, edge_middle, middle) >= k_flat) {
        result.vertex_tags.push_back(++vertex_tag);
        result.vertex_entity.push_back(EntityKey{3, region});
      } else {
        result.vertices.pop_back();
        tets.clear();
      }
    }
    if (tets.empty() && filling.worst() > 0.0) filling.collect(region, tets);
    if (tets.empty()) continue;
    added.insert(added.end(), tets.begin(), tets.end());
    for (Index cell : cells) is_gone[at(cell)] = 1;
    ++removed;
  }
  replace_cells(result, is_gone, added);
  return {std::move(result), removed};
}

}  // namespace camber
