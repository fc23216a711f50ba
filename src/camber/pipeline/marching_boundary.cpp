#include <camber/base/parallel.hpp>
#include <camber/pipeline/marching_boundary.hpp>

#include <memory>

namespace camber {
namespace {

constexpr std::size_t k_grain = 64;
/// Sine of the angle between two planes under which they count as one.
constexpr double k_same_plane = 1e-6;

class Boundary {
 public:
  Boundary(const LinearMesh& mesh, const Topology& topology, const Association& association,
           const GeometryModel& geometry)
      : mesh_(mesh),
        topology_(topology),
        association_(association),
        geometry_(geometry),
        edge_patches_(topology.edge_count(), {k_none, k_none}) {
    for (Index f = 0; at(f) < topology.face_count(); ++f) {
      const Index patch = association.face2patch[at(f)];
      if (patch == k_none) continue;
      for (int i = 0; i < topology.corners_of_face(f); ++i) {
        auto& [a, b] = edge_patches_[at(topology.face2edge[at(f)][static_cast<std::size_t>(i)])];
        if (a == k_none) {
          a = patch;
        } else if (patch != a) {
          b = b == k_none || b == patch ? patch : k_many;
        }
      }
    }
  }

  /// Faces that may slide, on the wall or off it, and what must not move with them.
  [[nodiscard]] MarchingSurface surface(const Wall& wall, bool is_wall) const {
    MarchingSurface surface;
    surface.fixed = {std::vector<std::uint8_t>(topology_.edge_count(), 1),
                     std::vector<std::uint8_t>(topology_.face_count(), 1)};
    for (Index f = 0; at(f) < topology_.face_count(); ++f) {
      if ((wall.face_slot[at(f)] != k_none) != is_wall) continue;
      if (!can_slide_on(association_.face2patch[at(f)])) continue;
      surface.faces.push_back(f);
      surface.fixed.face[at(f)] = 0;
    }
    for (Index e = 0; at(e) < topology_.edge_count(); ++e) {
      if ((wall.edge_slot[at(e)] != k_none) == is_wall && can_slide(e))
        surface.fixed.edge[at(e)] = 0;
    }
    return surface;
  }

  void put_back(Projector& projector, NodeMove& move) const {
    const StoredNode& node = move.node;
    if (node.dim == 2) return onto_patch(projector, association_.face2patch[at(node.entity)], move);
    if (is_on_curve(node.entity)) {
      return take(projector.closest(association_.edge2curve[at(node.entity)], move.to), move);
    }
    const auto& [a, b] = edge_patches_[at(node.entity)];
    if (b == k_none) return onto_patch(projector, a, move);
    const Patch &one = association_.patches[at(a)], &other = association_.patches[at(b)];
    const Vec3 along = one.normal.cross(other.normal);
    if (along.norm() < k_same_plane) return onto_patch(projector, a, move);
    const Vec3 direction = along.normalized();
    const Vec3& origin = mesh_.vertices[at(topology_.edge2vertex[at(node.entity)][0])];
    move.to = origin + (move.to - origin).dot(direction) * direction;
  }

  [[nodiscard]] const GeometryModel& geometry() const { return geometry_; }

 private:
  static constexpr Index k_many = -2;  // more than two patches meet

  [[nodiscard]] bool is_plane(Index patch) const {
    return association_.patches[at(patch)].kind == PatchKind::plane;
  }
  [[nodiscard]] bool can_slide_on(Index patch) const {
    return patch >= 0 && association_.patches[at(patch)].kind != PatchKind::straight;
  }
  [[nodiscard]] bool is_on_curve(Index e) const { return association_.edge2curve[at(e)].dim == 1; }

  /// An edge may slide along its curve, on the one patch on both sides, or where two planes meet.
  [[nodiscard]] bool can_slide(Index e) const {
    const auto& [a, b] = edge_patches_[at(e)];
    if (!can_slide_on(a) || (b != k_none && !can_slide_on(b))) return false;
    return is_on_curve(e) || b == k_none || (is_plane(a) && is_plane(b));
  }

  static void take(const Projection& foot, NodeMove& move) {
    move.to = foot.status == ProjectionStatus::failed ? move.from : foot.point;
  }
  void onto_patch(Projector& projector, Index p, NodeMove& move) const {
    const Patch& patch = association_.patches[at(p)];
    if (patch.kind == PatchKind::plane) {
      move.to -= (move.to - patch.origin).dot(patch.normal) * patch.normal;
    } else {
      take(project_to_group(projector, patch.group, move.to), move);
    }
  }

  const LinearMesh& mesh_;
  const Topology& topology_;
  const Association& association_;
  const GeometryModel& geometry_;
  std::vector<std::array<Index, 2>> edge_patches_;
};

}  // namespace

MarchingBoundary marching_boundary(const LinearMesh& mesh, const Topology& topology,
                                   const GeometryModel& geometry, const FieldSource& field) {
  const auto boundary = std::make_shared<Boundary>(mesh, topology, field.association, geometry);
  MarchingBoundary result;
  result.surfaces = {boundary->surface(field.wall, true), boundary->surface(field.wall, false)};
  result.onto = [boundary](std::span<NodeMove> moves) {
    parallel_for_with(
        moves.size(), k_grain, [&] { return boundary->geometry().projector(); },
        [&](std::size_t begin, std::size_t end, std::unique_ptr<Projector>& projector) {
          for (std::size_t i = begin; i < end; ++i) boundary->put_back(*projector, moves[i]);
        });
  };
  result.carry = [field](const CurvedMesh& before, CurvedMesh& after) {
    carry_wall(before, after, field);
  };
  return result;
}

}  // namespace camber
