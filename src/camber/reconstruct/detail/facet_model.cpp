#include <camber/base/error.hpp>
#include <camber/reconstruct/detail/facet_model.hpp>
#include <camber/reconstruct/detail/facet_projector.hpp>

#include <algorithm>
#include <cmath>

namespace camber::detail {
namespace {

/// A chain this near its chord, in parts of the chord, is straight.
constexpr double k_straight = 1e-9;

std::vector<ChainCurve> curves_of(const FacetMesh& mesh, const Features& features) {
  std::vector<ChainCurve> curves;
  for (const Chain& chain : features.chains) curves.emplace_back(mesh, chain);
  return curves;
}

bool is_chain_straight(const FacetMesh& mesh, const Chain& chain) {
  if (chain.is_closed) return false;
  const Vec3& a = mesh.points[at(chain.vertices.front())];
  const Vec3 chord = mesh.points[at(chain.vertices.back())] - a;
  const double length = chord.norm();
  if (!(length > 0.0)) return false;
  return std::all_of(chain.vertices.begin(), chain.vertices.end(), [&](Index v) {
    return (mesh.points[at(v)] - a).cross(chord).norm() <= k_straight * length * length;
  });
}

}  // namespace

FacetBody::FacetBody(const FacetMesh& mesh, Features found)
    : features(std::move(found)),
      curves(curves_of(mesh, features)),
      facets(mesh, features, curves),
      corner_of(mesh.facets) {
  for (const ChainCurve& curve : curves) trees.emplace_back(curve);
  for (const Chain& chain : features.chains) {
    is_straight.push_back(is_chain_straight(mesh, chain));
  }
  for (Index v : features.corners) corners.push_back(mesh.points[at(v)]);
}

void check_entity(const FacetBody& body, GeomEntity entity) {
  const std::size_t count = entity.dim == 2   ? at(body.features.region_count)
                            : entity.dim == 1 ? body.curves.size()
                            : entity.dim == 0 ? body.corners.size()
                                              : 0;
  if (entity.tag >= 1 && static_cast<std::size_t>(entity.tag) <= count) return;
  throw GeometryError(
      "the reconstructed geometry has no such entity",
      "entity " + std::to_string(entity.tag) + " of dimension " + std::to_string(entity.dim),
      "it has " + std::to_string(count) + " of that dimension");
}

void FacetModel::check(GeomEntity entity) const { check_entity(*body_, entity); }

std::size_t FacetModel::place(int dim, int tag) const {
  check({dim, tag});
  return at(tag - 1);
}

int FacetModel::count(int dim) const {
  if (dim == 2) return body_->features.region_count;
  if (dim == 1) return static_cast<int>(body_->curves.size());
  return dim == 0 ? static_cast<int>(body_->corners.size()) : 0;
}

Box FacetModel::box() const {
  Box all;
  for (int r = 0; r < body_->features.region_count; ++r) all.add(box({2, r + 1}));
  return all;
}

Box FacetModel::box(GeomEntity entity) const {
  check(entity);
  Box inner;
  if (entity.dim == 2) {
    inner = body_->facets.box(entity.tag - 1);
  } else if (entity.dim == 1) {
    inner = body_->trees[at(entity.tag - 1)].box();
  } else {
    inner.add(body_->corners[at(entity.tag - 1)]);
  }
  Box box;
  box.add(Vec3(scale_ * inner.lower));
  box.add(Vec3(scale_ * inner.upper));
  return box;
}

bool FacetModel::is_seam(int curve, int face) const {
  const Chain& chain = body_->features.chains[place(1, curve)];
  const std::array<Index, 2>& sides = body_->features.edges[at(chain.edges.front())].facet;
  return std::all_of(sides.begin(), sides.end(), [&](Index f) {
    return f != k_none && body_->features.region[at(f)] == face - 1;
  });
}

bool FacetModel::is_planar(int face) const {
  check({2, face});
  return body_->facets.is_planar(face - 1);
}

bool FacetModel::is_straight(int curve) const { return body_->is_straight[place(1, curve)] != 0; }

std::vector<int> FacetModel::faces_of_curve(int curve) const {
  // A chain may pass from one pair of regions to another where a third edge ends in a corner only;
  // its edges tell.
  std::vector<int> faces;
  for (Index e : body_->features.chains[place(1, curve)].edges) {
    for (Index f : body_->features.edges[at(e)].facet) {
      if (f != k_none) faces.push_back(body_->features.region[at(f)] + 1);
    }
  }
  std::sort(faces.begin(), faces.end());
  faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
  return faces;
}

std::vector<int> FacetModel::curves_of_face(int face) const {
  check({2, face});
  std::vector<int> curves;
  for (int c = 1; c <= count(1); ++c) {
    const std::vector<int> faces = faces_of_curve(c);
    if (std::binary_search(faces.begin(), faces.end(), face)) curves.push_back(c);
  }
  return curves;
}

std::vector<int> FacetModel::vertices_of_curve(int curve) const {
  const Chain& chain = body_->features.chains[place(1, curve)];
  if (chain.is_closed) return {};
  const std::vector<Index>& corners = body_->features.corners;
  std::vector<int> tags;
  for (Index v : {chain.vertices.front(), chain.vertices.back()}) {
    const auto found = std::lower_bound(corners.begin(), corners.end(), v);
    const int tag = static_cast<int>(found - corners.begin()) + 1;
    if (tags.empty() || tags.front() != tag) tags.push_back(tag);
  }
  return tags;
}

GeometryModel::CurveRange FacetModel::range(int curve) const {
  const ChainCurve& chain = body_->curves[place(1, curve)];
  return {0.0, chain.last(), chain.period()};
}

Vec2 FacetModel::curve_on_face(int curve, int face, double t,
                               const std::optional<Vec2>& near) const {
  const std::size_t c = place(1, curve);
  check({2, face});
  const ChainCurve& chain = body_->curves[c];
  t = wrap_period(t, 0.0, chain.period());
  const std::size_t segment =
      static_cast<std::size_t>(std::clamp(std::floor(t), 0.0, chain.last() - 1.0));
  const double s = t - static_cast<double>(segment);
  const Chain& edges = body_->features.chains[c];
  const Index e = edges.edges[segment];
  const FacetEdge& edge = body_->features.edges[at(e)];
  const bool is_reversed = edge.vertex[0] != edges.vertices[segment];
  const double along = is_reversed ? 1.0 - s : s;  // from the smaller vertex number
  std::optional<Vec2> best;
  for (Index f : edge.facet) {
    if (f == k_none || body_->features.region[at(f)] != face - 1) continue;
    const Vec2 uv = packed(f, edge_parameters(f, e, along));
    if (!best || (near && (uv - *near).norm() < (*best - *near).norm())) best = uv;
  }
  if (best) return *best;
  const Vec3 x = chain.jet(t).c;  // the chain does not bound the face: nearest point
  const FacetFoot foot = body_->facets.closest(face - 1, x, near);
  return packed(foot.facet, foot.foot.uv);
}

Vec2 FacetModel::edge_parameters(Index facet, Index edge, double s) const {
  const std::array<Index, 4>& own = body_->features.facet2edge[at(facet)];
  const std::size_t i =
      static_cast<std::size_t>(std::find(own.begin(), own.end(), edge) - own.begin());
  const std::array<Index, 4>& corner = body_->corner_of[at(facet)];
  const std::size_t n = corner[3] == k_none ? 3 : 4;
  const std::span<const Vec3> xi = corners(n == 3 ? Shape::triangle : Shape::quadrilateral);
  const bool is_forward = corner[i] < corner[(i + 1) % n];
  const double t = is_forward ? s : 1.0 - s;
  const Vec3 x = (1.0 - t) * xi[i] + t * xi[(i + 1) % n];
  return x.head<2>();
}

std::unique_ptr<Projector> FacetModel::projector() const {
  return std::make_unique<FacetProjector>(body_, scale_);
}

void FacetModel::set_scale(double scale) {
  if (!(scale > 0.0) || !std::isfinite(scale)) {
    throw GeometryError("the scale of a model must be positive", std::to_string(scale),
                        "a geometry made from the mesh has the mesh's unit");
  }
  scale_ = scale;
}

}  // namespace camber::detail
