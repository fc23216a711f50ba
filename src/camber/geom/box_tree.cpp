#include <camber/geom/box_tree.hpp>

#include <limits>
#include <numeric>

namespace camber {
namespace {

constexpr int k_leaf_size = 2;

}  // namespace

double line_entry(const Box& box, const Vec3& x, const Vec3& d, double limit) {
  double low = -limit, high = limit;
  for (int k = 0; k < 3; ++k) {
    if (d[k] == 0.0) {
      if (x[k] < box.lower[k] || x[k] > box.upper[k])
        return std::numeric_limits<double>::infinity();
      continue;
    }
    const double a = (box.lower[k] - x[k]) / d[k], b = (box.upper[k] - x[k]) / d[k];
    low = std::max(low, std::min(a, b));
    high = std::min(high, std::max(a, b));
  }
  if (low > high) return std::numeric_limits<double>::infinity();
  return std::max({0.0, low, -high});
}

BoxTree::BoxTree(std::vector<Box> items) : items_(std::move(items)) {
  if (items_.empty()) return;
  order_.resize(items_.size());
  std::iota(order_.begin(), order_.end(), 0);
  nodes_.reserve(2 * items_.size());
  nodes_.emplace_back();
  build(0, 0, static_cast<int>(items_.size()), 0);
}

void BoxTree::build(int node, int begin, int end, int depth) {
  Box box, centres;
  for (int i = begin; i < end; ++i) {
    box.add(items_[at(order_[at(i)])]);
    centres.add(items_[at(order_[at(i)])].centre());
  }
  nodes_[at(node)] = {box, begin, end - begin};
  if (end - begin <= k_leaf_size || depth + 1 >= k_max_depth) return;
  int axis = 0;
  (centres.upper - centres.lower).maxCoeff(&axis);
  const int middle = begin + (end - begin) / 2;
  std::nth_element(
      order_.begin() + begin, order_.begin() + middle, order_.begin() + end, [&](int a, int b) {
        const double ca = items_[at(a)].centre()[axis], cb = items_[at(b)].centre()[axis];
        return ca != cb ? ca < cb : a < b;
      });
  const int child = static_cast<int>(nodes_.size());
  nodes_.emplace_back();
  nodes_.emplace_back();
  nodes_[at(node)].first = child;
  nodes_[at(node)].count = 0;
  build(child, begin, middle, depth + 1);
  build(child + 1, middle, end, depth + 1);
}

}  // namespace camber
