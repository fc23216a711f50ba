#pragma once
// The points of an exported mesh: which there are, in which order, and where.
#include <camber/mesh/curved_mesh.hpp>
#include <camber/mesh/mesh_data.hpp>

#include <array>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace camber::detail {

/// Numbers and places the points of export_mesh(): the vertices, then by order the insides of
/// edges, of faces and of cells, once for every order of a cell that has the entity. Same bits for
/// any number of threads.
class ExportPoints {
 public:
  /// @param uniform_order  0: every cell at its own order
  /// @throws MeshError if an Index cannot count the points
  ExportPoints(const CurvedMesh& curved, int uniform_order);

  /// Fills points, point_tags and point_entity.
  void place(MeshData& data) const;

  /// The order a cell is written at, and the volume entity it is written on.
  [[nodiscard]] int order_of(Index c) const {
    return uniform_ > 0 ? uniform_ : curved_.cell_order(c);
  }
  [[nodiscard]] int entity_of(Index c) const { return cell_entity_[at(c)]; }
  /// The region that a volume entity is made of.
  [[nodiscard]] int region_of(int entity) const { return region_of_entity_.at(entity); }
  /// First point inside an edge or face at order p >= 2 of one of its cells, or inside a cell.
  [[nodiscard]] Index first_of_edge(Index e, int p) const {
    return edge_[static_cast<std::size_t>(p)][at(e)];
  }
  [[nodiscard]] Index first_of_face(Index f, int p) const {
    return face_[static_cast<std::size_t>(p)][at(f)];
  }
  [[nodiscard]] Index first_of_cell(Index c) const { return cell_[at(c)]; }

 private:
  static constexpr std::size_t k_orders = static_cast<std::size_t>(k_max_order) + 1;
  /// [q][i]: first point of entity i at order q, or -1. Empty where no cell has the order.
  using FirstPoint = std::array<std::vector<Index>, k_orders>;

  template <class Visit>
  void for_each_run(const Visit& visit) const;
  void collect_regions();
  void mark_used();
  void number_points();
  [[nodiscard]] EntityKey class_of_edge(Index e) const;
  void place_vertices(MeshData& data) const;
  void place_edges(MeshData& data) const;
  void place_faces(MeshData& data) const;
  void place_cells(MeshData& data) const;

  const CurvedMesh& curved_;
  const LinearMesh& mesh_;
  const Topology& topology_;
  int uniform_;
  std::vector<int> cell_entity_;
  std::map<int, int> region_of_entity_;
  std::map<Index, int> edge_curve_;
  FirstPoint edge_, face_;
  std::vector<Index> cell_;  // first point inside, -1 at order 1
  std::size_t count_ = 0;
};

}  // namespace camber::detail
