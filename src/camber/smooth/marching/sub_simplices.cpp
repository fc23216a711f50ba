#include <camber/smooth/marching/sub_simplices.hpp>

#include <mutex>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace camber {
namespace {

class Cutter {
 public:
  Cutter(Shape shape, int p) : shape_(shape), p_(p) {}

  std::vector<SubSimplex> run() {
    switch (shape_) {
      case Shape::triangle:
        for_each_triangle([&](const std::array<LatticePoint, 3>& t) { add(t); });
        break;
      case Shape::quadrilateral:
        cut_grid(1, Shape::quadrilateral);
        break;
      case Shape::tetrahedron:
        cut_tetrahedron();
        break;
      case Shape::pyramid:
        cut_pyramid();
        break;
      case Shape::prism:
        cut_prism();
        break;
      case Shape::hexahedron:
        cut_grid(p_, Shape::hexahedron);
        break;
      case Shape::point:
      case Shape::line:
        break;
    }
    return std::move(result_);
  }

 private:
  template <std::size_t n>
  void add(const std::array<LatticePoint, n>& points) {
    static_assert(n == 3 || n == 4);
    SubSimplex s{-1, -1, -1, -1};
    Mat3 edges = Mat3::Identity();
    for (std::size_t i = 0; i < n; ++i) {
      s[i] = lattice_index(shape_, p_, points[i]);
      if (i == 0) continue;
      for (std::size_t d = 0; d < 3; ++d) {
        if (d + 1 < n) {
          edges(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(i - 1)) =
              points[i][d] - points[0][d];
        }
      }
    }
    if (edges.determinant() < 0.0) std::swap(s[1], s[2]);
    result_.push_back(s);
  }

  /// Every corner of a small element that has three edges (two in the plane), with its neighbours.
  void add_corners(Shape small, const std::vector<LatticePoint>& corner) {
    for (int c = 0; c < corner_count(small); ++c) {
      std::vector<LatticePoint> points{corner[static_cast<std::size_t>(c)]};
      for (const auto& [a, b] : edges(small)) {
        if (a == c) points.push_back(corner[static_cast<std::size_t>(b)]);
        if (b == c) points.push_back(corner[static_cast<std::size_t>(a)]);
      }
      if (points.size() == 3) add(std::array{points[0], points[1], points[2]});
      if (points.size() == 4) add(std::array{points[0], points[1], points[2], points[3]});
    }
  }

  void cut_grid(int layers, Shape small) {
    for (int k = 0; k < layers; ++k) {
      for (int j = 0; j < p_; ++j) {
        for (int i = 0; i < p_; ++i) {
          std::vector<LatticePoint> corner;
          for (const Vec3& x : corners(small)) corner.push_back(moved({i, j, k}, x));
          add_corners(small, corner);
        }
      }
    }
  }

  static LatticePoint moved(const LatticePoint& a, const Vec3& x) {
    return {a[0] + static_cast<int>(x.x()), a[1] + static_cast<int>(x.y()),
            a[2] + static_cast<int>(x.z())};
  }

  template <class Take>
  void for_each_triangle(const Take& take) {
    for (int j = 0; j < p_; ++j) {
      for (int i = 0; i + j < p_; ++i) {
        take({LatticePoint{i, j, 0}, {i + 1, j, 0}, {i, j + 1, 0}});
        if (i + j + 2 <= p_) take({LatticePoint{i + 1, j, 0}, {i + 1, j + 1, 0}, {i, j + 1, 0}});
      }
    }
  }

  void cut_prism() {
    for (int k = 0; k < p_; ++k) {
      for_each_triangle([&](const std::array<LatticePoint, 3>& t) {
        std::vector<LatticePoint> corner;
        for (int level : {k, k + 1}) {
          for (const LatticePoint& x : t) corner.push_back({x[0], x[1], level});
        }
        add_corners(Shape::prism, corner);
      });
    }
  }

  void cut_tetrahedron() {
    for (int k = 0; k < p_; ++k) {
      for (int j = 0; j + k < p_; ++j) {
        for (int i = 0; i + j + k < p_; ++i) {
          const LatticePoint x{i + 1, j, k}, y{i, j + 1, k}, z{i, j, k + 1};
          add(std::array{LatticePoint{i, j, k}, x, y, z});
          if (i + j + k + 2 > p_) continue;
          const LatticePoint xy{i + 1, j + 1, k}, yz{i, j + 1, k + 1}, xz{i + 1, j, k + 1};
          // The octahedron of these six, around the diagonal from y to xz.
          for (const auto& [a, b] : {std::pair(x, xy), {xy, yz}, {yz, z}, {z, x}}) {
            add(std::array{y, xz, a, b});
          }
          if (i + j + k + 3 <= p_) add(std::array{xy, yz, xz, LatticePoint{i + 1, j + 1, k + 1}});
        }
      }
    }
  }

  /// Layer k has i, j <= p - k; its point (i, j) lies under the middle of (i-1..i, j-1..j) above.
  void cut_pyramid() {
    for (int k = 0; k < p_; ++k) {
      const int m = p_ - k;
      for (int j = 0; j < m; ++j) {
        for (int i = 0; i < m; ++i) {
          add_corners(Shape::pyramid,
                      {{i, j, k}, {i + 1, j, k}, {i + 1, j + 1, k}, {i, j + 1, k}, {i, j, k + 1}});
        }
      }
      for (int j = 0; j + 1 < m; ++j) {
        for (int i = 0; i + 1 < m; ++i) {
          add_corners(Shape::pyramid, {{i, j, k + 1},
                                       {i + 1, j, k + 1},
                                       {i + 1, j + 1, k + 1},
                                       {i, j + 1, k + 1},
                                       {i + 1, j + 1, k}});
        }
      }
      for (int a = 0; a < m; ++a) {
        for (int b = 1; b < m; ++b) {
          add_between({a, b, k}, {a + 1, b, k}, {a, b - 1, k + 1}, {a, b, k + 1});
          add_between({b, a, k}, {b, a + 1, k}, {b - 1, a, k + 1}, {b, a, k + 1});
        }
      }
    }
  }
  void add_between(const LatticePoint& a, const LatticePoint& b, const LatticePoint& c,
                   const LatticePoint& d) {
    add(std::array{a, b, c, d});
  }

  Shape shape_;
  int p_;
  std::vector<SubSimplex> result_;
};

}  // namespace

std::span<const SubSimplex> sub_simplices(Shape shape, int p) {
  struct Slot {
    std::once_flag once;
    std::vector<SubSimplex> cut;
  };
  static std::array<std::array<Slot, k_max_tested_order + 1>, k_shape_count> slots;
  if (p < 1 || p > k_max_tested_order || dimension(shape) < 2) {
    throw std::invalid_argument("no sub-simplices of a " + std::string(name(shape)) + " of order " +
                                std::to_string(p));
  }
  Slot& slot = slots[static_cast<std::size_t>(shape)][static_cast<std::size_t>(p)];
  std::call_once(slot.once, [&] { slot.cut = Cutter(shape, p).run(); });
  return slot.cut;
}

}  // namespace camber
