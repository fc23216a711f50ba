#include <camber/validity/detail/subdivision.hpp>

#include <algorithm>
#include <cmath>

namespace camber::detail {

namespace {

// Highest degree of a row: that of a hexahedron of the highest order, 3p - 1, with room to spare.
constexpr int k_longest_row = 64;

SplitDirection rows_along_edge(const CoefficientSpace& space, int f, int first, int second) {
  SplitDirection direction{f, first, second, {}, {0}};
  const Factor& factor = space.factors[static_cast<std::size_t>(f)];
  const int stride = space.stride(f);
  const int inner = stride, block = stride * factor.size();
  for (const MultiIndex& start : multi_indices(factor)) {
    if (start[static_cast<std::size_t>(second)] != 0) continue;  // rows start at `first`
    const int length = start[static_cast<std::size_t>(first)];
    for (int outer = 0; outer < space.size() / block; ++outer) {
      for (int i = 0; i < inner; ++i) {
        MultiIndex index = start;
        for (int t = 0; t <= length; ++t) {
          direction.index.push_back(outer * block + stride * multi_index_place(factor, index) + i);
          --index[static_cast<std::size_t>(first)];
          ++index[static_cast<std::size_t>(second)];
        }
        direction.row_begin.push_back(static_cast<std::int32_t>(direction.index.size()));
      }
    }
  }
  return direction;
}

}  // namespace

SubdivisionTable::SubdivisionTable(Shape shape, const CoefficientSpace& space)
    : shape_(shape),
      size_(space.size()),
      factors_(space.factors),
      corners_(corner_coefficients(space)) {
  for (std::size_t f = 0; f < factors_.size(); ++f) {
    if (factors_[f].degree < 2) continue;  // linear along this factor: nothing to gain
    degree_ = std::max(degree_, factors_[f].degree);
    for (int a = 0; a <= factors_[f].dim; ++a) {
      for (int b = a + 1; b <= factors_[f].dim; ++b) {
        directions_.push_back(rows_along_edge(space, static_cast<int>(f), a, b));
      }
    }
  }
}

int SubdivisionTable::most_bent(const double* c) const {
  int best = -1;
  double most = 0.0;
  for (std::size_t d = 0; d < directions_.size(); ++d) {
    const SplitDirection& direction = directions_[d];
    double bend = 0.0;
    for (std::size_t r = 0; r + 1 < direction.row_begin.size(); ++r) {
      const std::int32_t* row = direction.index.data() + direction.row_begin[r];
      const int length = direction.row_begin[r + 1] - direction.row_begin[r];
      for (int t = 2; t < length; ++t) {
        bend = std::max(bend, std::abs(c[row[t]] - 2.0 * c[row[t - 1]] + c[row[t - 2]]));
      }
    }
    if (bend > most) {
      most = bend;
      best = static_cast<int>(d);
    }
  }
  return best;
}

void SubdivisionTable::split(int d, double* c, double* other) const {
  const SplitDirection& direction = directions_[static_cast<std::size_t>(d)];
  std::array<double, k_longest_row> b;
  for (std::size_t r = 0; r + 1 < direction.row_begin.size(); ++r) {
    const std::int32_t* row = direction.index.data() + direction.row_begin[r];
    const int last = direction.row_begin[r + 1] - direction.row_begin[r] - 1;
    double* v = b.data();
    for (int t = 0; t <= last; ++t) v[t] = c[row[t]];
    other[row[0]] = v[0];
    for (int level = 1; level <= last; ++level) {
      for (int t = 0; t <= last - level; ++t) v[t] = 0.5 * (v[t] + v[t + 1]);
      other[row[level]] = v[0];
    }
    // What is left in v is the other half: v[t] = b(midpoint^(last - t), second^t).
    for (int t = 0; t <= last; ++t) c[row[t]] = v[t];
  }
}

Region SubdivisionTable::whole() const {
  Region region;
  for (auto& factor : region.vertex) factor.fill(Vec3::Zero());
  int axis = 0;
  for (std::size_t f = 0; f < factors_.size(); ++f) {
    for (int v = 1; v <= factors_[f].dim; ++v, ++axis) {
      region.vertex[f][static_cast<std::size_t>(v)] = Vec3::Unit(axis);
    }
  }
  return region;
}

void SubdivisionTable::halve(Region& region, int d, bool keeps_first) const {
  const SplitDirection& direction = directions_[static_cast<std::size_t>(d)];
  auto& vertex = region.vertex[static_cast<std::size_t>(direction.factor)];
  Vec3& first = vertex[static_cast<std::size_t>(direction.first)];
  Vec3& second = vertex[static_cast<std::size_t>(direction.second)];
  (keeps_first ? second : first) = 0.5 * (first + second).eval();
}

Vec3 SubdivisionTable::place(const Region& region, const CornerCoefficient& corner) const {
  Vec3 x = Vec3::Zero();
  for (std::size_t f = 0; f < factors_.size(); ++f) {
    x += region.vertex[f][static_cast<std::size_t>(corner.vertex[f])];
  }
  if (shape_ == Shape::pyramid) {
    x.x() *= 1.0 - x.z();
    x.y() *= 1.0 - x.z();
  }
  return x;
}

}  // namespace camber::detail
