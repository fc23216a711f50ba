#include <camber/basis/lattice.hpp>
#include <camber/io/detail/prism_direction.hpp>

#include <algorithm>
#include <vector>

namespace camber::io {

bool is_mirrored_prism(const Points& points, int order, std::span<const Index> nodes) {
  const std::vector<int>& corner = lattice_map(Shape::prism, order).corner;
  const auto x = [&](std::size_t i) -> const Vec3& {
    return points[at(nodes[static_cast<std::size_t>(corner[i])])];
  };
  const Vec3 up = x(3) + x(4) + x(5) - x(0) - x(1) - x(2);
  return Vec3(x(1) - x(0)).cross(Vec3(x(2) - x(0))).dot(up) < 0.0;
}

void mirror_prism(int order, std::span<Index> nodes) {
  const std::vector<Index> before(nodes.begin(), nodes.end());
  const std::span<const LatticePoint> points = lattice(Shape::prism, order);
  for (std::size_t n = 0; n < before.size(); ++n) {
    const LatticePoint& l = points[n];
    nodes[static_cast<std::size_t>(lattice_index(Shape::prism, order, {l[1], l[0], l[2]}))] =
        before[n];
  }
}

}  // namespace camber::io
