#include <camber/elevate/face_tree.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace camber {
namespace {

constexpr Index k_leaf_size = 4;

/// Room that a bound of a squared distance leaves for rounding: relative to it, and to the square
/// of the distance from the origin.
constexpr double k_bound_slack = 1.0 + 1e-9, k_rounding = 1e-20;

double squared_distance_to_box(const Vec3& x, const Vec3& lower, const Vec3& upper) {
  return (lower - x).cwiseMax(x - upper).cwiseMax(0.0).squaredNorm();
}

/// Barycentric coordinates of the point of triangle (a,b,c) nearest to p, region by region
/// (Ericson, Real-Time Collision Detection, 2005, 5.1.5).
Vec3 nearest_barycentric(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c) {
  const Vec3 ab = b - a, ac = c - a, ap = p - a;
  const double d1 = ab.dot(ap), d2 = ac.dot(ap);
  if (d1 <= 0.0 && d2 <= 0.0) return {1.0, 0.0, 0.0};
  const Vec3 bp = p - b;
  const double d3 = ab.dot(bp), d4 = ac.dot(bp);
  if (d3 >= 0.0 && d4 <= d3) return {0.0, 1.0, 0.0};
  const double vc = d1 * d4 - d3 * d2;
  if (vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0) {
    const double t = d1 / (d1 - d3);
    return {1.0 - t, t, 0.0};
  }
  const Vec3 cp = p - c;
  const double d5 = ab.dot(cp), d6 = ac.dot(cp);
  if (d6 >= 0.0 && d5 <= d6) return {0.0, 0.0, 1.0};
  const double vb = d5 * d2 - d1 * d6;
  if (vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0) {
    const double t = d2 / (d2 - d6);
    return {1.0 - t, 0.0, t};
  }
  const double va = d3 * d6 - d5 * d4;
  if (va <= 0.0 && d4 - d3 >= 0.0 && d5 - d6 >= 0.0) {
    const double t = (d4 - d3) / ((d4 - d3) + (d5 - d6));
    return {0.0, 1.0 - t, t};
  }
  const double sum = va + vb + vc;
  return {va / sum, vb / sum, vc / sum};
}

}  // namespace

FaceTree::FaceTree(const LinearMesh& mesh, const Topology& topology, std::span<const Index> faces,
                   std::span<const int> labels)
    : labels_(labels.begin(), labels.end()) {
  for (std::size_t i = 0; i < faces.size(); ++i) {
    const Index f = faces[i];
    const std::array<Index, 4>& v = topology.face2vertex[at(f)];
    const auto x = [&](std::size_t k) { return mesh.vertices[at(v[k])]; };
    const std::span<const Vec3> xi = corners(topology.face_shape[at(f)]);
    triangles_.push_back({{x(0), x(1), x(2)}, {xi[0], xi[1], xi[2]}, static_cast<Index>(i)});
    if (topology.face_shape[at(f)] == Shape::quadrilateral) {
      triangles_.push_back({{x(0), x(2), x(3)}, {xi[0], xi[2], xi[3]}, static_cast<Index>(i)});
    }
    label_count_ = std::max(label_count_, labels_[i] + 1);
  }
  if (triangles_.empty()) return;
  nodes_.reserve(triangles_.size());
  nodes_.emplace_back();
  build(0, 0, static_cast<Index>(triangles_.size()));
}

void FaceTree::build(Index node, Index first, Index count) {
  Box box, centres;
  int label = labels_[at(triangles_[at(first)].item)];
  for (Index i = first; i < first + count; ++i) {
    const Triangle& t = triangles_[at(i)];
    for (const Vec3& x : t.x) box.add(x);
    centres.add((t.x[0] + t.x[1] + t.x[2]) / 3.0);
    if (labels_[at(t.item)] != label) label = -1;
  }
  nodes_[at(node)].lower = box.lower;
  nodes_[at(node)].upper = box.upper;
  nodes_[at(node)].label = label;
  if (count <= k_leaf_size) {
    nodes_[at(node)].first = first;
    nodes_[at(node)].count = count;
    return;
  }
  Eigen::Index axis = 0;
  (centres.upper - centres.lower).maxCoeff(&axis);
  const Index half = count / 2;
  const auto begin = triangles_.begin() + first;
  std::nth_element(begin, begin + half, begin + count,
                   [axis](const Triangle& a, const Triangle& b) {
                     const double ca = a.x[0][axis] + a.x[1][axis] + a.x[2][axis];
                     const double cb = b.x[0][axis] + b.x[1][axis] + b.x[2][axis];
                     return ca != cb ? ca < cb : a.item < b.item;
                   });
  const Index child = static_cast<Index>(nodes_.size());
  nodes_.emplace_back();
  nodes_.emplace_back();
  nodes_[at(node)].first = child;
  nodes_[at(node)].count = 0;
  build(child, first, half);
  build(child + 1, first + half, count - half);
}

template <class Visit>
void FaceTree::search(const Vec3& x, Visit& visit) const {
  if (triangles_.empty()) return;
  std::array<std::pair<double, Index>, 128> stack;
  std::size_t depth = 0;
  stack[depth++] = {squared_distance_to_box(x, nodes_[0].lower, nodes_[0].upper), 0};
  while (depth > 0) {
    const auto [squared, index] = stack[--depth];
    const Node& node = nodes_[at(index)];
    if (squared > visit.bound(node.label)) continue;
    if (node.count > 0) {
      for (Index i = node.first; i < node.first + node.count; ++i) {
        const Triangle& t = triangles_[at(i)];
        const Vec3 w = nearest_barycentric(x, t.x[0], t.x[1], t.x[2]);
        const Vec3 point = w[0] * t.x[0] + w[1] * t.x[1] + w[2] * t.x[2];
        const double d = (x - point).squaredNorm();
        if (d > visit.bound(labels_[at(t.item)])) continue;
        FaceHit hit{t.item, w[0] * t.xi[0] + w[1] * t.xi[1] + w[2] * t.xi[2], point, d};
        visit.take(labels_[at(t.item)], hit);
      }
      continue;
    }
    const Node &a = nodes_[at(node.first)], &b = nodes_[at(node.first + 1)];
    const double da = squared_distance_to_box(x, a.lower, a.upper);
    const double db = squared_distance_to_box(x, b.lower, b.upper);
    // The nearer child is searched first.
    if (da <= db) {
      stack[depth++] = {db, node.first + 1};
      stack[depth++] = {da, node.first};
    } else {
      stack[depth++] = {da, node.first};
      stack[depth++] = {db, node.first + 1};
    }
  }
}

namespace {

bool is_better(const FaceHit& a, const FaceHit& b) {
  if (b.item == k_none) return true;
  return a.distance != b.distance ? a.distance < b.distance : a.item < b.item;
}

struct NearestVisit {
  FaceHit best;
  double limit;
  [[nodiscard]] double bound(int) const { return limit; }
  void take(int, const FaceHit& hit) {
    if (is_better(hit, best)) {
      best = hit;
      limit = hit.distance;
    }
  }
};

struct PerLabelVisit {
  std::vector<FaceHit>& hits;  // by position; label kept beside
  std::vector<int>& label_of_hit;
  double limit;
  [[nodiscard]] double bound(int label) const {
    if (label < 0) return limit;
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (label_of_hit[i] == label) return hits[i].distance;
    }
    return limit;
  }
  void take(int label, const FaceHit& hit) {
    for (std::size_t i = 0; i < hits.size(); ++i) {
      if (label_of_hit[i] != label) continue;
      if (is_better(hit, hits[i])) hits[i] = hit;
      return;
    }
    hits.push_back(hit);
    label_of_hit.push_back(label);
  }
};

}  // namespace

bool FaceTree::nearest(const Vec3& x, double radius, FaceHit& hit) const {
  // Any point of the faces bounds the distance, and the last one found is mostly near. The bound
  // only spares boxes, with room for rounding: the answer has the same bits without it.
  thread_local const FaceTree* last_tree = nullptr;
  thread_local Vec3 last_point = Vec3::Zero();
  const double everywhere = radius * radius;
  double limit = everywhere;
  if (last_tree == this) {
    limit = std::min(limit,
                     k_bound_slack * (x - last_point).squaredNorm() + k_rounding * x.squaredNorm());
  }
  NearestVisit visit{{}, limit};
  search(x, visit);
  if (visit.best.item == k_none && limit < everywhere) {
    visit.limit = everywhere;
    search(x, visit);
  }
  if (visit.best.item == k_none) return false;
  hit = visit.best;
  hit.distance = std::sqrt(hit.distance);
  last_tree = this;
  last_point = hit.point;
  return true;
}

void FaceTree::nearest_per_label(const Vec3& x, double radius, std::vector<FaceHit>& hits) const {
  hits.clear();
  thread_local std::vector<int> labels;
  labels.clear();
  PerLabelVisit visit{hits, labels, radius * radius};
  search(x, visit);
  for (FaceHit& hit : hits) hit.distance = std::sqrt(hit.distance);
  std::sort(hits.begin(), hits.end(), [](const FaceHit& a, const FaceHit& b) {
    return a.distance != b.distance ? a.distance < b.distance : a.item < b.item;
  });
}

}  // namespace camber
