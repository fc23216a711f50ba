#pragma once
// The user's linear hybrid mesh, immutable once read.
#include <camber/base/ids.hpp>
#include <camber/mesh/mesh_data.hpp>

#include <array>
#include <span>
#include <string>
#include <vector>

namespace camber {

struct LinearMesh {
  Points vertices;
  std::vector<GlobalId> vertex_tags;     // numbers of the file
  std::vector<EntityKey> vertex_entity;  // classification of the file; dim -1 where unknown

  std::vector<Shape> cell_shape;
  std::vector<Index> cell_offset;    // into cell_vertices; cells + 1 entries
  std::vector<Index> cell_vertices;  // corner order of shape.hpp
  std::vector<int> cell_region;      // volume entity
  std::vector<GlobalId> cell_tags;

  /// Surface elements of the file: mostly boundary faces, sometimes faces between two regions.
  std::vector<Shape> patch_face_shape;
  std::vector<std::array<Index, 4>> patch_face_vertices;  // [3] = -1 for triangles
  std::vector<int> patch_face_entity;                     // surface entity tag

  struct Line {
    Index a, b;
    int curve;  // curve entity tag
  };
  std::vector<Line> lines;

  std::vector<EntityRecord> entities;
  std::vector<PhysicalName> physical_names;
  Box box;
  std::size_t sewn_vertices = 0;  // joined by sew_coincident_vertices

  [[nodiscard]] std::size_t cell_count() const { return cell_shape.size(); }
  [[nodiscard]] std::span<const Index> cell(Index c) const {
    return {cell_vertices.data() + cell_offset[at(c)],
            static_cast<std::size_t>(cell_offset[at(c) + 1] - cell_offset[at(c)])};
  }
  /// Length of the box diagonal: what relative tolerances refer to.
  [[nodiscard]] double size() const { return box.diagonal(); }
  /// Name of an entity: the user's physical name, else "surface 7" and the like.
  [[nodiscard]] std::string entity_name(EntityKey key) const;
};

/// Makes the linear mesh and checks that it can be curved: volume cells present, corners only
/// (order 1), every cell certified positive. Parts that touch without sharing vertices are sewn
/// (sew.hpp).
/// @throws MeshError listing the first ten inverted or degenerate cells with number, shape and
/// centre.
[[nodiscard]] LinearMesh build_linear_mesh(const MeshData& data);

}  // namespace camber
