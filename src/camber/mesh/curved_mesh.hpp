#pragma once
// A mixed-order mesh: one order a cell, nodes owned by edges, faces and cells.
#include <camber/mesh/linear_mesh.hpp>
#include <camber/mesh/topology.hpp>

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace camber {

/// Orders of all entities. An edge or face has the minimum over the cells that touch it, so that
/// neighbours of different order see one polynomial on their common entity: watertight by
/// construction.
struct OrderField {
  std::vector<std::uint8_t> cell, face, edge;
};
/// Entity orders from cell orders by the minimum rule.
[[nodiscard]] OrderField minimum_rule(const Topology& topology,
                                      std::vector<std::uint8_t> cell_orders);

enum class NodeStart { straight, zero };

/// Nodes of a mixed-order mesh. Holds references to the linear mesh and its topology, which must
/// outlive it. Only nodes above order 1 are stored: p-1 an edge, the interior lattice nodes of
/// faces (in the face's frame) and cells. Reading from several threads is safe; writing to
/// different entities too.
class CurvedMesh {
 public:
  /// All entities straight, of the given orders; or with nodes at zero, for who sets all of them.
  CurvedMesh(const LinearMesh& mesh, const Topology& topology, OrderField orders,
             NodeStart start = NodeStart::straight);

  [[nodiscard]] const LinearMesh& linear() const { return *mesh_; }
  [[nodiscard]] const Topology& topology() const { return *topology_; }
  [[nodiscard]] const OrderField& orders() const { return orders_; }
  [[nodiscard]] int cell_order(Index c) const { return orders_.cell[at(c)]; }
  [[nodiscard]] int face_order(Index f) const { return orders_.face[at(f)]; }
  [[nodiscard]] int edge_order(Index e) const { return orders_.edge[at(e)]; }
  [[nodiscard]] const Vec3& vertex(Index v) const { return mesh_->vertices[at(v)]; }

  /// Own interior nodes, order of lattice.hpp (edges from smaller to larger vertex).
  [[nodiscard]] std::span<Vec3> edge_nodes(Index e) { return own(edge_offset_, e); }
  [[nodiscard]] std::span<Vec3> face_nodes(Index f) { return own(face_offset_, f); }
  [[nodiscard]] std::span<Vec3> cell_nodes(Index c) { return own(cell_offset_, c); }
  [[nodiscard]] std::span<const Vec3> edge_nodes(Index e) const { return own(edge_offset_, e); }
  [[nodiscard]] std::span<const Vec3> face_nodes(Index f) const { return own(face_offset_, f); }
  [[nodiscard]] std::span<const Vec3> cell_nodes(Index c) const { return own(cell_offset_, c); }

  /// Points of the entity's polynomial at the order-q lattice, q >= its own order, in its own
  /// frame.
  void edge_lattice(Index e, int q, std::span<Vec3> points) const;  // q + 1
  void face_lattice(Index f, int q, std::span<Vec3> points) const;  // node_count(face shape, q)
  /// The element's Lagrange nodes of order q >= cell_order(c), canonical order: the same
  /// polynomial.
  void gather(Index c, int q, Points& nodes) const;
  /// Straight places of the entity's own nodes.
  void straight_inside_face(Index f, std::span<Vec3> nodes) const;
  void straight_inside_cell(Index c, std::span<Vec3> nodes) const;
  /// gather() for the straight copy.
  void gather_straight(Index c, int q, Points& nodes) const;

  /// All nodes above order 1, edges first, then faces, then cells, and where an entity's own begin.
  [[nodiscard]] std::span<Vec3> high_order_nodes() { return nodes_; }
  [[nodiscard]] std::span<const Vec3> high_order_nodes() const { return nodes_; }
  /// Frees the nodes, for who has taken them elsewhere: nothing may be asked of them after.
  void release_nodes() { nodes_ = {}; }
  [[nodiscard]] std::size_t high_order_node_count() const { return nodes_.size(); }
  [[nodiscard]] Index first_edge_node(Index e) const { return edge_offset_[at(e)]; }
  [[nodiscard]] Index first_face_node(Index f) const { return face_offset_[at(f)]; }
  [[nodiscard]] Index first_cell_node(Index c) const { return cell_offset_[at(c)]; }

 private:
  [[nodiscard]] std::span<Vec3> own(const std::vector<Index>& offset, Index i) {
    return {nodes_.data() + offset[at(i)],
            static_cast<std::size_t>(offset[at(i) + 1] - offset[at(i)])};
  }
  [[nodiscard]] std::span<const Vec3> own(const std::vector<Index>& offset, Index i) const {
    return {nodes_.data() + offset[at(i)],
            static_cast<std::size_t>(offset[at(i) + 1] - offset[at(i)])};
  }
  void allocate();
  void straighten();

  const LinearMesh* mesh_;
  const Topology* topology_;
  OrderField orders_;
  std::vector<Index> edge_offset_, face_offset_, cell_offset_;
  Points nodes_;
};

}  // namespace camber
