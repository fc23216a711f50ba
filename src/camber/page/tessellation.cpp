#include <camber/base/parallel.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/page/cut_table.hpp>
#include <camber/page/tessellation.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <unordered_map>

namespace camber {
namespace {

/// Pieces over which the turn of an edge is added up: more than any order of the pipeline has
/// nodes.
constexpr int k_turn_pieces = 8;

std::size_t at_int(int i) { return static_cast<std::size_t>(i); }

/// An edge of the surface, from its smaller to its larger corner node.
struct SurfaceEdge {
  Points nodes;  // of its polynomial
  int level = 1;
  Points points;  // level + 1
};

/// Edge k of a face: which one it is, and whether the face walks it backwards.
struct EdgeUse {
  std::uint32_t edge = 0;
  bool is_reversed = false, is_first = false;
};

void apply(const MatX& E, const Points& nodes, Points& result) {
  result.assign(static_cast<std::size_t>(E.rows()), Vec3::Zero());
  for (Eigen::Index r = 0; r < E.rows(); ++r) {
    for (Eigen::Index c = 0; c < E.cols(); ++c) {
      result[static_cast<std::size_t>(r)] += E(r, c) * nodes[static_cast<std::size_t>(c)];
    }
  }
}

int order_of_line(const Points& nodes) { return static_cast<int>(nodes.size()) - 1; }

/// Angle by which the edge turns along its way.
double total_turn(const Points& nodes) {
  if (order_of_line(nodes) == 1) return 0.0;
  Points points;
  apply(elevation_matrix(Shape::line, order_of_line(nodes), k_turn_pieces), nodes, points);
  double turn = 0.0;
  for (std::size_t i = 2; i < points.size(); ++i) {
    const Vec3 before = points[i - 1] - points[i - 2], after = points[i] - points[i - 1];
    turn += std::atan2(before.cross(after).norm(), before.dot(after));
  }
  return turn;
}

class Tessellator {
 public:
  Tessellator(const ElementList& cells, const std::vector<BoundaryFace>& faces,
              const TessellationOptions& options)
      : cells_(cells),
        faces_(faces),
        options_(options),
        shape_(faces.size()),
        uses_(faces.size()) {}

  Tessellation run(const std::vector<int>& finer) {
    find_edges(finer);
    choose_levels(finer);
    allocate();
    for (SurfaceEdge& edge : edges_) {
      apply(elevation_matrix(Shape::line, order_of_line(edge.nodes), edge.level), edge.nodes,
            edge.points);
    }
    parallel_for(faces_.size(), 256, [&](std::size_t begin, std::size_t end) {
      Points nodes;
      for (std::size_t f = begin; f < end; ++f) evaluate(f, nodes);
    });
    return std::move(result_);
  }

 private:
  [[nodiscard]] int order(std::size_t f) const { return cells_.order(faces_[f].cell); }

  void find_edges(const std::vector<int>& finer) {
    std::unordered_map<std::uint64_t, std::uint32_t> known;
    Points nodes;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      shape_[f] = gather_face(cells_, faces_[f], nodes);
      const std::array<Index, 4> corner = face_corners(cells_, faces_[f]);
      const LatticeMap& map = lattice_map(shape_[f], order(f));
      for (std::size_t k = 0; k < map.edge.size(); ++k) {
        const Index a = corner[at_int(edges(shape_[f])[k][0])];
        const Index b = corner[at_int(edges(shape_[f])[k][1])];
        const std::uint64_t key = (static_cast<std::uint64_t>(std::min(a, b)) << 32U) |
                                  static_cast<std::uint64_t>(std::max(a, b));
        const auto [place, is_new] =
            known.try_emplace(key, static_cast<std::uint32_t>(edges_.size()));
        if (is_new) {
          SurfaceEdge& edge = edges_.emplace_back();
          for (int n : map.edge[k]) edge.nodes.push_back(nodes[at_int(n)]);
          if (a > b) std::reverse(edge.nodes.begin(), edge.nodes.end());
          edge.level =
              std::max(1, static_cast<int>(std::ceil(total_turn(edge.nodes) / options_.turn)));
        }
        uses_[f][k] = {place->second, a > b, is_new};
        if (!finer.empty()) {
          edges_[place->second].level = std::max(edges_[place->second].level, finer[f]);
        }
      }
    }
  }

  [[nodiscard]] int level_of_face(std::size_t f, int cap, const std::vector<int>& finer) const {
    int level = finer.empty() ? 1 : finer[f];
    for (std::size_t k = 0; k < corner_total(f); ++k) {
      level = std::max(level, edges_[uses_[f][k].edge].level);
    }
    return std::min(level, cap);
  }
  [[nodiscard]] std::size_t corner_total(std::size_t f) const {
    return shape_[f] == Shape::triangle ? 3 : 4;
  }

  void choose_levels(const std::vector<int>& finer) {
    const auto triangles = [&](int cap) {
      std::size_t sum = 0;
      for (std::size_t f = 0; f < faces_.size(); ++f) {
        const std::size_t n = at_int(level_of_face(f, cap, finer));
        sum += n * n * (corner_total(f) - 2);
      }
      return sum;
    };
    int cap = options_.max_level;
    while (cap > 1 && triangles(cap) > options_.max_triangles) --cap;
    result_.is_reduced = cap < options_.max_level;
    result_.level.resize(faces_.size());
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      result_.level[f] = static_cast<std::uint8_t>(level_of_face(f, cap, finer));
    }
    for (SurfaceEdge& edge : edges_) edge.level = std::min(edge.level, cap);
  }

  /// Nodes of the face's lattice -> the node that stands for it, itself mostly.
  [[nodiscard]] std::vector<int> representatives(std::size_t f) const {
    const int n = result_.level[f];
    std::vector<int> stands_for(at_int(node_count(shape_[f], n)));
    for (std::size_t i = 0; i < stands_for.size(); ++i) stands_for[i] = static_cast<int>(i);
    const LatticeMap& map = lattice_map(shape_[f], n);
    for (std::size_t k = 0; k < corner_total(f); ++k) {
      std::map<int, int> first;  // point of the edge -> node
      // Ends last, so that corners stand for themselves.
      first[point_on_edge(f, k, 0)] = map.edge[k].front();
      first[point_on_edge(f, k, n)] = map.edge[k].back();
      for (int i = 0; i <= n; ++i) {
        const int node = map.edge[k][at_int(i)];
        stands_for[at_int(node)] = first.try_emplace(point_on_edge(f, k, i), node).first->second;
      }
    }
    return stands_for;
  }

  /// Which point of edge k lattice place i of the face's side takes.
  [[nodiscard]] int point_on_edge(std::size_t f, std::size_t k, int i) const {
    const EdgeUse& use = uses_[f][k];
    const int n = result_.level[f], m = edges_[use.edge].level;
    const int along = use.is_reversed ? n - i : i;
    return (2 * along * m + n) / (2 * n);  // nearest
  }

  void allocate() {
    const std::size_t count = faces_.size();
    result_.corners.resize(count);
    result_.own_edges.assign(count, 0);
    result_.first_point.assign(count + 1, 0);
    result_.first_triangle.assign(count + 1, 0);
    for (std::size_t f = 0; f < count; ++f) {
      const int n = result_.level[f];
      result_.corners[f] = static_cast<std::uint8_t>(corner_total(f));
      for (std::size_t k = 0; k < corner_total(f); ++k) {
        if (uses_[f][k].is_first) result_.own_edges[f] |= static_cast<std::uint8_t>(1U << k);
      }
      const std::vector<int> stands_for = representatives(f);
      for (const std::array<int, 3>& triangle : lattice_triangles(shape_[f], n)) {
        std::array<std::uint16_t, 3> t{};
        for (std::size_t k = 0; k < 3; ++k) {
          t[k] = static_cast<std::uint16_t>(stands_for[at_int(triangle[k])]);
        }
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
        result_.triangles.push_back(t);
      }
      result_.first_point[f + 1] =
          result_.first_point[f] + static_cast<std::uint32_t>(node_count(shape_[f], n));
      result_.first_triangle[f + 1] = static_cast<std::uint32_t>(result_.triangles.size());
    }
    result_.points.resize(result_.first_point.back());
    result_.normals.resize(result_.first_point.back());
  }

  void evaluate(std::size_t f, Points& nodes) {
    gather_face(cells_, faces_[f], nodes);
    const int p = order(f), n = result_.level[f];
    const std::size_t first = result_.first_point[f];
    Points points;
    apply(elevation_matrix(shape_[f], p, n), nodes, points);
    const LatticeMap& map = lattice_map(shape_[f], n);
    for (std::size_t k = 0; k < corner_total(f); ++k) {
      for (int i = 0; i <= n; ++i) {
        points[at_int(map.edge[k][at_int(i)])] =
            edges_[uses_[f][k].edge].points[at_int(point_on_edge(f, k, i))];
      }
    }
    std::copy(points.begin(), points.end(),
              result_.points.begin() + static_cast<std::ptrdiff_t>(first));
    set_normals(f, nodes, p, n);
  }

  void set_normals(std::size_t f, const Points& nodes, int p, int n) {
    const std::span<const Vec3> xi = lattice_xi(shape_[f], n);
    std::vector<Vec3> dN(nodes.size());
    Vec3 mean = Vec3::Zero();
    for (std::size_t i = 0; i < xi.size(); ++i) {
      lagrange_gradients(shape_[f], p, xi[i], dN);
      Vec3 du = Vec3::Zero(), dv = Vec3::Zero();
      for (std::size_t k = 0; k < nodes.size(); ++k) {
        du += dN[k].x() * nodes[k];
        dv += dN[k].y() * nodes[k];
      }
      const Vec3 normal = du.cross(dv);
      mean += normal;
      result_.normals[result_.first_point[f] + i] = normal;
    }
    for (std::size_t i = 0; i < xi.size(); ++i) {
      Vec3& normal = result_.normals[result_.first_point[f] + i];
      // A corner where the face has no tangent plane takes the face's mean.
      if (!(normal.norm() > 1e-6 * mean.norm() / static_cast<double>(xi.size()))) normal = mean;
      const double length = normal.norm();
      normal = length > 0.0 ? Vec3(normal / length) : Vec3::UnitZ();
    }
  }

  const ElementList& cells_;
  const std::vector<BoundaryFace>& faces_;
  const TessellationOptions& options_;
  std::vector<Shape> shape_;
  std::vector<std::array<EdgeUse, 4>> uses_;
  std::vector<SurfaceEdge> edges_;
  Tessellation result_;
};

}  // namespace

Tessellation tessellate(const ElementList& cells, const std::vector<BoundaryFace>& faces,
                        const std::vector<int>& finer, const TessellationOptions& options) {
  return Tessellator(cells, faces, options).run(finer);
}

}  // namespace camber
