#include <camber/base/parallel.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/mesh/node_map.hpp>

#include <algorithm>
#include <utility>

namespace camber {
namespace {

using Row = std::vector<NodeMap::Entry>;
using Rows = std::vector<Row>;

/// Coefficients of an exact elevation below this are rounding.
constexpr double k_zero_coefficient = 1e-14;

/// Rows of the elevated lattice: sums of rows of the lower one, one entry a column.
Rows elevated(const MatX& matrix, const Rows& lower) {
  Rows rows(static_cast<std::size_t>(matrix.rows()));
  for (Eigen::Index r = 0; r < matrix.rows(); ++r) {
    Row& row = rows[static_cast<std::size_t>(r)];
    for (Eigen::Index c = 0; c < matrix.cols(); ++c) {
      const double factor = matrix(r, c);
      if (std::abs(factor) < k_zero_coefficient) continue;
      for (const NodeMap::Entry& e : lower[static_cast<std::size_t>(c)]) {
        row.push_back({e.column, factor * e.coefficient});
      }
    }
    std::stable_sort(row.begin(), row.end(),
                     [](const auto& a, const auto& b) { return a.column < b.column; });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < row.size(); ++i) {
      if (kept > 0 && row[kept - 1].column == row[i].column) {
        row[kept - 1].coefficient += row[i].coefficient;
      } else {
        row[kept++] = row[i];
      }
    }
    row.resize(kept);
  }
  return rows;
}

/// The same walk as CurvedMesh::gather, with rows in the place of points.
class RowGatherer {
 public:
  explicit RowGatherer(const CurvedMesh& curved)
      : curved_(curved), topology_(curved.topology()), mesh_(curved.linear()) {}

  [[nodiscard]] Rows cell(Index c) const {
    const Shape shape = mesh_.cell_shape[at(c)];
    const int p = curved_.cell_order(c);
    const LatticeMap& map = lattice_map(shape, p);
    Rows rows(at(node_count(shape, p)));
    const std::span<const Index> v = mesh_.cell(c);
    for (std::size_t i = 0; i < v.size(); ++i) rows[at(map.corner[i])] = {{v[i], 1.0}};
    if (p == 1) return rows;
    const std::span<const Index> cell_edges = topology_.edges_of_cell(c);
    for (std::size_t i = 0; i < cell_edges.size(); ++i) {
      const Rows line = edge(cell_edges[i], p);
      const bool reversed =
          topology_.cell2edge_reversed[at(topology_.cell2edge_offset[at(c)]) + i] != 0;
      const std::vector<int>& slots = map.edge_interior[i];
      for (std::size_t k = 0; k < slots.size(); ++k) {
        rows[at(slots[k])] = line[reversed ? at(p) - 1 - k : k + 1];
      }
    }
    const std::span<const Index> cell_faces = topology_.faces_of_cell(c);
    for (std::size_t i = 0; i < cell_faces.size(); ++i) {
      if (map.face_interior[i].empty()) continue;
      const Index f = cell_faces[i];
      const Rows surface = face(f, p);
      const int view = topology_.cell2face_view[at(topology_.cell2face_offset[at(c)]) + i];
      const Shape face_shape = topology_.face_shape[at(f)];
      const std::span<const int> frame_node = face_view_nodes(face_shape, view, p);
      for (int inner : interior_nodes(face_shape, p)) {
        rows[at(map.face[i][at(inner)])] = surface[at(frame_node[at(inner)])];
      }
    }
    own(rows, map.interior, curved_.first_cell_node(c));
    return rows;
  }

 private:
  void own(Rows& rows, const std::vector<int>& slots, Index first) const {
    const Index column = static_cast<Index>(mesh_.vertices.size()) + first;
    for (std::size_t i = 0; i < slots.size(); ++i) {
      rows[at(slots[i])] = {{column + static_cast<Index>(i), 1.0}};
    }
  }

  [[nodiscard]] Rows edge(Index e, int q) const {
    const int r = curved_.edge_order(e);
    Rows rows(at(r) + 1);
    rows.front() = {{topology_.edge2vertex[at(e)][0], 1.0}};
    rows.back() = {{topology_.edge2vertex[at(e)][1], 1.0}};
    std::vector<int> inner;
    for (int i = 1; i < r; ++i) inner.push_back(i);
    own(rows, inner, curved_.first_edge_node(e));
    return q == r ? rows : elevated(elevation_matrix(Shape::line, r, q), rows);
  }

  [[nodiscard]] Rows face(Index f, int q) const {
    const Shape shape = topology_.face_shape[at(f)];
    const int r = curved_.face_order(f);
    const LatticeMap& map = lattice_map(shape, r);
    Rows rows(at(node_count(shape, r)));
    for (int i = 0; i < topology_.corners_of_face(f); ++i) {
      const Index v = topology_.face2vertex[at(f)][at(i)];
      rows[at(map.corner[at(i)])] = {{v, 1.0}};
      const Index e = topology_.face2edge[at(f)][at(i)];
      const Rows line = edge(e, r);
      const bool reversed = topology_.edge2vertex[at(e)][0] != v;
      const std::vector<int>& slots = map.edge_interior[at(i)];
      for (std::size_t k = 0; k < slots.size(); ++k) {
        rows[at(slots[k])] = line[reversed ? at(r) - 1 - k : k + 1];
      }
    }
    own(rows, map.interior, curved_.first_face_node(f));
    return q == r ? rows : elevated(elevation_matrix(shape, r, q), rows);
  }

  const CurvedMesh& curved_;
  const Topology& topology_;
  const LinearMesh& mesh_;
};

}  // namespace

NodeMap::NodeMap(const CurvedMesh& curved, std::vector<Index> cells) : cells_(std::move(cells)) {
  std::vector<Rows> found(cells_.size());
  const RowGatherer gatherer(curved);
  parallel_for(cells_.size(), 64, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) found[i] = gatherer.cell(cells_[i]);
  });
  first_row_.assign(1, 0);
  row_offset_.assign(1, 0);
  for (const Rows& rows : found) {
    for (const Row& row : rows) {
      entries_.insert(entries_.end(), row.begin(), row.end());
      row_offset_.push_back(entries_.size());
    }
    first_row_.push_back(first_row_.back() + rows.size());
  }
}

}  // namespace camber
