#include <camber/associate/detail/face_match.hpp>
#include <camber/base/parallel.hpp>
#include <camber/geom/box_tree.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace camber {
namespace {

/// A CAD face all of whose distances to the forming nodes are within this many times those of the
/// nearest one is as good as that: round-off and edge tolerances are of that order.
constexpr double k_as_near = 3.0;
/// The same as a share of the face's shortest edge: nodes of a good mesh are nearer by far.
constexpr double k_close_share = 1e-4;
/// Gaps between CAD faces (edge tolerances) count up to this share of the face's shortest edge.
constexpr double k_gap_share = 0.3;
/// |cosine| between facet and CAD normal at the facet's centre from which on they face one way; the
/// side of a symmetry plane that meets a wall at right angles has 0, coarse facets 0.8 and more.
constexpr double k_least_cosine = 0.3;
/// The same at the corners of faces across CAD edges.
constexpr double k_least_corner_cosine = 0.5;
/// Highest share of its longest edge that a facet's centre may be off the CAD: a sixth of a circle
/// in one chord has 0.13.
constexpr double k_highest_bulge = 0.35;
/// A CAD face whose facets nearly all have one sense has it everywhere; two-sided sheets do not.
constexpr double k_one_sense = 0.75;
/// Weight of the normal against the distance over the edge length.
constexpr double k_normal_weight = 0.5;

struct Candidate {
  int face = 0;
  double nodes = 0.0;   // largest distance of a forming node
  double centre = 0.0;  // distance of the facet's centre
  double cosine = 0.0;  // between the normals there, signed
};

class Matcher {
 public:
  Matcher(const LinearMesh& mesh, const Topology& topology, const Boundary& boundary,
          const GeometryModel& model, const std::vector<double>& reach, const AllowedFaces& allowed)
      : mesh_(mesh),
        topology_(topology),
        boundary_(boundary),
        model_(model),
        reach_(reach),
        allowed_(allowed) {
    gap_.assign(static_cast<std::size_t>(model.count(2)) + 1, 0.0);
    for (int face = 1; face <= model.count(2); ++face) {
      double& gap = gap_[static_cast<std::size_t>(face)];
      gap = model.tolerance({2, face});
      for (int curve : model.curves_of_face(face)) {
        gap = std::max(gap, model.tolerance({1, curve}));
      }
    }
  }

  FaceMatch run() {
    find_near();
    find_candidates();
    const std::size_t n = boundary_.faces.size();
    match_.group.resize(n);
    match_.confidence.assign(n, 1.0);
    match_.is_off.assign(n, 0);
    sense_.assign(gap_.size(), 0);
    choose();
    find_senses();
    choose();
    fill_from_neighbours();
    find_groups();
    return std::move(match_);
  }

 private:
  [[nodiscard]] Index corner(std::size_t slot, int i) const {
    return boundary_.vertex_slot[at(
        topology_.face2vertex[at(boundary_.faces[slot].face)][static_cast<std::size_t>(i)])];
  }

  void find_near() {
    std::vector<Box> boxes;
    for (int face = 1; face <= model_.count(2); ++face) boxes.push_back(model_.box({2, face}));
    const BoxTree tree(std::move(boxes));
    match_.near.resize(boundary_.vertices.size());
    parallel_for_with(
        boundary_.vertices.size(), 64, [&] { return model_.projector(); },
        [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
          for (std::size_t v = begin; v < end; ++v) {
            const Vec3& x = mesh_.vertices[at(boundary_.vertices[v])];
            std::vector<NearFace>& near = match_.near[v];
            const double reach = reach_[v];
            // The box of an exactly flat face has no inside: the bound is just above the reach.
            const double bound = reach * reach * (1.0 + 1e-12);
            tree.nearest(
                x, [&] { return bound; },
                [&](int item) {
                  const Projection foot = projector->closest({2, item + 1}, x);
                  if (foot.status != ProjectionStatus::failed && foot.distance <= reach) {
                    near.push_back({item + 1, foot.distance});
                  }
                });
            std::sort(near.begin(), near.end(), [](const NearFace& a, const NearFace& b) {
              return a.distance != b.distance ? a.distance < b.distance : a.face < b.face;
            });
          }
        });
  }

  [[nodiscard]] bool may_lie_on(std::size_t slot, int face) const {
    const GeometryGroup* group = allowed_[slot];
    return !group || std::find(group->begin(), group->end(), GeomEntity{2, face}) != group->end();
  }

  /// Largest distance of a forming node to the CAD face; infinite if one is out of reach.
  [[nodiscard]] double node_distance(std::size_t slot, int face) const {
    double largest = 0.0;
    for (int i = 0; i < boundary_.faces[slot].corners; ++i) {
      const std::vector<NearFace>& near = match_.near[at(corner(slot, i))];
      const auto found =
          std::find_if(near.begin(), near.end(), [&](const NearFace& n) { return n.face == face; });
      if (found == near.end()) return std::numeric_limits<double>::infinity();
      largest = std::max(largest, found->distance);
    }
    return largest;
  }

  Candidate measure(Projector& projector, const Boundary::Face& face, int cad, double nodes) const {
    Candidate candidate{cad, nodes, std::numeric_limits<double>::infinity(), 0.0};
    const Projection foot = projector.closest({2, cad}, face.centre);
    if (foot.status == ProjectionStatus::failed) return candidate;
    candidate.centre = foot.distance;
    candidate.cosine = projector.evaluate_face(cad, foot.uv).normal.dot(face.normal);
    return candidate;
  }

  /// CAD faces that hold all forming nodes as well as the best one does.
  void find_candidates() {
    candidates_.resize(boundary_.faces.size());
    parallel_for_with(
        boundary_.faces.size(), 32, [&] { return model_.projector(); },
        [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
          for (std::size_t s = begin; s < end; ++s) {
            const Boundary::Face& face = boundary_.faces[s];
            std::vector<NearFace> common;
            double nearest = std::numeric_limits<double>::infinity();
            for (const NearFace& near : match_.near[at(corner(s, 0))]) {
              if (!may_lie_on(s, near.face)) continue;
              const double distance = node_distance(s, near.face);
              if (distance > farthest(s, near.face)) continue;
              common.push_back({near.face, distance});
              nearest = std::min(nearest, distance);
            }
            for (const NearFace& near : common) {
              if (near.distance <= limit(s, near.face, nearest)) {
                candidates_[s].push_back(measure(*projector, face, near.face, near.distance));
              }
            }
          }
        });
  }

  /// Distance up to which a CAD face holds a node as well as one at `nearest`.
  [[nodiscard]] double limit(std::size_t slot, int face, double nearest) const {
    const double shortest = boundary_.faces[slot].shortest;
    return std::max({k_as_near * nearest, k_close_share * shortest,
                     std::min(2.0 * gap_[static_cast<std::size_t>(face)], k_gap_share * shortest)});
  }

  /// Nodes farther away than this do not lie on the CAD face whatever the alternatives: the sides
  /// of thin layers have nodes near the wall too.
  [[nodiscard]] double farthest(std::size_t slot, int face) const {
    return std::max(k_gap_share * boundary_.faces[slot].shortest,
                    2.0 * gap_[static_cast<std::size_t>(face)]);
  }

  [[nodiscard]] bool faces_its_way(const Boundary::Face& face, const Candidate& c) const {
    const int sense = sense_[static_cast<std::size_t>(c.face)];
    const double cosine = sense == 0 ? std::abs(c.cosine) : sense * c.cosine;
    return cosine >= k_least_cosine && c.centre <= k_highest_bulge * face.longest;
  }

  /// How little a CAD face fits: distance of the centre over the edge length, and turn of normal.
  [[nodiscard]] static double misfit(const Boundary::Face& face, const Candidate& c) {
    return c.centre / face.longest + k_normal_weight * (1.0 - std::abs(c.cosine));
  }

  void choose() {
    for (std::size_t s = 0; s < boundary_.faces.size(); ++s) {
      const Boundary::Face& face = boundary_.faces[s];
      const Candidate* best = nullptr;
      double least = std::numeric_limits<double>::infinity(), second = least;
      for (const Candidate& c : candidates_[s]) {
        if (!faces_its_way(face, c)) continue;
        const double cost = misfit(face, c);
        if (cost < least) {
          second = least;
          least = cost;
          best = &c;
        } else {
          second = std::min(second, cost);
        }
      }
      match_.group[s].clear();
      if (best) match_.group[s] = {{2, best->face}};
      match_.is_off[s] = !best && !candidates_[s].empty();
      match_.confidence[s] = !best ? 0.0 : std::isfinite(second) ? 1.0 - least / second : 1.0;
    }
  }

  /// +1 (-1): the facets on this CAD face have its normal (against it), 0: no rule.
  void find_senses() {
    std::vector<double> along(gap_.size(), 0.0), against(gap_.size(), 0.0);
    for (std::size_t s = 0; s < boundary_.faces.size(); ++s) {
      if (match_.group[s].empty()) continue;
      const int face = match_.group[s].front().tag;
      for (const Candidate& c : candidates_[s]) {
        if (c.face != face) continue;
        (c.cosine > 0.0 ? along : against)[static_cast<std::size_t>(face)] +=
            boundary_.faces[s].area;
      }
    }
    for (std::size_t face = 0; face < gap_.size(); ++face) {
      const double all = along[face] + against[face];
      if (all <= 0.0) continue;
      if (along[face] >= k_one_sense * all) sense_[face] = 1;
      if (against[face] >= k_one_sense * all) sense_[face] = -1;
    }
  }

  /// A facet whose CAD normal could not decide (poles, folds) follows a smooth neighbour on a CAD
  /// face that holds its nodes too.
  void fill_from_neighbours() {
    bool is_changed = true;
    while (is_changed) {
      is_changed = false;
      const std::vector<GeometryGroup> before = match_.group;
      for (std::size_t s = 0; s < boundary_.faces.size(); ++s) {
        if (!before[s].empty()) continue;
        const Boundary::Face& face = boundary_.faces[s];
        for (int i = 0; i < face.corners && match_.group[s].empty(); ++i) {
          const Index e = topology_.face2edge[at(face.face)][static_cast<std::size_t>(i)];
          for (Index other : boundary_.edge_faces[at(e)]) {
            if (other == k_none || before[at(other)].size() != 1) continue;
            if (boundary_.faces[at(other)].normal.dot(face.normal) < k_smooth) continue;
            const int cad = before[at(other)].front().tag;
            const bool holds =
                std::any_of(candidates_[s].begin(), candidates_[s].end(), [&](const Candidate& c) {
                  return c.face == cad && c.centre <= k_highest_bulge * face.longest;
                });
            if (!holds) continue;
            match_.group[s] = {{2, cad}};
            match_.is_off[s] = 0;
            is_changed = true;
          }
        }
      }
    }
  }

  /// Faces that no single CAD face holds: all that hold a forming node and face its way there.
  void find_groups() {
    parallel_for_with(
        boundary_.faces.size(), 64, [&] { return model_.projector(); },
        [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
          for (std::size_t s = begin; s < end; ++s) {
            if (match_.group[s].empty() && candidates_[s].empty()) find_group(*projector, s);
          }
        });
  }

  void find_group(Projector& projector, std::size_t s) {
    const Boundary::Face& face = boundary_.faces[s];
    GeometryGroup group;
    bool is_near = true;
    for (int i = 0; i < face.corners; ++i) {
      const Index v = corner(s, i);
      const std::vector<NearFace>& near = match_.near[at(v)];
      bool is_close = false, is_held = false;
      for (const NearFace& n : near) {
        if (!may_lie_on(s, n.face)) continue;
        if (n.distance > std::min(limit(s, n.face, near.front().distance), farthest(s, n.face)))
          continue;
        is_close = true;
        const Vec3& x = mesh_.vertices[at(boundary_.vertices[at(v)])];
        const Projection foot = projector.closest({2, n.face}, x);
        const double cosine = projector.evaluate_face(n.face, foot.uv).normal.dot(face.normal);
        const int sense = sense_[static_cast<std::size_t>(n.face)];
        if ((sense == 0 ? std::abs(cosine) : sense * cosine) < k_least_corner_cosine) continue;
        is_held = true;
        group.push_back({2, n.face});
      }
      if (!is_close) return;
      is_near = is_near && is_held;
    }
    std::sort(group.begin(), group.end());
    group.erase(std::unique(group.begin(), group.end()), group.end());
    if (is_near) add_bridged(projector, face, group);
    const bool is_on = is_near && project_to_group(projector, group, face.centre).distance <=
                                      k_highest_bulge * face.longest;
    match_.is_off[s] = !is_on;
    if (!is_on) return;
    match_.group[s] = std::move(group);
    match_.confidence[s] = k_group_confidence;
  }

  /// Adds CAD faces next to the group that are narrower than the facet: nearer to its centre than
  /// all that hold a node.
  void add_bridged(Projector& projector, const Boundary::Face& face, GeometryGroup& group) const {
    const double nearest = project_to_group(projector, group, face.centre).distance;
    std::vector<int> neighbours;
    for (const GeomEntity& member : group) {
      for (int curve : model_.curves_of_face(member.tag)) {
        for (int other : model_.faces_of_curve(curve)) neighbours.push_back(other);
      }
    }
    std::sort(neighbours.begin(), neighbours.end());
    neighbours.erase(std::unique(neighbours.begin(), neighbours.end()), neighbours.end());
    GeometryGroup added;
    for (int other : neighbours) {
      if (std::find(group.begin(), group.end(), GeomEntity{2, other}) != group.end()) continue;
      const Candidate c = measure(projector, face, other, 0.0);
      if (c.centre < nearest && faces_its_way(face, c)) added.push_back({2, other});
    }
    group.insert(group.end(), added.begin(), added.end());
    std::sort(group.begin(), group.end());
  }

  /// Cosine of 45 degrees: facets that turn less are one smooth surface to fill_from_neighbours.
  static constexpr double k_smooth = 0.7;
  /// Of faces across CAD edges: right, but not exact.
  static constexpr double k_group_confidence = 0.5;

  const LinearMesh& mesh_;
  const Topology& topology_;
  const Boundary& boundary_;
  const GeometryModel& model_;
  const std::vector<double>& reach_;
  const AllowedFaces& allowed_;
  std::vector<double> gap_;  // by CAD face: its tolerance and that of its curves
  std::vector<int> sense_;   // by CAD face
  std::vector<std::vector<Candidate>> candidates_;
  FaceMatch match_;
};

}  // namespace

FaceMatch match_faces(const LinearMesh& mesh, const Topology& topology, const Boundary& boundary,
                      const GeometryModel& model, const std::vector<double>& reach,
                      const AllowedFaces& allowed) {
  return Matcher(mesh, topology, boundary, model, reach, allowed).run();
}

}  // namespace camber
