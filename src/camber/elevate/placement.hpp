#pragma once
// High-order wall nodes on the CAD, for every order that may be asked, and how far each order
// misses.
#include <camber/elevate/wall.hpp>
#include <camber/mesh/curved_mesh.hpp>

#include <array>
#include <span>
#include <utility>
#include <vector>

namespace camber {

/// How a face misses its CAD at one order.
struct Deviation {
  double maximum = 0.0;   // largest distance at the sixth-order Gauss points
  double integral = 0.0;  // of the distance over the face: numerator of shape conformity, eq. (1)
  double area = 0.0;
};

/// Wall nodes at orders 2..max_order. Edge nodes: on their CAD curve, evenly in arc length; else
/// where the line through the straight node along the interpolated corner normals meets the patch's
/// CAD (closest point as fallback; inside the plane where the edge borders a planar patch without
/// CAD). Face nodes: the same, from the straight node moved by what its edges slid along the wall.
/// (numerics: directional projection keeps faces that turn by 90 degrees valid where closest points
/// fold.)
class Placement {
 public:
  Placement(const LinearMesh& mesh, const Topology& topology, const Association& association,
            const GeometryModel& model, const Wall& wall, int max_order);

  [[nodiscard]] int max_order() const { return max_order_; }
  /// Own (interior) nodes in the entity's frame; q = 2..max_order.
  [[nodiscard]] std::span<const Vec3> edge_nodes(Index slot, int q) const;
  [[nodiscard]] std::span<const Vec3> face_nodes(Index slot, int q) const;
  /// Displacement of all lattice nodes from the straight wall (ends and corners included, zero
  /// there).
  [[nodiscard]] std::span<const Vec3> edge_displacement(Index slot, int q) const;
  [[nodiscard]] std::span<const Vec3> face_displacement(Index slot, int q) const;
  /// The edge's displacement of order `cap` as a polynomial of order q >= cap, at the lattice nodes
  /// of order q: what lower() makes of it. 1 is straight: zero.
  [[nodiscard]] Points capped_edge_displacement(Index slot, int cap, int q) const;

  /// Replaces the own nodes of an edge or face at order q (they must lie on the CAD). After edges
  /// were changed the faces on them must be set too, or their displacement keeps the old edge.
  void set_edge(Index slot, int q, std::span<const Vec3> nodes);
  void set_face(Index slot, int q, std::span<const Vec3> nodes);
  /// Measures all deviations again, after nodes were set.
  void measure();

  /// Caps the order of shape of some faces (slots): above its cap a face's nodes are those of the
  /// cap's polynomial, elevated. Caps only fall. Their edges inside a patch follow; edges on CAD
  /// curves only when the cap reaches 1 (straight). Faces that share a changed edge are placed
  /// again.
  /// @return slots of all faces whose nodes changed, sorted
  std::vector<Index> lower(const std::vector<std::pair<Index, int>>& caps);
  /// Highest order of shape the face may have (max_order unless lowered).
  [[nodiscard]] int face_cap(Index slot) const { return face_cap_[at(slot)]; }

  /// q = 1..max_order, every entity of the face at order q.
  [[nodiscard]] const Deviation& face_deviation(Index slot, int q) const {
    return face_deviation_[static_cast<std::size_t>(q)][at(slot)];
  }
  /// Largest distance of the edge's polynomial to its CAD curve; 0 for edges inside a patch.
  [[nodiscard]] double edge_deviation(Index slot, int q) const {
    return edge_deviation_[static_cast<std::size_t>(q)][at(slot)];
  }
  /// Largest displacement of any node of the edge / face at max_order.
  [[nodiscard]] double largest_displacement() const { return largest_; }
  /// Entities with a node for which neither line nor closest point gave an answer (it stays
  /// straight).
  [[nodiscard]] bool is_edge_unplaced(Index slot) const { return edge_unplaced_[at(slot)] != 0; }
  [[nodiscard]] bool is_face_unplaced(Index slot) const { return face_unplaced_[at(slot)] != 0; }

 private:
  void place_edges();
  void place_faces();
  void place_edge(Projector& projector, Index slot);
  void place_face(Projector& projector, Index slot);
  void measure_slot(Projector& projector, Index slot);
  void measure_edge(Projector& projector, Index slot);
  void find_planes();
  void copy_edges_to_face(Index slot, int q, std::span<Vec3> moved) const;
  void cap_edge(Index slot);
  void cap_face(Index slot);
  [[nodiscard]] Vec3 onto_patch(Projector& projector, Index patch, const Vec3& x,
                                const Vec3& direction, double reach, const WallCorner* seed,
                                bool& is_placed) const;

  static constexpr std::size_t k_orders = static_cast<std::size_t>(k_max_order) + 1;
  const LinearMesh& mesh_;
  const Topology& topology_;
  const Association& association_;
  const GeometryModel& model_;
  const Wall& wall_;
  int max_order_;
  std::array<Points, k_orders> edge_nodes_, face_nodes_;
  std::array<Points, k_orders> edge_displacement_, face_displacement_;
  std::array<std::vector<Index>, k_orders> face_node_offset_, face_displacement_offset_;
  std::array<std::vector<Deviation>, k_orders> face_deviation_;
  std::array<std::vector<double>, k_orders> edge_deviation_;
  double largest_ = 0.0;
  std::vector<std::uint8_t> edge_unplaced_, face_unplaced_;
  std::vector<std::uint8_t> edge_cap_, face_cap_;
  std::vector<Index> plane_of_edge_;  // edge slot -> patch of kind `plane` on its other side, or -1
};

/// Deviation of a curved face from its group at the sixth-order Gauss points. nodes: canonical
/// order of the face's shape, order q. Areas are those of the curved face.
[[nodiscard]] Deviation measure_face(Projector& projector, const GeometryGroup& group, Shape shape,
                                     int q, std::span<const Vec3> nodes, const WallCorner* seed);

}  // namespace camber
