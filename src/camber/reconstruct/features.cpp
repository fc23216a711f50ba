#include <camber/reconstruct/features.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>

namespace camber {
namespace {

double cosine_of(double degrees) { return std::cos(degrees * std::numbers::pi / 180.0); }

/// Share of an edge's turn above which the same turn beside it makes both a bend.
constexpr double k_spread = 0.5;
/// Cosine between edges that bend a surface the same way.
constexpr double k_parallel = 0.7;

/// Angle between the normals of an edge's two facets; pi where there are not two.
double turn_of(const FacetMesh& mesh, const FacetEdge& edge) {
  if (edge.facet[1] == k_none) return std::numbers::pi;
  const Vec3 a = mesh.area_vector(edge.facet[0]), b = mesh.area_vector(edge.facet[1]);
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

/// Which edges are sharp.
class Judge {
 public:
  Judge(const FacetMesh& mesh, const FeatureOptions& options, const std::vector<int>& sides,
        Features& features)
      : mesh_(mesh),
        sides_(sides),
        features_(features),
        angle_(options.angle * std::numbers::pi / 180.0),
        certain_(2.0 * angle_) {
    for (const FacetEdge& edge : features.edges) turn_.push_back(turn_of(mesh, edge));
  }

  void mark() {
    for (Index e = 0; at(e) < features_.edges.size(); ++e) {
      FacetEdge& edge = features_.edges[at(e)];
      edge.is_sharp = sides_[at(e)] != 2 || turn_[at(e)] > certain_;
      if (!edge.is_sharp && turn_[at(e)] > angle_) edge.is_sharp = !is_spread(e);
    }
  }

 private:
  [[nodiscard]] Vec3 direction(Index e) const {
    const std::array<Index, 2>& v = features_.edges[at(e)].vertex;
    return (mesh_.points[at(v[1])] - mesh_.points[at(v[0])]).normalized();
  }

  [[nodiscard]] bool touch(Index a, Index b) const {
    const std::array<Index, 2>&v = features_.edges[at(a)].vertex,
                            &w = features_.edges[at(b)].vertex;
    return v[0] == w[0] || v[0] == w[1] || v[1] == w[0] || v[1] == w[1];
  }

  /// On one side at least, a parallel edge turns by half as much, or more, and is not sharp for
  /// certain. Looked for in the next facet, and behind the diagonal of one cut in two.
  [[nodiscard]] bool is_spread(Index e) const {
    const FacetEdge& edge = features_.edges[at(e)];
    return goes_on(edge.facet[0], e, e, 2) || goes_on(edge.facet[1], e, e, 2);
  }

  [[nodiscard]] bool goes_on(Index f, Index from, Index e, int depth) const {
    const std::size_t n = mesh_.corner_count(f);
    for (std::size_t i = 0; i < n; ++i) {
      const Index k = features_.facet2edge[at(f)][i];
      if (k == from || sides_[at(k)] != 2) continue;
      const bool is_as_bent = turn_[at(k)] > k_spread * turn_[at(e)];
      const bool is_parallel =
          !touch(k, e) && std::abs(direction(k).dot(direction(e))) > k_parallel;
      if (is_parallel && is_as_bent && turn_[at(k)] <= certain_) return true;
      if (n == 4 || depth == 1 || is_as_bent) continue;
      const std::array<Index, 2>& sides = features_.edges[at(k)].facet;
      const Index beyond = sides[0] == f ? sides[1] : sides[0];
      if (mesh_.corner_count(beyond) == 3 && goes_on(beyond, k, e, depth - 1)) return true;
    }
    return false;
  }

  const FacetMesh& mesh_;
  const std::vector<int>& sides_;
  Features& features_;
  double angle_, certain_;
  std::vector<double> turn_;
};

void find_edges(const FacetMesh& mesh, const FeatureOptions& options, Features& features) {
  std::map<std::array<Index, 2>, Index> number;
  std::vector<int> sides;
  for (Index f = 0; at(f) < mesh.facets.size(); ++f) {
    const std::span<const Index> v = mesh.corners(f);
    std::array<Index, 4>& own = features.facet2edge.emplace_back();
    own.fill(k_none);
    for (std::size_t i = 0; i < v.size(); ++i) {
      const auto [a, b] = std::minmax(v[i], v[(i + 1) % v.size()]);
      const auto [place, is_new] =
          number.try_emplace({a, b}, static_cast<Index>(features.edges.size()));
      if (is_new) {
        features.edges.push_back({{a, b}});
        sides.push_back(0);
      }
      own[i] = place->second;
      FacetEdge& edge = features.edges[at(place->second)];
      int& count = sides[at(place->second)];
      if (count < 2) edge.facet[static_cast<std::size_t>(count)] = f;
      ++count;
    }
  }
  Judge(mesh, options, sides, features).mark();
}

void find_regions(const FacetMesh& mesh, Features& features) {
  features.region.assign(mesh.facets.size(), -1);
  std::vector<Index> front;
  for (Index first = 0; at(first) < mesh.facets.size(); ++first) {
    if (features.region[at(first)] >= 0) continue;
    features.region[at(first)] = features.region_count;
    front.assign(1, first);
    while (!front.empty()) {
      const Index f = front.back();
      front.pop_back();
      for (std::size_t i = 0; i < mesh.corner_count(f); ++i) {
        const FacetEdge& edge = features.edges[at(features.facet2edge[at(f)][i])];
        if (edge.is_sharp) continue;
        const Index other = edge.facet[0] == f ? edge.facet[1] : edge.facet[0];
        if (features.region[at(other)] >= 0) continue;
        features.region[at(other)] = features.region_count;
        front.push_back(other);
      }
    }
    ++features.region_count;
  }
}

/// Sharp edges at every vertex that has some, and which vertices are corners.
class SharpEdges {
 public:
  SharpEdges(const FacetMesh& mesh, const FeatureOptions& options, Features& features)
      : features_(features), used_(features.edges.size(), 0) {
    for (Index e = 0; at(e) < features.edges.size(); ++e) {
      if (!features.edges[at(e)].is_sharp) continue;
      for (Index v : features.edges[at(e)].vertex) at_vertex_[v].push_back(e);
    }
    const double limit = cosine_of(options.corner_angle);
    for (const auto& [v, edges] : at_vertex_) {
      bool is_corner = edges.size() != 2;
      if (!is_corner) {
        const Vec3 in = mesh.points[at(v)] - mesh.points[at(other_end(edges[0], v))];
        const Vec3 out = mesh.points[at(other_end(edges[1], v))] - mesh.points[at(v)];
        is_corner = in.dot(out) < limit * in.norm() * out.norm();
      }
      if (is_corner) features.corners.push_back(v);
    }
  }

  void collect_chains() {
    for (Index v : features_.corners) {
      for (Index e : at_vertex_.at(v)) {
        if (!used_[at(e)]) features_.chains.push_back(walk(v, e));
      }
    }
    for (const auto& [v, edges] : at_vertex_) {  // what is left runs round without a corner
      if (used_[at(edges.front())]) continue;
      Chain chain = walk(v, edges.front());
      chain.is_closed = true;
      chain.vertices.pop_back();
      features_.chains.push_back(std::move(chain));
    }
  }

 private:
  [[nodiscard]] Index other_end(Index e, Index v) const {
    const std::array<Index, 2>& ends = features_.edges[at(e)].vertex;
    return ends[0] == v ? ends[1] : ends[0];
  }

  Chain walk(Index from, Index along) {
    Chain chain;
    chain.vertices.push_back(from);
    Index v = from, e = along;
    while (true) {
      used_[at(e)] = 1;
      chain.edges.push_back(e);
      v = other_end(e, v);
      chain.vertices.push_back(v);
      const bool is_corner =
          std::binary_search(features_.corners.begin(), features_.corners.end(), v);
      if (is_corner || v == from) return chain;
      const std::vector<Index>& edges = at_vertex_.at(v);
      e = edges[0] == e ? edges[1] : edges[0];
    }
  }

  Features& features_;
  std::map<Index, std::vector<Index>> at_vertex_;
  std::vector<std::uint8_t> used_;
};

}  // namespace

Vec3 FacetMesh::area_vector(Index f) const {
  const std::span<const Index> v = corners(f);
  Vec3 sum = Vec3::Zero();
  const Vec3& origin = points[at(v[0])];
  for (std::size_t i = 1; i + 1 < v.size(); ++i) {
    sum += (points[at(v[i])] - origin).cross(points[at(v[i + 1])] - origin);
  }
  return 0.5 * sum;
}

Features find_features(const FacetMesh& mesh, const FeatureOptions& options) {
  Features features;
  find_edges(mesh, options, features);
  find_regions(mesh, features);
  SharpEdges(mesh, options, features).collect_chains();
  return features;
}

}  // namespace camber
