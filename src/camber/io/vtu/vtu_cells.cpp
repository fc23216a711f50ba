#include <camber/basis/lagrange.hpp>
#include <camber/basis/lattice.hpp>
#include <camber/basis/node_order.hpp>
#include <camber/io/vtu/vtu_cells.hpp>

#include <array>
#include <span>

namespace camber::io::vtu {
namespace {

constexpr std::uint8_t k_triangle = 5, k_quadrilateral = 9, k_tetrahedron = 10, k_hexahedron = 12,
                       k_wedge = 13, k_pyramid = 14, k_quadratic_pyramid = 37,
                       k_lagrange_triangle = 69, k_lagrange_quadrilateral = 70,
                       k_lagrange_tetrahedron = 71, k_lagrange_hexahedron = 72,
                       k_lagrange_wedge = 73;

std::uint8_t cell_type(Shape shape, int order) {
  const bool linear = order == 1;
  switch (shape) {
    case Shape::triangle:
      return linear ? k_triangle : k_lagrange_triangle;
    case Shape::quadrilateral:
      return linear ? k_quadrilateral : k_lagrange_quadrilateral;
    case Shape::tetrahedron:
      return linear ? k_tetrahedron : k_lagrange_tetrahedron;
    case Shape::hexahedron:
      return linear ? k_hexahedron : k_lagrange_hexahedron;
    case Shape::prism:
      return linear ? k_wedge : k_lagrange_wedge;
    default:
      return k_pyramid;
  }
}

/// A cell of a fixed element, as canonical nodes of it.
struct SubCell {
  std::uint8_t type;
  std::vector<int> nodes;
};

/// Order of nodes of an element that becomes one cell.
std::vector<int> cell_nodes(Shape shape, int order) {
  // VTK's linear wedge counts its triangles the other way round than every other cell.
  static constexpr std::array<std::size_t, 6> k_wedge_corners{0, 2, 1, 3, 5, 4};
  const std::span<const int> file2canonical = file_to_canonical(NodeConvention::vtk, shape, order);
  std::vector<int> nodes(file2canonical.begin(), file2canonical.end());
  if (shape == Shape::prism && order == 1) {
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = file2canonical[k_wedge_corners[i]];
  }
  return nodes;
}

/// Cuts the lattice pyramid of order p: layer k is a grid of squares; each square carries an
/// upright pyramid to the layer above; each square of the layer above a hanging one to the node
/// below its centre; between the upright pyramids on both sides of an inner edge stands a
/// tetrahedron.
std::vector<SubCell> cut_pyramid(int p) {
  std::vector<SubCell> cells;
  const auto node = [p](int i, int j, int k) {
    return lattice_index(Shape::pyramid, p, {i, j, k});
  };
  for (int k = 0; k < p; ++k) {
    const int n = p - k;  // squares on a side of layer k
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        cells.push_back({k_pyramid,
                         {node(i, j, k), node(i + 1, j, k), node(i + 1, j + 1, k),
                          node(i, j + 1, k), node(i, j, k + 1)}});
        if (i + 1 < n && j + 1 < n) {
          cells.push_back({k_pyramid,
                           {node(i, j, k + 1), node(i, j + 1, k + 1), node(i + 1, j + 1, k + 1),
                            node(i + 1, j, k + 1), node(i + 1, j + 1, k)}});
        }
        if (j > 0) {  // edge along i, between squares j-1 and j
          cells.push_back(
              {k_tetrahedron,
               {node(i, j, k), node(i + 1, j, k), node(i, j, k + 1), node(i, j - 1, k + 1)}});
        }
        if (i > 0) {  // edge along j, between squares i-1 and i
          cells.push_back(
              {k_tetrahedron,
               {node(i, j, k), node(i, j + 1, k), node(i - 1, j, k + 1), node(i, j, k + 1)}});
        }
      }
    }
  }
  return cells;
}

/// Reference points of the nodes that the 19-node pyramid has beyond the lattice of order 2:
/// centroids of the four triangles (014, 124, 234, 304) and the point a quarter up the axis.
std::vector<Vec3> extra_pyramid_points() {
  std::vector<Vec3> points;
  const std::span<const Vec3> c = corners(Shape::pyramid);
  for (std::size_t i = 0; i < 4; ++i) points.push_back((c[i] + c[(i + 1) % 4] + c[4]) / 3.0);
  const Vec3 base = 0.25 * (c[0] + c[1] + c[2] + c[3]);
  points.push_back(0.75 * base + 0.25 * c[4]);
  return points;
}

/// Canonical nodes of the first 14 of the 19: corners, edges 01 12 23 30 04 14 24 34, base centre.
std::vector<int> quadratic_pyramid_nodes() {
  std::vector<int> nodes;
  const LatticeMap& map = lattice_map(Shape::pyramid, 2);
  nodes.insert(nodes.end(), map.corner.begin(), map.corner.end());
  for (const std::vector<int>& edge : map.edge) nodes.push_back(edge[1]);
  nodes.push_back(lattice_index(Shape::pyramid, 2, {1, 1, 0}));
  return nodes;
}

class CellMaker {
 public:
  explicit CellMaker(const MeshData& mesh) : mesh_(mesh) { cells_.points = mesh.points; }

  Cells make() {
    for (std::size_t b = 0; b < mesh_.blocks.size(); ++b) {
      if (dimension(mesh_.blocks[b].shape) >= 2) add_block(b);
      element_ += mesh_.blocks[b].size();
    }
    return std::move(cells_);
  }

 private:
  void add_block(std::size_t b) {
    const ElementBlock& block = mesh_.blocks[b];
    const bool is_pyramid = block.shape == Shape::pyramid;
    const bool is_quadratic_pyramid = is_pyramid && block.order == 2;
    std::vector<SubCell> parts;
    if (is_quadratic_pyramid) {
      parts.push_back({k_quadratic_pyramid, quadratic_pyramid_nodes()});
    } else if (is_pyramid && block.order > 2) {
      parts = cut_pyramid(block.order);
    } else {
      parts.push_back({cell_type(block.shape, block.order), cell_nodes(block.shape, block.order)});
    }
    const Tabulation extra =
        is_quadratic_pyramid ? tabulate(Shape::pyramid, 2, extra_pyramid_points()) : Tabulation{};
    const auto per = static_cast<std::size_t>(node_count(block.shape, block.order));
    for (std::size_t e = 0; e < block.size(); ++e) {
      const std::span<const Index> nodes(block.nodes.data() + e * per, per);
      for (const SubCell& part : parts) {
        for (const int n : part.nodes) {
          cells_.connectivity.push_back(nodes[static_cast<std::size_t>(n)]);
        }
        for (Eigen::Index row = 0; row < extra.values.rows(); ++row) {
          cells_.connectivity.push_back(static_cast<std::int64_t>(cells_.points.size()));
          Vec3 x = Vec3::Zero();
          for (std::size_t n = 0; n < per; ++n) {
            x += extra.values(row, static_cast<Eigen::Index>(n)) * mesh_.points[at(nodes[n])];
          }
          cells_.points.push_back(x);
        }
        cells_.offsets.push_back(static_cast<std::int64_t>(cells_.connectivity.size()));
        cells_.types.push_back(part.type);
        cells_.cell2element.push_back(element_ + e);
        cells_.cell2block.push_back(b);
      }
    }
  }

  const MeshData& mesh_;
  Cells cells_;
  std::size_t element_ = 0;  // elements before the current block
};

}  // namespace

Cells make_cells(const MeshData& mesh) { return CellMaker(mesh).make(); }

}  // namespace camber::io::vtu
