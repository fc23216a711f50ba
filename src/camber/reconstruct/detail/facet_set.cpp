#include <camber/base/parallel.hpp>
#include <camber/basis/lattice.hpp>
#include <camber/elevate/blend.hpp>
#include <camber/reconstruct/detail/facet_set.hpp>
#include <camber/reconstruct/detail/fans.hpp>
#include <camber/reconstruct/detail/local_fit.hpp>

#include <algorithm>
#include <cmath>

namespace camber::detail {
namespace {

/// Neighbours that a fit of degree 4 likes to have: one and a half times its 14 coefficients.
constexpr std::size_t k_enough = 21;
constexpr int k_max_rings = 5;
/// A region this flat, in parts of its size, is a plane.
constexpr double k_flat = 1e-9;
/// A node is no farther from the straight facet than this share of the height of its corners over
/// each other's tangent planes: a fit that says more has gone wild.
constexpr double k_wildest = 0.5;
constexpr Index k_row = 4096;

std::vector<Vec3> unit_normals(const FacetMesh& mesh) {
  std::vector<Vec3> normal;
  for (Index f = 0; at(f) < mesh.facets.size(); ++f) {
    const Vec3 area = mesh.area_vector(f);
    normal.push_back(area.norm() > 0.0 ? Vec3(area.normalized()) : Vec3::Zero());
  }
  return normal;
}

/// Normal at a fan's vertex: facets by the angle they have there.
Vec3 fan_normal(const FacetMesh& mesh, const Fans& fans, Index fan, std::span<const Vec3> normal) {
  Vec3 sum = Vec3::Zero();
  const Index v = fans.vertex[at(fan)];
  for (Index f : fans.facets_of(fan)) {
    const std::span<const Index> c = mesh.corners(f);
    const std::size_t i = static_cast<std::size_t>(std::find(c.begin(), c.end(), v) - c.begin());
    const Vec3 a = mesh.points[at(c[(i + 1) % c.size()])] - mesh.points[at(v)];
    const Vec3 b = mesh.points[at(c[(i + c.size() - 1) % c.size()])] - mesh.points[at(v)];
    sum += std::atan2(a.cross(b).norm(), a.dot(b)) * normal[at(f)];
  }
  return sum.norm() > 0.0 ? Vec3(sum.normalized()) : normal[at(fans.facets_of(fan).front())];
}

std::vector<SurfaceFit> fit_fans(const FacetMesh& mesh, const Fans& fans) {
  const std::vector<Vec3> normal = unit_normals(mesh);
  std::vector<SurfaceFit> fits(fans.count());
  parallel_for(fans.count(), 64, [&](std::size_t begin, std::size_t end) {
    Points near;
    for (std::size_t fan = begin; fan < end; ++fan) {
      const Index f = static_cast<Index>(fan);
      const Vec3 axis = fan_normal(mesh, fans, f, normal);
      near.clear();
      const Rings rings = rings_around(mesh, fans, f, normal, axis, k_enough, k_max_rings);
      for (Index v : rings.vertices) near.push_back(mesh.points[at(v)]);
      fits[fan] = fit_surface_at(mesh.points[at(fans.vertex[fan])], axis, near, rings.first);
    }
  });
  return fits;
}

/// Nodes of an edge on its chain, from its first vertex (the smaller number) to its second.
struct EdgeNodes {
  const ChainCurve* curve = nullptr;
  std::size_t segment = 0;
  bool is_reversed = false;

  [[nodiscard]] const Vec3& node(std::size_t k) const {
    return curve->nodes(segment)[is_reversed ? k_patch_order - k : k];
  }
};

std::vector<EdgeNodes> nodes_of_sharp_edges(const Features& features,
                                            const std::vector<ChainCurve>& curves) {
  std::vector<EdgeNodes> nodes(features.edges.size());
  for (std::size_t c = 0; c < curves.size(); ++c) {
    const Chain& chain = features.chains[c];
    for (std::size_t i = 0; i < chain.edges.size(); ++i) {
      const Index e = chain.edges[i];
      nodes[at(e)] = {&curves[c], i, features.edges[at(e)].vertex[0] != chain.vertices[i]};
    }
  }
  return nodes;
}

/// Lattice nodes of one facet.
class PatchNodes {
 public:
  PatchNodes(const FacetMesh& mesh, const Features& features, const Fans& fans,
             const std::vector<SurfaceFit>& fits, const std::vector<EdgeNodes>& sharp)
      : mesh_(mesh), features_(features), fans_(fans), fits_(fits), sharp_(sharp) {}

  [[nodiscard]] Points of(Index f) const {
    const std::span<const Index> corners = mesh_.corners(f);
    const Shape shape = corners.size() == 3 ? Shape::triangle : Shape::quadrilateral;
    const std::span<const Vec3> xi = lattice_xi(shape, k_patch_order);
    double rise = 0.0;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const std::size_t next = (i + 1) % corners.size();
      rise = std::max(rise, rise_between(fans_.corner[at(f)][i], fans_.corner[at(f)][next]));
    }
    Points x(xi.size());
    for (std::size_t n = 0; n < xi.size(); ++n) x[n] = blended(f, shape, xi[n], rise);
    const LatticeMap& map = lattice_map(shape, k_patch_order);
    Points correction(xi.size(), Vec3::Zero());
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Index a = corners[i], b = corners[(i + 1) % corners.size()];
      const EdgeNodes& edge = sharp_[at(features_.facet2edge[at(f)][i])];
      for (std::size_t k = 0; k < map.edge[i].size(); ++k) {
        const std::size_t n = at(map.edge[i][k]);
        const Vec3 wanted =
            edge.curve ? edge.node(a < b ? k : k_patch_order - k) : on_edge(f, i, a, b, k);
        correction[n] = wanted - x[n];
        x[n] = wanted;
      }
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      correction[at(map.edge[i].front())] = Vec3::Zero();
    }
    blend_face_interior(shape, k_patch_order, correction);
    for (int n : interior_nodes(shape, k_patch_order)) x[at(n)] += correction[at(n)];
    return x;
  }

 private:
  /// How high the vertices of two fans are over each other's tangent plane: four times the sagitta
  /// of a circle through them.
  [[nodiscard]] double rise_between(Index a, Index b) const {
    const Vec3 chord = fits_[at(b)].origin - fits_[at(a)].origin;
    return std::max(std::abs(chord.dot(fits_[at(a)].normal)),
                    std::abs(chord.dot(fits_[at(b)].normal)));
  }
  [[nodiscard]] static Vec3 clipped(const Vec3& straight, const Vec3& x, double rise) {
    const double distance = (x - straight).norm(), allowed = k_wildest * rise;
    return distance <= allowed ? x : Vec3(straight + allowed / distance * (x - straight));
  }

  [[nodiscard]] Vec3 blended(Index f, Shape shape, const Vec3& xi, double rise) const {
    const std::span<const Index> corners = mesh_.corners(f);
    std::array<double, 4> weight{};
    corner_weights(shape, xi, weight);
    Vec3 straight = Vec3::Zero(), sum = Vec3::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      straight += weight[i] * mesh_.points[at(corners[i])];
    }
    for (std::size_t i = 0; i < corners.size(); ++i) {
      sum += weight[i] * fits_[at(fans_.corner[at(f)][i])].above(straight);
    }
    return clipped(straight, sum, rise);
  }

  /// The node of an edge that is not sharp, bit for bit the same from both of its facets.
  [[nodiscard]] Vec3 on_edge(Index f, std::size_t i, Index a, Index b, std::size_t k) const {
    const std::size_t next = (i + 1) % mesh_.corner_count(f);
    Index fan_a = fans_.corner[at(f)][i], fan_b = fans_.corner[at(f)][next];
    double s = static_cast<double>(k) / k_patch_order;
    if (b < a) {
      std::swap(a, b);
      std::swap(fan_a, fan_b);
      s = 1.0 - s;
    }
    const Vec3 &xa = mesh_.points[at(a)], &xb = mesh_.points[at(b)];
    if (s == 0.0) return xa;
    if (s == 1.0) return xb;
    const Vec3 straight = (1.0 - s) * xa + s * xb;
    const Vec3 sum =
        (1.0 - s) * fits_[at(fan_a)].above(straight) + s * fits_[at(fan_b)].above(straight);
    return clipped(straight, sum, rise_between(fan_a, fan_b));
  }

  const FacetMesh& mesh_;
  const Features& features_;
  const Fans& fans_;
  const std::vector<SurfaceFit>& fits_;
  const std::vector<EdgeNodes>& sharp_;
};

bool is_flat(const FacetMesh& mesh, std::span<const Index> facets, double size) {
  Vec3 normal = Vec3::Zero();
  for (Index f : facets) normal += mesh.area_vector(f);
  if (!(normal.norm() > 0.0)) return false;
  normal.normalize();
  const Vec3& origin = mesh.points[at(mesh.facets[at(facets.front())][0])];
  for (Index f : facets) {
    for (Index v : mesh.corners(f)) {
      if (std::abs((mesh.points[at(v)] - origin).dot(normal)) > k_flat * size) return false;
    }
  }
  return true;
}

}  // namespace

Vec2 packed(Index facet, const Vec2& uv) {
  return uv + 4.0 * Vec2(static_cast<double>(facet % k_row), static_cast<double>(facet / k_row));
}

std::pair<Index, Vec2> unpacked(const Vec2& uv) {
  const Vec2 cell = ((uv + Vec2::Ones()) / 4.0).array().floor();
  return {static_cast<Index>(cell.x()) + k_row * static_cast<Index>(cell.y()), uv - 4.0 * cell};
}

FacetSet::FacetSet(const FacetMesh& mesh, const Features& features,
                   const std::vector<ChainCurve>& curves)
    : region_of_(features.region) {
  const Fans fans = find_fans(mesh, features);
  const std::vector<SurfaceFit> fits = fit_fans(mesh, fans);
  const std::vector<EdgeNodes> sharp = nodes_of_sharp_edges(features, curves);
  const PatchNodes nodes(mesh, features, fans, fits, sharp);
  std::vector<Points> lattices(mesh.facets.size());
  parallel_for(mesh.facets.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) lattices[f] = nodes.of(static_cast<Index>(f));
  });
  regions_.resize(at(features.region_count));
  std::vector<std::vector<Box>> boxes(regions_.size());
  for (Index f = 0; at(f) < mesh.facets.size(); ++f) {
    const std::size_t n = mesh.corner_count(f);
    patches_.emplace_back(n == 3 ? Shape::triangle : Shape::quadrilateral, lattices[at(f)]);
    unsigned bits = 0;
    for (std::size_t i = 0; i < n; ++i) {
      if (features.edges[at(features.facet2edge[at(f)][i])].is_sharp) bits |= 1U << i;
    }
    sharp_edges_.push_back(bits);
    Region& region = regions_[at(features.region[at(f)])];
    region.facets.push_back(f);
    region.box.add(patches_.back().box());
    boxes[at(features.region[at(f)])].push_back(patches_.back().box());
  }
  for (std::size_t r = 0; r < regions_.size(); ++r) {
    regions_[r].tree = BoxTree(std::move(boxes[r]));
    regions_[r].is_planar = is_flat(mesh, regions_[r].facets, regions_[r].box.diagonal());
  }
  for (std::size_t fan = 0; fan < fits.size(); ++fan) {
    const int region = features.region[at(fans.facets_of(static_cast<Index>(fan)).front())];
    flat_corners_ += fits[fan].degree < 2 && !regions_[at(region)].is_planar;
  }
}

FacetFoot FacetSet::closest(int region, const Vec3& x, const std::optional<Vec2>& seed) const {
  if (seed) {
    const auto [f, uv] = unpacked(*seed);
    if (f >= 0 && at(f) < patches_.size() && region_of_[at(f)] == region) {
      const FacetPatch& patch = patches_[at(f)];
      const SurfaceFoot foot = patch.closest(x, uv.cwiseMax(0.0).cwiseMin(1.0));
      if (foot.is_converged && patch.edges_at(foot.uv, k_on_edge) == 0) return {f, foot};
    }
  }
  FacetFoot best;
  const Region& all = regions_[at(region)];
  all.tree.nearest(
      x, [&] { return best.foot.distance_squared; },
      [&](int item) {
        const Index f = all.facets[at(item)];
        const SurfaceFoot foot = patches_[at(f)].closest(x, std::nullopt);
        if (foot.distance_squared < best.foot.distance_squared) best = {f, foot};
      });
  return best;
}

FacetFoot FacetSet::crossing(int region, const Vec3& x, const Vec3& d, double max_distance,
                             const std::optional<Vec2>& seed) const {
  FacetFoot best;
  double bound = max_distance;
  const auto offer = [&](Index f, const std::optional<Vec2>& start) {
    const std::optional<SurfaceFoot> foot = patches_[at(f)].crossing(x, d, start);
    if (!foot) return;
    const double s = std::abs((foot->point - x).dot(d));
    if (s > bound) return;
    bound = s;
    best = {f, *foot};
  };
  if (seed) {
    const auto [f, uv] = unpacked(*seed);
    if (f >= 0 && at(f) < patches_.size() && region_of_[at(f)] == region) {
      offer(f, uv.cwiseMax(0.0).cwiseMin(1.0));
      if (best.facet != k_none) return best;
    }
  }
  const Region& all = regions_[at(region)];
  all.tree.along_line(
      x, d, [&] { return bound; }, [&](int item) { offer(all.facets[at(item)], std::nullopt); });
  return best;
}

bool FacetSet::is_on_rim(Index facet, const Vec2& uv) const {
  return (patches_[at(facet)].edges_at(uv, k_on_edge) & sharp_edges_[at(facet)]) != 0;
}

}  // namespace camber::detail
