#include "hybrid_mesh.hpp"

#include <camber/basis/lagrange.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <sstream>
#include <tuple>

#include "sample_mesh.hpp"

namespace camber::io {
namespace {

struct Cell {
  Shape shape;
  std::vector<Vec3> corners;
};

/// All cells are affine images of their reference shape, so that a quadratic map makes polynomials
/// of order 2 of them.
std::vector<Cell> straight_cells() {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(1, 1, 0), d(0, 1, 0), e(0, 0, 1), f(1, 0, 1), g(1, 1, 1),
      h(0, 1, 1);
  const Vec3 left(-1, 0, 0), top(0.5, 0.5, 1.8), far(1.7, 0.5, 1.6), ridge(1.8, 0, 0.3),
      back(1.8, 1, 0.3), low(1.2, -0.7, 0.4), tip(-1.8, 0.4, 0.5), end(1.5, 0.8, 2.4);
  return {
      {Shape::hexahedron, {a, b, c, d, e, f, g, h}},
      {Shape::hexahedron, {a + left, a, d, d + left, e + left, e, h, h + left}},
      {Shape::pyramid, {e, f, g, h, top}},
      {Shape::pyramid, {a + left, d + left, h + left, e + left, tip}},
      {Shape::prism, {b, ridge, f, c, back, g}},
      {Shape::tetrahedron, {f, g, top, far}},
      {Shape::tetrahedron, {g, top, far, end}},
      {Shape::tetrahedron, {b, ridge, f, low}},
  };
}

/// The cube [-1, 1]^3 in eight hexes, or each of these in six tets round its diagonal.
std::vector<Cell> grid_cells(Shape shape) {
  constexpr std::array k_walks{std::array{0, 1, 2}, std::array{1, 2, 0}, std::array{2, 0, 1},
                               std::array{0, 2, 1}, std::array{2, 1, 0}, std::array{1, 0, 2}};
  std::vector<Cell> cells;
  for (const double x : {-1.0, 0.0}) {
    for (const double y : {-1.0, 0.0}) {
      for (const double z : {-1.0, 0.0}) {
        const Vec3 low(x, y, z);
        if (shape == Shape::hexahedron) {
          Cell& cell = cells.emplace_back(Cell{shape, {}});
          for (const Vec3& corner : {Vec3(0, 0, 0), Vec3(1, 0, 0), Vec3(1, 1, 0), Vec3(0, 1, 0),
                                     Vec3(0, 0, 1), Vec3(1, 0, 1), Vec3(1, 1, 1), Vec3(0, 1, 1)}) {
            cell.corners.push_back(low + corner);
          }
          continue;
        }
        for (const std::array<int, 3>& walk : k_walks) {
          Cell& cell = cells.emplace_back(Cell{shape, {low}});
          for (const int axis : walk)
            cell.corners.push_back(cell.corners.back() + Vec3::Unit(axis));
        }
      }
    }
  }
  return cells;
}

double straight_volume(const Cell& cell, const std::vector<int>& numbering) {
  Points corner_points;
  for (const int n : numbering) corner_points.push_back(cell.corners[static_cast<std::size_t>(n)]);
  const Points nodes = straight_nodes(cell.shape, 1, corner_points);
  return jacobian(cell.shape, 1, nodes, reference_centroid(cell.shape)).determinant();
}

/// Corner numberings that make the same cell with a positive volume.
std::vector<std::vector<int>> numberings(const Cell& cell) {
  std::set<std::pair<int, int>> edge_set;
  for (const auto& [i, k] : edges(cell.shape)) edge_set.insert(std::minmax(i, k));
  std::vector<int> numbering(cell.corners.size());
  std::iota(numbering.begin(), numbering.end(), 0);
  std::vector<std::vector<int>> good;
  do {
    const auto n = [&](int i) { return numbering[static_cast<std::size_t>(i)]; };
    const bool keeps = std::all_of(
        edges(cell.shape).begin(), edges(cell.shape).end(),
        [&](const auto& edge) { return edge_set.contains(std::minmax(n(edge[0]), n(edge[1]))); });
    if (keeps && straight_volume(cell, numbering) > 0.0) good.push_back(numbering);
  } while (std::next_permutation(numbering.begin(), numbering.end()));
  return good;
}

using Key = std::array<long, 3>;
Key key_of(const Vec3& x) {
  return {std::lround(1e6 * x.x()), std::lround(1e6 * x.y()), std::lround(1e6 * x.z())};
}

class Maker {
 public:
  explicit Maker(unsigned seed) : random_(seed) {}

  template <class Bend, class OrderOf>
  MeshData make(std::vector<Cell> cells, const Bend& bend, const OrderOf& order_of) {
    std::map<std::set<Key>, int> seen;  // corners of a face -> cells that have it
    std::vector<int> orders;
    for (std::size_t i = 0; i < cells.size(); ++i) {
      Cell& cell = cells[i];
      const std::vector<std::vector<int>> all = numberings(cell);
      const std::vector<int>& numbering = all[random_() % all.size()];
      std::vector<Vec3> renumbered;
      for (const int n : numbering) {
        renumbered.push_back(cell.corners[static_cast<std::size_t>(n)]);
      }
      cell.corners = renumbered;
      orders.push_back(order_of(i, random_));
      for (const LocalFace& face : faces(cell.shape)) ++seen[face_key(cell, face)];
    }
    for (std::size_t i = 0; i < cells.size(); ++i) add_cell(cells[i], orders[i], i % 2 == 0, seen);
    for (Vec3& x : mesh_.points) x = bend(x);
    name_entities();
    shuffle_points();
    return mesh_;
  }

 private:
  static std::set<Key> face_key(const Cell& cell, const LocalFace& face) {
    std::set<Key> key;
    for (const int c : face.corners) {
      if (c >= 0) key.insert(key_of(cell.corners[static_cast<std::size_t>(c)]));
    }
    return key;
  }

  void add_cell(const Cell& cell, int order, bool is_left,
                const std::map<std::set<Key>, int>& seen) {
    const Points straight = straight_nodes(cell.shape, order, cell.corners);
    const std::vector<int>& corner = lattice_map(cell.shape, order).corner;
    std::vector<Index> nodes;
    for (std::size_t n = 0; n < straight.size(); ++n) {
      const bool is_corner =
          std::find(corner.begin(), corner.end(), static_cast<int>(n)) != corner.end();
      // Nodes are shared within an order, corners by all.
      const auto [place, is_new] = known_.try_emplace({is_corner ? 1 : order, key_of(straight[n])},
                                                      static_cast<Index>(mesh_.points.size()));
      if (is_new) mesh_.points.push_back(straight[n]);
      nodes.push_back(place->second);
    }
    append(cell.shape, order, is_left ? 3 : 4, nodes);
    const std::span<const LocalFace> local = faces(cell.shape);
    for (std::size_t f = 0; f < local.size(); ++f) {
      if (seen.at(face_key(cell, local[f])) > 1) continue;
      std::vector<Index> face;
      for (const int n : lattice_map(cell.shape, order).face[f]) {
        face.push_back(nodes[static_cast<std::size_t>(n)]);
      }
      append(local[f].shape, order, f % 2 == 0 ? 7 : 5, face);
    }
  }

  void append(Shape shape, int order, int entity, const std::vector<Index>& nodes) {
    for (ElementBlock& b : mesh_.blocks) {
      if (b.shape != shape || b.order != order || b.entity != entity) continue;
      b.nodes.insert(b.nodes.end(), nodes.begin(), nodes.end());
      return;
    }
    ElementBlock& b = mesh_.blocks.emplace_back();
    b.shape = shape;
    b.order = order;
    b.entity = entity;
    b.nodes = nodes;
  }

  void name_entities() {
    for (const auto& [dim, tag, name] :
         {std::tuple{3, 3, "left"}, {3, 4, "right"}, {2, 5, "wall"}, {2, 7, "far & <away>"}}) {
      EntityRecord entity;
      entity.key = {dim, tag};
      entity.physical_tags = {tag};
      entity.name = name;
      mesh_.entities.push_back(entity);
      mesh_.physical_names.push_back({dim, tag, name});
    }
  }

  void shuffle_points() {
    std::vector<Index> new_index(mesh_.points.size());
    std::iota(new_index.begin(), new_index.end(), 0);
    std::shuffle(new_index.begin(), new_index.end(), random_);
    Points points(mesh_.points.size());
    for (std::size_t i = 0; i < points.size(); ++i) points[at(new_index[i])] = mesh_.points[i];
    mesh_.points = points;
    for (ElementBlock& b : mesh_.blocks) {
      for (Index& n : b.nodes) n = new_index[at(n)];
    }
  }

  std::mt19937 random_;
  MeshData mesh_;
  std::map<std::pair<int, Key>, Index> known_;
};

}  // namespace

namespace {

Vec3 smoothly_bent(const Vec3& x) {
  return x + 0.06 * Vec3(std::sin(2.0 * x.y() + x.z()), std::cos(1.5 * x.x() - x.z()),
                         std::sin(x.x() + 0.7 * x.y()));
}

}  // namespace

MeshData hybrid(int order, unsigned seed) {
  return Maker(seed).make(straight_cells(), smoothly_bent,
                          [&](std::size_t, std::mt19937&) { return order; });
}

MeshData bent_cube(Shape shape, int order, unsigned seed) {
  return Maker(seed).make(grid_cells(shape), smoothly_bent,
                          [&](std::size_t, std::mt19937&) { return order; });
}

MeshData hybrid_of_mixed_order(unsigned seed) {
  const auto bend = [](const Vec3& x) -> Vec3 {
    return x + 0.05 * Vec3(x.y() * x.z() - x.y() * x.y(), x.x() * x.x() - x.z() * x.x(),
                           x.x() * x.y() + 0.5 * x.z() * x.z());
  };
  return Maker(seed).make(straight_cells(), bend, [](std::size_t i, std::mt19937& random) {
    constexpr std::array k_orders{2, 3, 2, 2, 4};  // hexes, pyramids, the prism; then tets
    return i < k_orders.size() ? k_orders[i] : 2 + static_cast<int>(random() % 3);
  });
}

void write_sizes(const MeshData& mesh, const std::string& path) {
  std::ostringstream text;
  text << std::setprecision(17);
  const std::vector<double> sizes = measures(mesh);
  std::size_t e = 0;
  for (const ElementBlock& b : mesh.blocks) {
    for (std::size_t i = 0; i < b.size(); ++i, ++e) {
      if (dimension(b.shape) < 2) continue;
      text << (dimension(b.shape) == 3 ? "volume " : "area ") << sizes[e] << '\n';
    }
  }
  std::vector<char> is_inner(mesh.points.size(), 0);
  for (const ElementBlock& b : mesh.blocks) {
    if (dimension(b.shape) < 3) continue;
    const auto per = static_cast<std::size_t>(node_count(b.shape, b.order));
    for (std::size_t k = 0; k < b.nodes.size(); k += per) {
      for (const int n : lattice_map(b.shape, b.order).interior) {
        is_inner[at(b.nodes[k + static_cast<std::size_t>(n)])] = 1;
      }
    }
  }
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    const Vec3& x = mesh.points[i];
    text << (is_inner[i] != 0 ? "inner " : "node ") << x.x() << ' ' << x.y() << ' ' << x.z()
         << '\n';
  }
  spill(path, text.str());
}

}  // namespace camber::io
