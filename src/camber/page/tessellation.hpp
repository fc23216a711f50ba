#pragma once
// Curved faces as triangles: as many as their curvature needs, without cracks.
#include <camber/page/boundary_faces.hpp>

#include <cstdint>
#include <vector>

namespace camber {

struct TessellationOptions {
  double turn = 0.08;  // an edge may turn by this much between two of its points [rad]
  int max_level = 16;  // pieces of an edge at most
  std::size_t max_triangles = 500'000;  // above it all faces get fewer pieces
};

/// Triangles of many faces, face after face. Points are on the faces' polynomials. Every edge is
/// evaluated once, from the first face that has it, and both its faces end in just these points:
/// no cracks, though the two may be divided differently. A face of level n has the nodes of the
/// n-lattice; those on an edge of fewer pieces are moved along it to the nearest point of that
/// edge, and triangles that lose their area by it are left out.
struct Tessellation {
  std::vector<std::uint8_t> corners;                    // by face: 3 or 4
  std::vector<std::uint8_t> level;                      // by face
  std::vector<std::uint8_t> own_edges;                  // by face, bit k: edge k is met here first
  std::vector<std::uint32_t> first_point;               // by face, and one more
  std::vector<std::uint32_t> first_triangle;            // by face, and one more
  Points points, normals;                               // unit normals, outward; by point
  std::vector<std::array<std::uint16_t, 3>> triangles;  // counted from the face's first point
  bool is_reduced = false;  // max_triangles made the levels lower than wanted
};

/// @param finer  by face: least level, for fields that vary inside a face; empty: 1 everywhere
/// Threads: parallel inside, the same bits for any number. Throws nothing of its own.
[[nodiscard]] Tessellation tessellate(const ElementList& cells,
                                      const std::vector<BoundaryFace>& faces,
                                      const std::vector<int>& finer = {},
                                      const TessellationOptions& options = {});

}  // namespace camber
