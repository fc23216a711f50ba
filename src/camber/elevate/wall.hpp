#pragma once
// The part of the boundary that lies on CAD, and how straight and curved wall relate.
#include <camber/associate/association.hpp>
#include <camber/mesh/topology.hpp>

#include <array>
#include <cstdint>
#include <vector>

namespace camber {

/// One corner of the wall as one patch sees it: where it is on the CAD and which way is out.
struct WallCorner {
  Index vertex = k_none;
  Index patch = k_none;
  GeomEntity face;         // CAD face of the patch's group that is nearest
  Vec2 uv = Vec2::Zero();  // parameters on it
  Vec3 normal =
      Vec3::Zero();  // unit, out of the cells; averaged facets where the CAD has none (poles)
};

/// Faces on CAD that the layers stand on, their edges and corners, numbered by slots of their own:
/// all patches of kind `cad`, and the planes on CAD that prisms or hexahedra stand on and that
/// continue a curved wall (a blunt trailing edge, a flat body side; but not a symmetry plane that
/// the layers end on).
struct Wall {
  std::vector<std::uint8_t> is_wall_patch;       // by patch
  std::vector<Index> faces;                      // slot -> topology face
  std::vector<Index> face_slot;                  // topology face -> slot or -1
  std::vector<Index> edges;                      // slot -> topology edge
  std::vector<Index> edge_slot;                  // topology edge -> slot or -1
  std::vector<std::array<Index, 2>> edge_faces;  // edge slot -> face slots ([1] may be -1)
  std::vector<WallCorner> corners;
  std::vector<std::array<Index, 4>> face_corners;  // face slot -> corners, in the face's frame
  std::vector<Vec3> facet_normal;                  // unit, out of the cell, of the straight face

  [[nodiscard]] std::size_t face_count() const { return faces.size(); }
  [[nodiscard]] std::size_t edge_count() const { return edges.size(); }
};

/// Collects the wall and projects its corners. Threads: runs parallel inside.
[[nodiscard]] Wall build_wall(const LinearMesh& mesh, const Topology& topology,
                              const Association& association, const GeometryModel& model);

}  // namespace camber
