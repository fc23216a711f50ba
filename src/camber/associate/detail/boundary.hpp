#pragma once
// The boundary faces of a mesh with what matching them to a CAD needs to know.
#include <camber/mesh/topology.hpp>

#include <array>
#include <vector>

namespace camber {

/// Faces with a patch (boundary faces and listed interfaces), numbered by slots of their own.
struct Boundary {
  struct Face {
    Index face = k_none;  // topology face
    int entity = 0;       // surface entity of the file, 0 if it lists none
    int corners = 0;
    Vec3 centre = Vec3::Zero(), normal = Vec3::Zero();  // normal: out of the first cell
    double shortest = 0.0, longest = 0.0;               // edge
    double area = 0.0;
  };
  std::vector<Face> faces;
  std::vector<Index> face_slot;                  // topology face -> slot or -1
  std::vector<Index> vertices;                   // slot -> mesh vertex
  std::vector<Index> vertex_slot;                // mesh vertex -> slot or -1
  std::vector<double> longest_at;                // by vertex slot: longest boundary edge
  std::vector<std::array<Index, 2>> edge_faces;  // topology edge -> face slots or -1
};

[[nodiscard]] Boundary collect_boundary(const LinearMesh& mesh, const Topology& topology);

}  // namespace camber
