#include <camber/io/mfem/mfem_nodes.hpp>

#include <cmath>
#include <stdexcept>
#include <utility>

namespace camber::io::mfem {
namespace {

using Edge = std::array<int, 2>;
using Face = std::array<int, 4>;  // [3] is -1 for a triangle

constexpr std::array k_triangle_edges{Edge{0, 1}, Edge{1, 2}, Edge{2, 0}};
constexpr std::array k_square_edges{Edge{0, 1}, Edge{1, 2}, Edge{2, 3}, Edge{3, 0}};
constexpr std::array k_tet_edges{Edge{0, 1}, Edge{0, 2}, Edge{0, 3},
                                 Edge{1, 2}, Edge{1, 3}, Edge{2, 3}};
constexpr std::array k_pyramid_edges{Edge{0, 1}, Edge{1, 2}, Edge{3, 2}, Edge{0, 3},
                                     Edge{0, 4}, Edge{1, 4}, Edge{2, 4}, Edge{3, 4}};
constexpr std::array k_prism_edges{Edge{0, 1}, Edge{1, 2}, Edge{2, 0}, Edge{3, 4}, Edge{4, 5},
                                   Edge{5, 3}, Edge{0, 3}, Edge{1, 4}, Edge{2, 5}};
constexpr std::array k_hex_edges{Edge{0, 1}, Edge{1, 2}, Edge{3, 2}, Edge{0, 3},
                                 Edge{4, 5}, Edge{5, 6}, Edge{7, 6}, Edge{4, 7},
                                 Edge{0, 4}, Edge{1, 5}, Edge{2, 6}, Edge{3, 7}};

constexpr std::array<Face, 1> k_triangle_faces{Face{0, 1, 2, -1}};
constexpr std::array<Face, 1> k_square_faces{Face{0, 1, 2, 3}};
constexpr std::array k_tet_faces{Face{1, 2, 3, -1}, Face{0, 3, 2, -1}, Face{0, 1, 3, -1},
                                 Face{0, 2, 1, -1}};
constexpr std::array k_pyramid_faces{Face{3, 2, 1, 0}, Face{0, 1, 4, -1}, Face{1, 2, 4, -1},
                                     Face{2, 3, 4, -1}, Face{3, 0, 4, -1}};
constexpr std::array k_prism_faces{Face{0, 2, 1, -1}, Face{3, 4, 5, -1}, Face{0, 1, 4, 3},
                                   Face{1, 2, 5, 4}, Face{2, 0, 3, 5}};
constexpr std::array k_hex_faces{Face{3, 2, 1, 0}, Face{0, 1, 5, 4}, Face{1, 2, 6, 5},
                                 Face{2, 3, 7, 6}, Face{3, 0, 4, 7}, Face{4, 5, 6, 7}};

std::span<const Edge> edges_of(Shape shape) {
  switch (shape) {
    case Shape::triangle:
      return k_triangle_edges;
    case Shape::quadrilateral:
      return k_square_edges;
    case Shape::tetrahedron:
      return k_tet_edges;
    case Shape::pyramid:
      return k_pyramid_edges;
    case Shape::prism:
      return k_prism_edges;
    default:
      return k_hex_edges;
  }
}

std::span<const Face> faces_of(Shape shape) {
  switch (shape) {
    case Shape::triangle:
      return k_triangle_faces;
    case Shape::quadrilateral:
      return k_square_faces;
    case Shape::tetrahedron:
      return k_tet_faces;
    case Shape::pyramid:
      return k_pyramid_faces;
    case Shape::prism:
      return k_prism_faces;
    default:
      return k_hex_faces;
  }
}

/// Gauss-Lobatto points on [0,1]: zeros of x (1 - x) P_p'(2 x - 1), in closed form for p <= 4.
std::vector<double> gauss_lobatto(int p) {
  if (p == 1) return {0.0, 1.0};
  if (p == 2) return {0.0, 0.5, 1.0};
  const double half = p == 3 ? 0.5 / std::sqrt(5.0) : 0.5 * std::sqrt(3.0 / 7.0);
  if (p == 3) return {0.0, 0.5 - half, 0.5 + half, 1.0};
  return {0.0, 0.5 - half, 0.5, 0.5 + half, 1.0};
}

class Builder {
 public:
  Builder(Shape shape, int p) : shape_(shape), p_(p), x_(gauss_lobatto(p)) {}

  ElementNodes run() {
    for (int c = 0; c < corner_count(shape_); ++c) {
      begin(0, Shape::point, {c});
      put(corner(c));
      end();
    }
    for (const auto& [a, b] : edges_of(shape_)) {
      begin(1, Shape::line, {a, b});
      for (int i = 1; i < p_; ++i) put(x(p_ - i) * corner(a) + x(i) * corner(b));
      end();
    }
    for (const Face& face : faces_of(shape_)) add_face(face);
    if (dimension(shape_) == 3) {
      begin(3, shape_, {});
      add_interior();
      end();
    }
    return std::move(nodes_);
  }

 private:
  [[nodiscard]] double x(int i) const { return x_[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Vec3 corner(int c) const { return corners(shape_)[static_cast<std::size_t>(c)]; }
  void put(const Vec3& xi) { nodes_.xi.push_back(xi); }
  void begin(int dim, Shape shape, std::array<int, 4> corners) {
    nodes_.groups.push_back({dim, corners, nodes_.xi.size(), 0, shape});
  }
  void end() { nodes_.groups.back().count = nodes_.xi.size() - nodes_.groups.back().first; }

  /// Weights of the corners of a triangle at its node (i, j).
  [[nodiscard]] Vec3 triangle_weights(int i, int j) const {
    const Vec3 raw(x(p_ - i - j), x(i), x(j));
    return raw / raw.sum();
  }

  void add_face(const Face& f) {
    const bool is_triangle = f[3] < 0;
    begin(2, is_triangle ? Shape::triangle : Shape::quadrilateral, f);
    for (int j = 1; j < p_; ++j) {
      for (int i = 1; i < (is_triangle ? p_ - j : p_); ++i) {
        if (is_triangle) {
          const Vec3 w = triangle_weights(i, j);
          put(w[0] * corner(f[0]) + w[1] * corner(f[1]) + w[2] * corner(f[2]));
        } else {  // a parallelogram in the reference element
          put(corner(f[0]) + x(i) * (corner(f[1]) - corner(f[0])) +
              x(j) * (corner(f[3]) - corner(f[0])));
        }
      }
    }
    end();
  }

  void add_interior() {
    for (int k = 1; k < p_; ++k) {
      for (int j = 1; j < p_; ++j) {
        for (int i = 1; i < p_; ++i) add_inner(i, j, k);
      }
    }
  }

  void add_inner(int i, int j, int k) {
    if (shape_ == Shape::hexahedron) put(Vec3(x(i), x(j), x(k)));
    if (shape_ == Shape::pyramid) {
      put(Vec3(x(i) * (1.0 - x(k)), x(j) * (1.0 - x(k)), x(k)));
    }
    if (shape_ == Shape::prism && i + j < p_) {
      const Vec3 w = triangle_weights(i, j);
      put(Vec3(w[1], w[2], x(k)));
    }
    if (shape_ == Shape::tetrahedron && i + j + k < p_) {
      put(Vec3(x(i), x(j), x(k)) / (x(i) + x(j) + x(k) + x(p_ - i - j - k)));
    }
  }

  Shape shape_;
  int p_;
  std::vector<double> x_;
  ElementNodes nodes_;
};

}  // namespace

const ElementNodes& element_nodes(Shape shape, int p) {
  if (p < 1 || p > k_max_order || dimension(shape) < 2) {
    throw std::invalid_argument("faces and cells of order 1 to 4 expected");
  }
  static const auto k_all = [] {
    std::array<std::array<ElementNodes, k_max_order + 1>, k_shape_count> all;
    for (int s = static_cast<int>(Shape::triangle); s < k_shape_count; ++s) {
      for (int q = 1; q <= k_max_order; ++q) {
        all[static_cast<std::size_t>(s)][static_cast<std::size_t>(q)] =
            Builder(static_cast<Shape>(s), q).run();
      }
    }
    return all;
  }();
  return k_all[static_cast<std::size_t>(shape)][static_cast<std::size_t>(p)];
}

int geometry_type(Shape shape) {
  switch (shape) {
    case Shape::triangle:
      return 2;
    case Shape::quadrilateral:
      return 3;
    case Shape::tetrahedron:
      return 4;
    case Shape::hexahedron:
      return 5;
    case Shape::prism:
      return 6;
    default:
      return 7;  // pyramid
  }
}

}  // namespace camber::io::mfem
