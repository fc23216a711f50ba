#pragma once
// The displacement field that carries the wall's displacement through the layers and lets it die
// out.
#include <camber/elevate/columns.hpp>
#include <camber/elevate/decay_length.hpp>
#include <camber/elevate/face_tree.hpp>
#include <camber/elevate/motion_constraints.hpp>
#include <camber/elevate/placement.hpp>

#include <array>
#include <span>
#include <vector>

namespace camber {

/// u(x) = d(b) phi(z / L): b is the foot of x on the straight wall, z its distance, d the wall's
/// displacement polynomial there, L = max(c_L h, 5 |d|), phi(s) = (1-s)^2 (1+2s). Under flat
/// cells on top of the layers L is shorter (decay_length.hpp). Near the wall the
/// map is a shear, so the height of the first cell never enters its validity. The foot is that of
/// the column where there is one, else the closest point. Where two walls meet in a sharp concave
/// edge their contributions are blended with weights phi_i / z_i^2, so that u = d on each of them.
/// Near patches that do not move the normal part dies out; on planes it is exactly zero. With
/// Decay::cell L is the height of the first cell and phi(s) = 1 - s: the paper's transfer (2.2.4),
/// which inverts cells thinner than the displacement. All const members may be called by any
/// thread.
class LayerField {
 public:
  LayerField(const LinearMesh& mesh, const Topology& topology, const Association& association,
             const Wall& wall, const Placement& placement, const Columns& columns,
             const LayerFieldOptions& options = {});

  /// Displacements of the entity's own (interior) lattice nodes of order q, in its frame. Entities
  /// on the wall give what Placement says.
  void edge(Index e, int q, std::span<Vec3> u) const;
  void face(Index f, int q, std::span<Vec3> u) const;
  void cell(Index c, int q, std::span<Vec3> u) const;

  /// Snaps a position of an entity on planes back into them (removes rounding).
  [[nodiscard]] Vec3 constrained_edge_point(Index e, const Vec3& x) const {
    return constraints_.edge_point(e, x);
  }
  [[nodiscard]] Vec3 constrained_face_point(Index f, const Vec3& x) const {
    return constraints_.face_point(f, x);
  }

  /// Decay length at a wall vertex (0 off the wall).
  [[nodiscard]] double decay_length(Index vertex) const { return length_[at(vertex)]; }

 private:
  struct Foot {              // where an entity stands: foot of each of its corners
    Index slot = k_none;     // wall face; -1: no common foot
    bool is_vertex = false;  // all corners over one wall vertex: no displacement from this wall
    std::array<Vec3, 8> xi;
    std::array<double, 8> z{}, length{};
  };
  /// Share of the wall's displacement left at s decay lengths.
  [[nodiscard]] double share(double s) const;
  [[nodiscard]] Foot foot_of(std::span<const Index> vertices,
                             std::array<Index, 2> column_slots) const;
  [[nodiscard]] Vec3 displacement(const Vec3& x, int q, const Foot* foot,
                                  std::span<const double> weights) const;
  [[nodiscard]] Vec3 wall_displacement(Index slot, const Vec3& xi, int q) const;
  [[nodiscard]] double wall_length(Index slot, const Vec3& xi) const;
  [[nodiscard]] Vec3 damped_by_still_patches(const Vec3& x, double wall_distance,
                                             const Vec3& u) const;

  const LinearMesh& mesh_;
  const Topology& topology_;
  const Association& association_;
  const Wall& wall_;
  const Placement& placement_;
  const Columns& columns_;
  Decay decay_;
  std::vector<double> length_;  // per vertex
  double longest_ = 0.0;
  FaceTree wall_tree_, still_tree_;
  std::vector<Index> still_faces_;
  int label_count_ = 0;
  MotionConstraints constraints_;
};

}  // namespace camber
