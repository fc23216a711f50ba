#include <camber/basis/detail/cache.hpp>
#include <camber/basis/node_order.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <string_view>

namespace camber {
namespace {

/// Edges and faces of a volume shape in a convention's order, by corner numbers; edges are walked
/// from the first corner to the second, faces have the axes corner 0 -> 1 and corner 0 -> last.
struct Walk {
  std::string_view edges, faces;
};

Walk walk_of(NodeConvention convention, Shape shape) {
  const bool gmsh = convention == NodeConvention::gmsh;
  const bool vtk = convention == NodeConvention::vtk;
  switch (shape) {
    case Shape::point:
      return {"", ""};
    case Shape::line:
      return {"01", ""};
    case Shape::triangle:
      return {"01 12 20", ""};
    case Shape::quadrilateral:
      if (vtk) return {"01 12 32 03", ""};
      return {"01 12 23 30", ""};
    case Shape::tetrahedron:
      if (gmsh) return {"01 12 20 30 32 31", "021 013 032 312"};
      if (vtk) return {"01 12 20 03 13 23", "013 231 032 021"};
      return {"01 12 20 03 13 23", "012 013 123 203"};
    case Shape::pyramid:
      if (gmsh) return {"01 03 04 12 14 23 24 34", "014 304 124 234 0321"};
      return {"01 12 23 30 04 14 24 34", "0123 014 124 234 304"};
    case Shape::prism:
      if (gmsh) return {"01 02 03 12 14 25 34 35 45", "021 345 0143 0352 1254"};
      if (vtk) return {"01 12 20 34 45 53 03 14 25", "012 345 0143 1254 2035"};
      return {"01 12 20 03 14 25 34 45 53", "012 0143 1254 2035 345"};
    case Shape::hexahedron:
      if (gmsh) return {"01 03 04 12 15 23 26 37 45 47 56 67", "0321 0154 0473 1265 2376 4567"};
      if (vtk) return {"01 12 32 03 45 56 76 47 04 15 26 37", "0374 1265 0154 3267 0123 4567"};
      return {"01 12 23 30 04 15 26 37 45 56 67 74", "0123 0154 1265 2376 3047 4567"};
  }
  throw std::invalid_argument("unknown shape");
}

using Order = std::vector<LatticePoint>;

LatticePoint operator+(const LatticePoint& a, const LatticePoint& b) {
  return {a[0] + b[0], a[1] + b[1], a[2] + b[2]};
}

/// The square of n intervals a side as rings from the outside in, each walked once round from its
/// corner 0 (CGNS).
void append_rings(int n, LatticePoint at, Order& order) {
  for (; n >= 0; n -= 2, at = at + LatticePoint{1, 1, 0}) {
    if (n == 0) order.push_back(at);
    for (int i = 0; i < n; ++i) order.push_back(at + LatticePoint{i, 0, 0});
    for (int i = 0; i < n; ++i) order.push_back(at + LatticePoint{n, i, 0});
    for (int i = 0; i < n; ++i) order.push_back(at + LatticePoint{n - i, n, 0});
    for (int i = 0; i < n; ++i) order.push_back(at + LatticePoint{0, n - i, 0});
  }
}

/// The square of n intervals a side row by row (VTK).
void append_rows(int n, const LatticePoint& at, Order& order) {
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i) order.push_back(at + LatticePoint{i, j, 0});
  }
}

/// The points strictly inside the triangle of order p row by row: VTK's wedge, which differs here
/// from VTK's triangle for p >= 5.
void append_triangle_rows(int p, const LatticePoint& at, Order& order) {
  for (int j = 1; j < p; ++j) {
    for (int i = 1; i + j < p; ++i) order.push_back(at + LatticePoint{i, j, 0});
  }
}

/// Appends the lattice of (shape, p), moved by `at`, in the convention's order.
void append_element(NodeConvention convention, Shape shape, int p, const LatticePoint& at,
                    Order& order);

/// Appends the points strictly inside (shape, p), moved by `at`.
void append_interior(NodeConvention convention, Shape shape, int p, const LatticePoint& at,
                     Order& order) {
  const bool gmsh = convention == NodeConvention::gmsh;
  const bool cgns = convention == NodeConvention::cgns;
  const auto layer = [&](int k, Shape base, int order_of_layer) {
    append_interior(convention, base, order_of_layer, at + LatticePoint{0, 0, k}, order);
  };
  switch (shape) {
    case Shape::point:
    case Shape::line:
      return;  // a line's inner nodes are those of its edge
    case Shape::triangle:
      return append_element(convention, shape, p - 3, at + LatticePoint{1, 1, 0}, order);
    case Shape::quadrilateral: {
      const LatticePoint first = at + LatticePoint{1, 1, 0};
      if (gmsh) return append_element(convention, shape, p - 2, first, order);
      return cgns ? append_rings(p - 2, first, order) : append_rows(p - 2, first, order);
    }
    case Shape::tetrahedron:
      return append_element(convention, shape, p - 4, at + LatticePoint{1, 1, 1}, order);
    case Shape::pyramid:
      if (gmsh) return append_element(convention, shape, p - 3, at + LatticePoint{1, 1, 1}, order);
      for (int k = 1; k <= p - 2; ++k) layer(k, Shape::quadrilateral, p - k);
      return;
    case Shape::prism:
      if (gmsh) {  // the triangle's points, each with its line
        Order triangle, line;
        append_interior(convention, Shape::triangle, p, at, triangle);
        append_element(convention, Shape::line, p - 2, {0, 0, 0}, line);
        for (const LatticePoint& t : triangle) {
          for (const LatticePoint& l : line) order.push_back(t + LatticePoint{0, 0, 1 + l[0]});
        }
        return;
      }
      for (int k = 1; k <= p - 1; ++k) {
        if (cgns) {
          layer(k, Shape::triangle, p);
        } else {
          append_triangle_rows(p, at + LatticePoint{0, 0, k}, order);
        }
      }
      return;
    case Shape::hexahedron:
      if (gmsh) return append_element(convention, shape, p - 2, at + LatticePoint{1, 1, 1}, order);
      for (int k = 1; k <= p - 1; ++k) layer(k, Shape::quadrilateral, p);
      return;
  }
}

void append_element(NodeConvention convention, Shape shape, int p, const LatticePoint& at,
                    Order& order) {
  if (p < 0) return;
  if (p == 0) return order.push_back(at);
  std::vector<LatticePoint> corner;  // of the unit element
  for (const Vec3& x : corners(shape)) {
    corner.push_back({static_cast<int>(x[0]), static_cast<int>(x[1]), static_cast<int>(x[2])});
  }
  const auto corner_number = [](char digit) { return static_cast<std::size_t>(digit - '0'); };
  // at + p * corner a + u * (corner b - corner a) + v * (corner c - corner a)
  const auto place = [&](std::size_t a, std::size_t b, std::size_t c, int u, int v) {
    LatticePoint x = at;
    for (std::size_t d = 0; d < 3; ++d) {
      x[d] +=
          p * corner[a][d] + u * (corner[b][d] - corner[a][d]) + v * (corner[c][d] - corner[a][d]);
    }
    return x;
  };
  for (std::size_t c = 0; c < corner.size(); ++c) order.push_back(place(c, c, c, 0, 0));
  const Walk walk = walk_of(convention, shape);
  for (std::size_t e = 0; e < walk.edges.size(); e += 3) {
    const std::size_t a = corner_number(walk.edges[e]), b = corner_number(walk.edges[e + 1]);
    for (int i = 1; i < p; ++i) order.push_back(place(a, b, a, i, 0));
  }
  for (std::size_t f = 0; f < walk.faces.size();) {
    const std::size_t size = std::min(walk.faces.find(' ', f), walk.faces.size()) - f;
    const std::size_t a = corner_number(walk.faces[f]), b = corner_number(walk.faces[f + 1]),
                      c = corner_number(walk.faces[f + size - 1]);
    Order inside;
    if (convention == NodeConvention::vtk && shape == Shape::prism && size == 3) {
      append_triangle_rows(p, {0, 0, 0}, inside);
    } else {
      append_interior(convention, size == 3 ? Shape::triangle : Shape::quadrilateral, p, {0, 0, 0},
                      inside);
    }
    for (const LatticePoint& n : inside) order.push_back(place(a, b, c, n[0], n[1]));
    f += size + 1;
  }
  append_interior(convention, shape, p, at, order);
}

Order make_order(NodeConvention convention, Shape shape, int p) {
  if (convention == NodeConvention::su2 && p >= 2) {
    const auto canonical = lattice(shape, p);
    return {canonical.begin(), canonical.end()};
  }
  Order order;
  append_element(convention, shape, p, {0, 0, 0}, order);
  return order;
}

constexpr int k_conventions = 4;
constexpr std::size_t k_fast_orders = static_cast<std::size_t>(k_shape_count * k_conventions) * 16;

std::size_t key(NodeConvention convention, Shape shape, int p) {
  return detail::cache_key(shape, p * k_conventions + static_cast<int>(convention));
}

void require_known(NodeConvention convention, Shape shape, int p) {
  if (p < 1 || p > k_max_lattice_order) {
    throw std::invalid_argument("no node order for elements of order " + std::to_string(p));
  }
  if (convention == NodeConvention::vtk && shape == Shape::pyramid && p > 1) {
    throw std::invalid_argument("VTK has no Lagrange pyramid");
  }
}

}  // namespace

std::span<const LatticePoint> node_order(NodeConvention convention, Shape shape, int p) {
  static detail::Cache<Order, k_fast_orders> cache;
  require_known(convention, shape, p);
  return cache.get(key(convention, shape, p), [&] { return make_order(convention, shape, p); });
}

std::span<const int> file_to_canonical(NodeConvention convention, Shape shape, int p) {
  static detail::Cache<std::vector<int>, k_fast_orders> cache;
  require_known(convention, shape, p);
  return cache.get(key(convention, shape, p), [&] {
    std::vector<int> map;
    for (const LatticePoint& n : node_order(convention, shape, p)) {
      map.push_back(lattice_index(shape, p, n));
    }
    return map;
  });
}

}  // namespace camber
