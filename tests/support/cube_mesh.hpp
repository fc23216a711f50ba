#pragma once
// The unit cube filled with any of the four volume shapes, numbered and turned at random, for
// tests.
#include <camber/mesh/linear_mesh.hpp>
#include <camber/mesh/topology.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <random>
#include <utility>
#include <vector>

namespace camber::testing {

enum class Filling { tets, pyramids_and_tets, prisms, hexes, hybrid };

inline constexpr std::array<Filling, 5> k_fillings{
    Filling::tets, Filling::pyramids_and_tets, Filling::prisms, Filling::hexes, Filling::hybrid};

/// The same corners in another valid order: result[i] = corners[turn[i]], drawn from all rotations
/// of the shape onto itself (tet 12, pyramid 4, prism 6, hex 24).
inline std::vector<Index> turned(Shape shape, std::vector<Index> corners, std::mt19937& random) {
  using Turn = std::vector<std::size_t>;
  static const std::map<Shape, std::array<Turn, 2>> generators{
      {Shape::tetrahedron, {Turn{1, 2, 0, 3}, Turn{1, 0, 3, 2}}},
      {Shape::pyramid, {Turn{1, 2, 3, 0, 4}, Turn{1, 2, 3, 0, 4}}},
      {Shape::prism, {Turn{1, 2, 0, 4, 5, 3}, Turn{3, 5, 4, 0, 2, 1}}},
      {Shape::hexahedron, {Turn{1, 2, 3, 0, 5, 6, 7, 4}, Turn{3, 2, 6, 7, 0, 1, 5, 4}}}};
  for (int step = 0; step < 12; ++step) {
    const std::vector<Index> before = corners;
    const Turn& turn = generators.at(shape)[random() % 2];
    for (std::size_t i = 0; i < turn.size(); ++i) corners[i] = before[turn[i]];
  }
  return corners;
}

/// Fills the cube cell by cell of an n x n x n lattice. Columns along z hold hexes, prisms (cut by
/// the diagonal through their lowest lattice vertex) or cells cut from their centre: a pyramid on a
/// whole face, two tets on a face that is cut. Sides are surfaces 1..6 (x=0, x=1, y=0, ...), the
/// twelve edges curves 1..12 and all cells region 1.
class CubeMesh {
 public:
  CubeMesh(Filling filling, int n, unsigned seed) : filling_(filling), n_(n), random_(seed) {
    number_vertices();
    for (int k = 0; k < n; ++k) {
      for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) fill({i, j, k});
      }
    }
    for (int axis = 0; axis < 3; ++axis) add_sides(axis);
    add_lines();
    data_.source = "cube";
    for (auto& [key, block] : blocks_) data_.blocks.push_back(std::move(block));
  }
  [[nodiscard]] MeshData take() { return std::move(data_); }

 private:
  using Place = std::array<int, 3>;
  enum class Column { hex, prism, centre };

  void number_vertices() {
    const int corners = (n_ + 1) * (n_ + 1) * (n_ + 1);
    std::vector<Index> number(static_cast<std::size_t>(corners + n_ * n_ * n_));
    std::iota(number.begin(), number.end(), 0);
    std::shuffle(number.begin(), number.end(), random_);
    lattice_.assign(number.begin(), number.begin() + corners);
    centre_.assign(number.begin() + corners, number.end());
    data_.points.resize(number.size(), Vec3::Zero());
    for (int k = 0; k <= n_; ++k) {
      for (int j = 0; j <= n_; ++j) {
        for (int i = 0; i <= n_; ++i) data_.points[at(vertex({i, j, k}))] = Vec3(i, j, k) / n_;
      }
    }
    for (std::size_t i = 0; i < number.size(); ++i) {
      data_.point_tags.push_back(static_cast<GlobalId>(3 * i + 5));
    }
  }

  [[nodiscard]] Index vertex(const Place& p) const {
    return lattice_[static_cast<std::size_t>(p[0] + (n_ + 1) * (p[1] + (n_ + 1) * p[2]))];
  }

  [[nodiscard]] Column column(const Place& p) const {
    if (filling_ == Filling::hexes) return Column::hex;
    if (filling_ == Filling::prisms) return Column::prism;
    if (filling_ != Filling::hybrid) return Column::centre;
    const int kind = (p[0] + 2 * p[1]) % 4;
    return kind == 0 ? Column::hex : kind == 1 ? Column::prism : Column::centre;
  }

  /// Whether the face across `axis` at its lower corner `p` is cut into two triangles.
  [[nodiscard]] bool is_cut(int axis, const Place& p) const {
    const auto a = static_cast<std::size_t>(axis);
    Place below = p;
    --below[a];
    for (const Place& side : {p, below}) {
      if (side[a] < 0 || side[a] >= n_ || column(side) == Column::centre) continue;
      return column(side) == Column::prism && axis == 2;
    }
    if (filling_ == Filling::tets) return true;
    return (axis + p[0] + p[1] + p[2]) % 2 == 1;
  }

  /// Corners of the face across `axis`, counter-clockwise about +axis, lowest vertex first.
  [[nodiscard]] std::array<Index, 4> face(int axis, const Place& p) const {
    const auto u = static_cast<std::size_t>((axis + 1) % 3),
               v = static_cast<std::size_t>((axis + 2) % 3);
    Place b = p, c = p, d = p;
    ++b[u];
    ++c[u];
    ++c[v];
    ++d[v];
    return {vertex(p), vertex(b), vertex(c), vertex(d)};
  }

  void fill(const Place& p) {
    Place top = p;
    ++top[2];
    const std::array<Index, 4> a = face(2, p), b = face(2, top);
    switch (column(p)) {
      case Column::hex:
        add(Shape::hexahedron, {a[0], a[1], a[2], a[3], b[0], b[1], b[2], b[3]});
        return;
      case Column::prism:
        add(Shape::prism, {a[0], a[1], a[2], b[0], b[1], b[2]});
        add(Shape::prism, {a[0], a[2], a[3], b[0], b[2], b[3]});
        return;
      case Column::centre:
        fill_from_centre(p);
    }
  }

  void fill_from_centre(const Place& p) {
    const Index apex = centre_[static_cast<std::size_t>(p[0] + n_ * (p[1] + n_ * p[2]))];
    data_.points[at(apex)] = (Vec3(p[0], p[1], p[2]) + Vec3::Constant(0.5)) / n_;
    for (int axis = 0; axis < 3; ++axis) {
      for (int side : {0, 1}) {
        Place low = p;
        low[static_cast<std::size_t>(axis)] += side;
        std::array<Index, 4> f = face(axis, low);
        if (side == 1) std::swap(f[1], f[3]);  // its normal now points to the centre
        if (is_cut(axis, low)) {
          add(Shape::tetrahedron, {f[0], f[1], f[2], apex});
          add(Shape::tetrahedron, {f[0], f[2], f[3], apex});
        } else {
          add(Shape::pyramid, {f[0], f[1], f[2], f[3], apex});
        }
      }
    }
  }

  void add(Shape shape, std::vector<Index> corners) {
    if (dimension(shape) == 3) corners = turned(shape, std::move(corners), random_);
    append(shape, 1, corners);
  }

  void append(Shape shape, int entity, const std::vector<Index>& corners) {
    ElementBlock& block =
        blocks_.try_emplace({shape, entity}, ElementBlock{shape, 1, entity, {}, {}}).first->second;
    const std::size_t first = block.nodes.size();
    block.nodes.resize(first + corners.size());
    const std::vector<int>& place = lattice_map(shape, 1).corner;
    for (std::size_t i = 0; i < corners.size(); ++i) {
      block.nodes[first + static_cast<std::size_t>(place[i])] = corners[i];
    }
    block.tags.push_back(next_tag_++);
  }

  /// Surface elements start at any corner and go either way round.
  void append_surface(int entity, std::vector<Index> corners) {
    std::rotate(corners.begin(),
                corners.begin() + static_cast<std::ptrdiff_t>(random_() % corners.size()),
                corners.end());
    if (random_() % 2 == 0) std::reverse(corners.begin(), corners.end());
    append(corners.size() == 3 ? Shape::triangle : Shape::quadrilateral, entity, corners);
  }

  void add_sides(int axis) {
    for (int side : {0, 1}) {
      for (int v = 0; v < n_; ++v) {
        for (int u = 0; u < n_; ++u) {
          Place p{};
          p[static_cast<std::size_t>(axis)] = side * n_;
          p[static_cast<std::size_t>((axis + 1) % 3)] = u;
          p[static_cast<std::size_t>((axis + 2) % 3)] = v;
          const std::array<Index, 4> f = face(axis, p);
          const int entity = 2 * axis + side + 1;
          if (is_cut(axis, p)) {
            append_surface(entity, {f[0], f[1], f[2]});
            append_surface(entity, {f[0], f[2], f[3]});
          } else {
            append_surface(entity, {f[0], f[1], f[2], f[3]});
          }
        }
      }
    }
  }

  void add_lines() {
    int curve = 0;
    for (int axis = 0; axis < 3; ++axis) {
      for (int corner = 0; corner < 4; ++corner) {
        ++curve;
        for (int i = 0; i < n_; ++i) {
          Place a{};
          a[static_cast<std::size_t>(axis)] = i;
          a[static_cast<std::size_t>((axis + 1) % 3)] = corner % 2 * n_;
          a[static_cast<std::size_t>((axis + 2) % 3)] = corner / 2 * n_;
          Place b = a;
          ++b[static_cast<std::size_t>(axis)];
          std::vector<Index> ends{vertex(a), vertex(b)};
          if (random_() % 2 == 0) std::swap(ends[0], ends[1]);
          append(Shape::line, curve, ends);
        }
      }
    }
  }

  Filling filling_;
  int n_;
  std::mt19937 random_;
  std::vector<Index> lattice_, centre_;
  std::map<std::pair<Shape, int>, ElementBlock> blocks_;
  GlobalId next_tag_ = 100;
  MeshData data_;
};

inline MeshData cube_mesh(Filling filling, int n, unsigned seed) {
  return CubeMesh(filling, n, seed).take();
}

/// Moves all points by a map.
inline void transform(MeshData& data, const std::function<Vec3(const Vec3&)>& map) {
  for (Vec3& x : data.points) x = map(x);
}

/// A random affine map of positive determinant, near a rotation.
inline std::function<Vec3(const Vec3&)> random_affine(std::mt19937& random) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  const Vec3 axis = Vec3(uniform(random), uniform(random), 1.5).normalized();
  Mat3 A = Eigen::AngleAxisd(3.0 * uniform(random), axis).toRotationMatrix();
  for (int i = 0; i < 3; ++i) {
    for (int j = 0; j < 3; ++j) A(i, j) += 0.1 * uniform(random);
  }
  const Vec3 b(uniform(random), uniform(random), uniform(random));
  return [A, b](const Vec3& x) { return Vec3(A * x + b); };
}

/// A smooth map that is no polynomial; keeps the cells of the cube valid.
inline Vec3 warp(const Vec3& x) {
  return x + 0.06 * Vec3(std::sin(2.0 * x.y() + x.z()), std::cos(1.5 * x.x() - x.z()),
                         std::sin(x.x() + 0.7 * x.y()));
}

/// One order a cell, 1..highest, at random.
inline std::vector<std::uint8_t> random_orders(std::size_t cells, int highest,
                                               std::mt19937& random) {
  std::vector<std::uint8_t> orders(cells);
  for (std::uint8_t& p : orders)
    p = static_cast<std::uint8_t>(1 + random() % static_cast<unsigned>(highest));
  return orders;
}

}  // namespace camber::testing
