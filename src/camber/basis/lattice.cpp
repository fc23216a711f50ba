#include <camber/basis/detail/cache.hpp>
#include <camber/basis/lattice.hpp>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>

namespace camber {
namespace {

void require_order(int p, int lowest) {
  if (p < lowest || p > k_max_lattice_order) {
    throw std::invalid_argument("order " + std::to_string(p) + " is outside " +
                                std::to_string(lowest) + ".." +
                                std::to_string(k_max_lattice_order));
  }
}

std::vector<LatticePoint> make_lattice(Shape shape, int p) {
  std::vector<LatticePoint> points;
  points.reserve(static_cast<std::size_t>(node_count(shape, p)));
  const int dim = dimension(shape);
  for (int k = 0; k <= (dim == 3 ? p : 0); ++k) {
    const bool layer_shrinks = shape == Shape::tetrahedron || shape == Shape::pyramid;
    const int layer = layer_shrinks ? p - k : p;
    const bool row_shrinks =
        shape == Shape::triangle || shape == Shape::tetrahedron || shape == Shape::prism;
    for (int j = 0; j <= (dim >= 2 ? layer : 0); ++j) {
      const int row = row_shrinks ? layer - j : layer;
      for (int i = 0; i <= (dim >= 1 ? row : 0); ++i) points.push_back({i, j, k});
    }
  }
  return points;
}

/// Lattice point of a corner: reference corners have coordinates 0 or 1.
LatticePoint corner_point(Shape shape, int p, int corner) {
  const Vec3& x = corners(shape)[static_cast<std::size_t>(corner)];
  return {p * static_cast<int>(x[0]), p * static_cast<int>(x[1]), p * static_cast<int>(x[2])};
}

/// origin + (u (a - origin) + v (b - origin)) / p; exact, since corners lie at multiples of p.
LatticePoint span_point(const LatticePoint& origin, const LatticePoint& a, const LatticePoint& b,
                        int u, int v, int p) {
  LatticePoint x{};
  for (std::size_t d = 0; d < 3; ++d) {
    x[d] = origin[d] + u * ((a[d] - origin[d]) / p) + v * ((b[d] - origin[d]) / p);
  }
  return x;
}

/// Nodes of (shape, p) at the lattice points of its face or edge with the given corners.
std::vector<int> sub_lattice(Shape shape, int p, Shape sub, std::span<const int> sub_corners) {
  const auto corner = [&](std::size_t c) { return corner_point(shape, p, sub_corners[c]); };
  const LatticePoint origin = corner(0);
  const LatticePoint a = corner(1);
  const LatticePoint b = sub == Shape::line ? origin : corner(sub == Shape::triangle ? 2 : 3);
  std::vector<int> nodes;
  for (const LatticePoint& n : lattice(sub, p)) {
    nodes.push_back(lattice_index(shape, p, span_point(origin, a, b, n[0], n[1], p)));
  }
  return nodes;
}

/// Nodes on none of the sub-entities of one dimension less.
std::vector<int> strictly_inside(Shape shape, int p, const LatticeMap& map) {
  std::vector<bool> on_boundary(static_cast<std::size_t>(node_count(shape, p)), false);
  const auto mark = [&](const std::vector<int>& nodes) {
    for (int n : nodes) on_boundary[static_cast<std::size_t>(n)] = true;
  };
  if (dimension(shape) <= 1) mark(map.corner);
  if (dimension(shape) == 2) std::for_each(map.edge.begin(), map.edge.end(), mark);
  if (dimension(shape) == 3) std::for_each(map.face.begin(), map.face.end(), mark);
  std::vector<int> inside;
  for (std::size_t n = 0; n < on_boundary.size(); ++n) {
    if (!on_boundary[n]) inside.push_back(static_cast<int>(n));
  }
  return inside;
}

LatticeMap make_lattice_map(Shape shape, int p) {
  LatticeMap map;
  for (int c = 0; c < corner_count(shape); ++c) {
    map.corner.push_back(lattice_index(shape, p, corner_point(shape, p, c)));
  }
  for (const std::array<int, 2>& edge : edges(shape)) {
    map.edge.push_back(sub_lattice(shape, p, Shape::line, edge));
    map.edge_interior.emplace_back(map.edge.back().begin() + 1, map.edge.back().end() - 1);
  }
  for (const LocalFace& face : faces(shape)) {
    map.face.push_back(sub_lattice(shape, p, face.shape, face.corners));
  }
  map.interior = strictly_inside(shape, p, map);
  for (std::size_t f = 0; f < map.face.size(); ++f) {
    const Shape face_shape = faces(shape)[f].shape;
    // A 2D shape is its own face: asking for its table here would not end.
    const std::span<const int> inside =
        face_shape == shape ? std::span<const int>(map.interior) : interior_nodes(face_shape, p);
    std::vector<int> nodes;
    for (int n : inside) nodes.push_back(map.face[f][static_cast<std::size_t>(n)]);
    map.face_interior.push_back(std::move(nodes));
  }
  return map;
}

}  // namespace

int node_count(Shape shape, int p) {
  require_order(p, 0);
  switch (shape) {
    case Shape::point:
      return 1;
    case Shape::line:
      return p + 1;
    case Shape::triangle:
      return (p + 1) * (p + 2) / 2;
    case Shape::quadrilateral:
      return (p + 1) * (p + 1);
    case Shape::tetrahedron:
      return (p + 1) * (p + 2) * (p + 3) / 6;
    case Shape::pyramid:
      return (p + 1) * (p + 2) * (2 * p + 3) / 6;
    case Shape::prism:
      return (p + 1) * (p + 1) * (p + 2) / 2;
    case Shape::hexahedron:
      return (p + 1) * (p + 1) * (p + 1);
  }
  throw std::invalid_argument("unknown shape");
}

std::span<const LatticePoint> lattice(Shape shape, int p) {
  static detail::Cache<std::vector<LatticePoint>, detail::k_fast_keys> cache;
  require_order(p, 0);
  return cache.get(detail::cache_key(shape, p), [&] { return make_lattice(shape, p); });
}

std::span<const Vec3> lattice_xi(Shape shape, int p) {
  static detail::Cache<Points, detail::k_fast_keys> cache;
  require_order(p, 0);
  return cache.get(detail::cache_key(shape, p), [&] {
    if (p == 0) return Points{reference_centroid(shape)};
    Points xi;
    for (const LatticePoint& n : lattice(shape, p)) {
      xi.emplace_back(Vec3(n[0], n[1], n[2]) / static_cast<double>(p));
    }
    return xi;
  });
}

int lattice_index(Shape shape, int p, const LatticePoint& point) {
  const auto [i, j, k] = point;
  const auto in_triangle = [](int order, int u, int v) {
    return v * (order + 1) - v * (v - 1) / 2 + u;
  };
  switch (shape) {
    case Shape::point:
      return 0;
    case Shape::line:
      return i;
    case Shape::triangle:
      return in_triangle(p, i, j);
    case Shape::quadrilateral:
      return j * (p + 1) + i;
    case Shape::tetrahedron:  // the layers from k on are a tetrahedron of order p - k
      return node_count(shape, p) - node_count(shape, p - k) + in_triangle(p - k, i, j);
    case Shape::pyramid:
      return node_count(shape, p) - node_count(shape, p - k) + j * (p - k + 1) + i;
    case Shape::prism:
      return k * node_count(Shape::triangle, p) + in_triangle(p, i, j);
    case Shape::hexahedron:
      return (k * (p + 1) + j) * (p + 1) + i;
  }
  throw std::invalid_argument("unknown shape");
}

const LatticeMap& lattice_map(Shape shape, int p) {
  static detail::Cache<LatticeMap, detail::k_fast_keys> cache;
  require_order(p, 1);
  return cache.get(detail::cache_key(shape, p), [&] { return make_lattice_map(shape, p); });
}

std::span<const int> interior_nodes(Shape shape, int q) { return lattice_map(shape, q).interior; }

std::vector<int> reorient(Shape shape, int p, std::span<const int> corner_of_a) {
  require_order(p, 1);
  const int n = corner_count(shape);
  const bool known =
      shape == Shape::line || shape == Shape::triangle || shape == Shape::quadrilateral;
  const bool permutes = known && std::ssize(corner_of_a) == n && [&] {
    std::vector<int> sorted(corner_of_a.begin(), corner_of_a.end());
    std::sort(sorted.begin(), sorted.end());
    for (int c = 0; c < n; ++c) {
      if (sorted[static_cast<std::size_t>(c)] != c) return false;
    }
    // Opposite corners of a quadrilateral stay opposite.
    return n < 4 || std::abs(corner_of_a[0] - corner_of_a[2]) == 2;
  }();
  if (!permutes) throw std::invalid_argument("not a symmetry of the " + std::string(name(shape)));
  return sub_lattice(shape, p, shape, corner_of_a);
}

}  // namespace camber
