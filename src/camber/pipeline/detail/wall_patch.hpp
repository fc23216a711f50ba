#pragma once
// Wall faces as a patch whose nodes may slide on the CAD.
#include <camber/elevate/placement.hpp>
#include <camber/smooth/surface_fit.hpp>

#include <map>
#include <memory>
#include <vector>

namespace camber::detail {

/// Some wall faces of one CAD patch at one order, as Placement has them. Nodes inside the faces and
/// on edges between two of them may slide; vertices, CAD curves and the border of the set stay.
/// Serves one thread.
class WallPatch {
 public:
  /// @param faces  slots, sorted, all of one patch
  WallPatch(const LinearMesh& mesh, const Topology& topology, const Association& association,
            const GeometryModel& model, const Wall& wall, const Placement& placement,
            std::vector<Index> faces, int order);

  [[nodiscard]] SurfacePatch& patch() { return patch_; }
  [[nodiscard]] const std::vector<Index>& faces() const { return faces_; }
  [[nodiscard]] OnSurface on_surface();
  /// Closest points, searched by all threads, each from the answer before.
  [[nodiscard]] NearestPoints nearest_points();

  /// Writes the free nodes to the placement, at the patch's order.
  void store(Placement& placement) const;
  /// Samples the patch at a lower order, puts the nodes back on the CAD and writes them.
  void store_sampled(Placement& placement, int order);

 private:
  [[nodiscard]] int corner_total(Index slot) const {
    return topology_.corners_of_face(wall_.faces[at(slot)]);
  }
  [[nodiscard]] Index vertex(Index slot, int i) const {
    return topology_.face2vertex[at(wall_.faces[at(slot)])][static_cast<std::size_t>(i)];
  }
  [[nodiscard]] const GeometryGroup& group(Index slot) const {
    return association_.patches[at(association_.face2patch[at(wall_.faces[at(slot)])])].group;
  }
  [[nodiscard]] bool may_slide(Index edge) const;
  [[nodiscard]] bool walks_inwards(Index slot) const;
  [[nodiscard]] Projection foot(Index slot, const Vec3& x);
  Index add_node(const Vec3& x, bool is_free, Index slot);
  void add_face(Index slot, const Placement& placement);

  const LinearMesh& mesh_;
  const Topology& topology_;
  const Association& association_;
  const GeometryModel& model_;
  const Wall& wall_;
  std::unique_ptr<Projector> projector_;
  std::vector<Index> faces_;
  SurfacePatch patch_;
  std::vector<int> surface_;                        // node -> CAD face it slides on
  std::map<Index, Index> vertex_node_, edge_node_;  // first node
  std::vector<Index> face_node_;                    // first inner node, by face of the set
  std::vector<Projection> last_;                    // answers of nearest_points
};

}  // namespace camber::detail
