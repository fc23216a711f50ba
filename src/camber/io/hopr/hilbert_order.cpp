#include <camber/io/hopr/hilbert_order.hpp>

#include <algorithm>
#include <bit>
#include <numeric>

namespace camber::io::hopr {
namespace {

constexpr unsigned k_axes = 3;

unsigned gray(unsigned w) { return w ^ (w >> 1); }
unsigned gray_inverse(unsigned g) { return g ^ (g >> 1) ^ (g >> 2); }

unsigned rotate_left(unsigned octant, unsigned by) {
  by %= k_axes;
  return ((octant << by) | (octant >> (k_axes - by))) & 7U;
}
unsigned rotate_right(unsigned octant, unsigned by) {
  return rotate_left(octant, k_axes - by % k_axes);
}

/// Corner by which the curve enters the w-th octant, and the axis along which it crosses it.
unsigned entry(unsigned w) { return w == 0 ? 0 : gray(2 * ((w - 1) / 2)); }
unsigned direction(unsigned w) {
  if (w == 0) return 0;
  return static_cast<unsigned>(std::countr_one(w % 2 == 0 ? w - 1 : w)) % k_axes;
}

}  // namespace

std::uint64_t hilbert_place(const std::array<std::uint32_t, 3>& cell, int bits) {
  std::uint64_t place = 0;
  unsigned at = 0, axis = 0;  // of the curve in the present octant: entry and direction
  for (int b = bits - 1; b >= 0; --b) {
    unsigned octant = 0;
    for (unsigned d = 0; d < k_axes; ++d) octant |= ((cell[d] >> b) & 1U) << d;
    const unsigned w = gray_inverse(rotate_right(octant ^ at, axis + 1));
    at ^= rotate_left(entry(w), axis + 1);
    axis = (axis + direction(w) + 1) % k_axes;
    place = place << k_axes | w;
  }
  return place;
}

std::vector<std::size_t> hilbert_order(const Points& points) {
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  if (points.empty()) return order;
  Vec3 low = points.front(), high = low;
  for (const Vec3& x : points) {
    low = low.cwiseMin(x);
    high = high.cwiseMax(x);
  }
  const double side = (high - low).maxCoeff();
  constexpr double k_cells = static_cast<double>(std::uint32_t{1} << k_hilbert_bits);
  std::vector<std::uint64_t> place;
  place.reserve(points.size());
  for (const Vec3& x : points) {
    std::array<std::uint32_t, 3> cell{};
    for (std::size_t d = 0; d < 3 && side > 0.0; ++d) {
      const auto i = static_cast<Eigen::Index>(d);
      const double t = (x[i] - low[i]) / side * k_cells;
      cell[d] = static_cast<std::uint32_t>(std::clamp(t, 0.0, k_cells - 1.0));
    }
    place.push_back(hilbert_place(cell, k_hilbert_bits));
  }
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return place[a] < place[b]; });
  return order;
}

}  // namespace camber::io::hopr
