#pragma once
// How the Lagrange nodes of a cell depend on what the mesh stores, as explicit coefficients.
#include <camber/mesh/curved_mesh.hpp>

#include <span>
#include <vector>

namespace camber {

/// x(node n of cell) = sum over its row of coefficient * stored[column]. Columns: vertices first,
/// then the high-order nodes in the order of CurvedMesh::high_order_nodes(). Where all entities of
/// a cell have its own order every row is one column with coefficient 1.
class NodeMap {
 public:
  struct Entry {
    Index column;
    double coefficient;
  };

  /// Rows for some cells, each at its own order. Threads: runs parallel inside.
  NodeMap(const CurvedMesh& curved, std::vector<Index> cells);

  [[nodiscard]] const std::vector<Index>& cells() const { return cells_; }
  /// Row of lattice node n of the i-th cell.
  [[nodiscard]] std::span<const Entry> row(std::size_t i, std::size_t n) const {
    const std::size_t r = first_row_[i] + n;
    return {entries_.data() + row_offset_[r], row_offset_[r + 1] - row_offset_[r]};
  }
  [[nodiscard]] std::size_t node_total(std::size_t i) const {
    return first_row_[i + 1] - first_row_[i];
  }
  /// Number of the first lattice node of the i-th cell when all are counted one after the other.
  [[nodiscard]] std::size_t first_row(std::size_t i) const { return first_row_[i]; }
  [[nodiscard]] std::size_t row_count() const { return first_row_.back(); }

 private:
  std::vector<Index> cells_;
  std::vector<std::size_t> first_row_, row_offset_;
  std::vector<Entry> entries_;
};

}  // namespace camber
