#pragma once
// Binary tree of axis-aligned boxes: nearest items to a point, items along a line.
#include <camber/base/ids.hpp>
#include <camber/base/vec.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace camber {

/// Smallest squared distance from x to the closed box (0 inside).
[[nodiscard]] inline double distance_squared(const Box& box, const Vec3& x) {
  return (box.lower - x).cwiseMax(x - box.upper).cwiseMax(0.0).squaredNorm();
}

/// Smallest |s| at which x + s d meets the box; +infinity if it does not within |s| <= limit.
[[nodiscard]] double line_entry(const Box& box, const Vec3& x, const Vec3& d, double limit);

/// Immutable after construction; queries are const, allocate nothing and visit in a fixed order.
class BoxTree {
 public:
  BoxTree() = default;
  explicit BoxTree(std::vector<Box> items);

  [[nodiscard]] bool is_empty() const { return items_.empty(); }
  [[nodiscard]] const Box& item(int i) const { return items_[at(i)]; }

  /// Calls visit(item) for items whose box is nearer than sqrt(bound()), nearer branches first;
  /// visit may lower what bound() returns (a squared distance).
  template <class Bound, class Visit>
  void nearest(const Vec3& x, const Bound& bound, const Visit& visit) const {
    search([&](const Box& box) { return distance_squared(box, x); }, bound, visit);
  }

  /// The same for the line x + s d: visits boxes entered at |s| < bound() (an |s|, of unit d).
  template <class Bound, class Visit>
  void along_line(const Vec3& x, const Vec3& d, const Bound& bound, const Visit& visit) const {
    search([&](const Box& box) { return line_entry(box, x, d, bound()); }, bound, visit);
  }

 private:
  struct Node {
    Box box;
    std::int32_t first,
        count;  // count > 0: leaf with items order_[first..]; else children first, first + 1
  };
  void build(int node, int begin, int end, int depth);

  template <class Key, class Bound, class Visit>
  void search(const Key& key, const Bound& bound, const Visit& visit) const {
    if (nodes_.empty()) return;
    struct Pending {
      int node;
      double key;
    };
    std::array<Pending, 2 * k_max_depth> stack;
    std::size_t size = 0;
    stack[size++] = {0, key(nodes_[0].box)};
    while (size > 0) {
      const Pending top = stack[--size];
      if (!(top.key < bound())) continue;
      const Node& node = nodes_[at(top.node)];
      if (node.count > 0) {
        for (int i = node.first; i < node.first + node.count; ++i)
          if (const int id = order_[at(i)]; key(items_[at(id)]) < bound()) visit(id);
        continue;
      }
      Pending near{node.first, key(nodes_[at(node.first)].box)};
      Pending far{node.first + 1, key(nodes_[at(node.first + 1)].box)};
      if (far.key < near.key) std::swap(near, far);
      stack[size++] = far;
      stack[size++] = near;
    }
  }

  static constexpr int k_max_depth = 48;
  std::vector<Box> items_;
  std::vector<int> order_;
  std::vector<Node> nodes_;
};

}  // namespace camber
