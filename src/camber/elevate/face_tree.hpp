#pragma once
// Closest points on straight boundary faces.
#include <camber/mesh/topology.hpp>

#include <span>
#include <vector>

namespace camber {

struct FaceHit {
  Index item = k_none;     // index into the faces given
  Vec3 xi = Vec3::Zero();  // reference point on that face, in its frame
  Vec3 point = Vec3::Zero();
  double distance = 0.0;
};

/// Bounding-volume tree over linear faces, each of which has a label. Quadrilaterals are two
/// triangles. Read-only after construction: any number of threads.
class FaceTree {
 public:
  FaceTree() = default;
  /// labels[i]: small non-negative integers; queries answer once per label.
  FaceTree(const LinearMesh& mesh, const Topology& topology, std::span<const Index> faces,
           std::span<const int> labels);

  /// For every label whose nearest face is within `radius` of x: that face. Sorted by distance,
  /// ties by item.
  void nearest_per_label(const Vec3& x, double radius, std::vector<FaceHit>& hits) const;
  /// The nearest of all, if within radius.
  [[nodiscard]] bool nearest(const Vec3& x, double radius, FaceHit& hit) const;
  [[nodiscard]] bool is_empty() const { return triangles_.empty(); }
  [[nodiscard]] int label(Index item) const { return labels_[at(item)]; }

 private:
  struct Triangle {
    std::array<Vec3, 3> x;
    std::array<Vec3, 3> xi;
    Index item;
  };
  struct Node {
    Vec3 lower, upper;
    Index first = 0, count = 0;  // leaf: triangles; else count = 0 and children at first, first + 1
    int label = -1;              // of all triangles below, -1 if several
  };
  void build(Index node, Index first, Index count);
  template <class Visit>
  void search(const Vec3& x, Visit& visit) const;

  std::vector<Triangle> triangles_;
  std::vector<Node> nodes_;
  std::vector<int> labels_;
  int label_count_ = 0;
};

}  // namespace camber
