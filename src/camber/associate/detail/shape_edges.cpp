#include <camber/associate/detail/shape_edges.hpp>
#include <camber/base/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace camber {
namespace {

/// The ends of an edge on a curve are nearer to it than this share of the edge, or within the CAD's
/// own tolerance: a seam passes between mesh edges that do not follow it.
constexpr double k_on_curve_share = 1e-4;
/// Ends of an edge between two CAD faces: these faces say already that it is on a common curve.
constexpr double k_between_share = 1e-1;
/// |cosine| between the edge and the curve's tangent at its ends: a chord across a ring's opening
/// or between two curves has less; a sixth of a circle 0.87. Between two CAD faces a quarter of a
/// circle (0.71) and sharper bends are believed too.
constexpr double k_along_cosine = 0.5;
constexpr double k_between_cosine = 0.2;

class EdgeLinker {
 public:
  EdgeLinker(const LinearMesh& mesh, const Topology& topology, const Boundary& boundary,
             const GeometryModel& model, const FaceMatch& match, const std::vector<double>& reach,
             const std::vector<GeometryGroup>& given, Association& association)
      : mesh_(mesh),
        topology_(topology),
        boundary_(boundary),
        model_(model),
        match_(match),
        reach_(reach),
        given_(given),
        association_(association) {}

  void run() {
    association_.edge2curve.assign(topology_.edge_count(), GeomEntity{});
    parallel_for_with(
        topology_.edge_count(), 64, [&] { return model_.projector(); },
        [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
          for (std::size_t e = begin; e < end; ++e) {
            const bool is_given = !given_.empty() && !given_[e].empty();
            const int curve = is_given ? nearest_given(*projector, static_cast<Index>(e))
                                       : curve_of(*projector, static_cast<Index>(e));
            if (curve > 0) association_.edge2curve[e] = {1, curve};
          }
        });
    link_vertices();
  }

 private:
  [[nodiscard]] const GeometryGroup& group(Index slot) const {
    static const GeometryGroup none;
    return slot == k_none ? none : match_.group[at(slot)];
  }

  static bool is_on(const GeometryGroup& faces, const std::vector<int>& of_curve) {
    return std::any_of(faces.begin(), faces.end(), [&](const GeomEntity& face) {
      return std::find(of_curve.begin(), of_curve.end(), face.tag) != of_curve.end();
    });
  }

  [[nodiscard]] bool is_inner(int curve, const GeometryGroup& faces) const {
    return std::any_of(faces.begin(), faces.end(),
                       [&](const GeomEntity& face) { return model_.is_seam(curve, face.tag); });
  }

  /// The curve that a mesh edge follows, or 0. Between two CAD faces: one that bounds both. Inside
  /// one: a seam. On the border of the CAD: one that bounds its face.
  [[nodiscard]] int curve_of(Projector& projector, Index e) const {
    const std::array<Index, 2>& sides = boundary_.edge_faces[at(e)];
    const GeometryGroup *a = &group(sides[0]), *b = &group(sides[1]);
    if (a->empty()) std::swap(a, b);
    if (a->empty()) return 0;
    const bool is_within = *a == *b, is_border = b->empty();
    const bool is_between = !is_within && !is_border;
    const Vec3& from = mesh_.vertices[at(topology_.edge2vertex[at(e)][0])];
    const Vec3& to = mesh_.vertices[at(topology_.edge2vertex[at(e)][1])];
    const double length = (to - from).norm();
    if (!is_between && !given_.empty()) return 0;
    int best = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (const GeomEntity& face : *a) {
      for (int curve : model_.curves_of_face(face.tag)) {
        if (model_.is_degenerate(curve)) continue;
        const std::vector<int> faces = model_.faces_of_curve(curve);
        if (is_within && !is_inner(curve, *a)) continue;
        if (is_between && !is_on(*b, faces)) continue;
        const double gap = 2.0 * model_.tolerance({1, curve});
        const double share = is_between ? k_between_share : k_on_curve_share;
        const double allowed = std::max(share * length, std::min(gap, k_between_share * length));
        const double off = distance(projector, curve, from, to, allowed,
                                    is_between ? k_between_cosine : k_along_cosine);
        if (off < nearest) {
          nearest = off;
          best = curve;
        }
      }
    }
    return best;
  }

  /// Of the curves that were given for an edge the one nearest to its ends.
  [[nodiscard]] int nearest_given(Projector& projector, Index e) const {
    int best = 0;
    double nearest = std::numeric_limits<double>::infinity();
    for (const GeomEntity& curve : given_[at(e)]) {
      if (curve.dim != 1 || model_.is_degenerate(curve.tag)) continue;
      double off = 0.0;
      for (Index v : topology_.edge2vertex[at(e)]) {
        off = std::max(off, projector.closest(curve, mesh_.vertices[at(v)]).distance);
      }
      if (off >= nearest) continue;
      nearest = off;
      best = curve.tag;
    }
    return best;
  }

  /// Larger distance of the two ends from the curve; infinite beyond `allowed` or across it.
  [[nodiscard]] double distance(Projector& projector, int curve, const Vec3& from, const Vec3& to,
                                double allowed, double least_cosine) const {
    constexpr double far = std::numeric_limits<double>::infinity();
    const Vec3 along = (to - from).normalized();
    double largest = 0.0;
    for (const Vec3* x : {&from, &to}) {
      const Projection foot = projector.closest({1, curve}, *x);
      if (foot.status == ProjectionStatus::failed || foot.distance > allowed) return far;
      const Vec3 tangent = projector.evaluate_curve(curve, foot.uv.x()).tangent;
      const double size = tangent.norm();
      if (size > 0.0 && std::abs(tangent.dot(along)) < least_cosine * size) return far;
      largest = std::max(largest, foot.distance);
    }
    return largest;
  }

  /// A vertex on mesh edges of two curves (or at the end of one) lies on a CAD vertex of them if
  /// there is one in reach, else on the curve; others on the CAD face.
  void link_vertices() {
    const std::size_t n = mesh_.vertices.size();
    association_.vertex2entity.assign(n, GeomEntity{});
    for (std::size_t s = 0; s < boundary_.faces.size(); ++s) {
      if (match_.group[s].empty()) continue;
      const Boundary::Face& face = boundary_.faces[s];
      for (int i = 0; i < face.corners; ++i) {
        const Index v = topology_.face2vertex[at(face.face)][static_cast<std::size_t>(i)];
        association_.vertex2entity[at(v)] = nearest_face(v, match_.group[s]);
      }
    }
    std::map<Index, std::vector<int>> curves;
    for (Index e = 0; at(e) < topology_.edge_count(); ++e) {
      if (association_.edge2curve[at(e)].dim != 1) continue;
      for (Index v : topology_.edge2vertex[at(e)]) {
        curves[v].push_back(association_.edge2curve[at(e)].tag);
      }
    }
    const std::unique_ptr<Projector> projector = model_.projector();
    for (auto& [v, list] : curves) {
      std::sort(list.begin(), list.end());
      const bool is_chain = list.size() == 2 && list[0] == list[1];
      association_.vertex2entity[at(v)] = {1, list.front()};
      if (is_chain) continue;
      double nearest = reach_[at(boundary_.vertex_slot[at(v)])];
      for (int curve : list) {
        for (int vertex : model_.vertices_of_curve(curve)) {
          const double off = projector->closest({0, vertex}, mesh_.vertices[at(v)]).distance;
          if (off > nearest) continue;
          nearest = off;
          association_.vertex2entity[at(v)] = {0, vertex};
        }
      }
    }
    for (std::size_t s = 0; s < boundary_.vertices.size(); ++s) {
      const GeomEntity entity = association_.vertex2entity[at(boundary_.vertices[s])];
      if (entity.dim < 0) continue;
      const Vec3& x = mesh_.vertices[at(boundary_.vertices[s])];
      association_.largest_distance =
          std::max(association_.largest_distance, projector->closest(entity, x).distance);
    }
  }

  [[nodiscard]] GeomEntity nearest_face(Index v, const GeometryGroup& faces) const {
    for (const NearFace& near : match_.near[at(boundary_.vertex_slot[at(v)])]) {
      const GeomEntity face{2, near.face};
      if (std::find(faces.begin(), faces.end(), face) != faces.end()) return face;
    }
    return faces.front();
  }

  const LinearMesh& mesh_;
  const Topology& topology_;
  const Boundary& boundary_;
  const GeometryModel& model_;
  const FaceMatch& match_;
  const std::vector<double>& reach_;
  const std::vector<GeometryGroup>& given_;
  Association& association_;
};

}  // namespace

void link_edges_and_vertices(const LinearMesh& mesh, const Topology& topology,
                             const Boundary& boundary, const GeometryModel& model,
                             const FaceMatch& match, const std::vector<double>& reach,
                             const std::vector<GeometryGroup>& given, Association& association) {
  EdgeLinker(mesh, topology, boundary, model, match, reach, given, association).run();
}

}  // namespace camber
