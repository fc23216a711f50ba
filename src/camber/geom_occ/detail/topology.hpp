#pragma once
// Private: numbered shapes of a CAD body and their neighbours.
#include <camber/geom_occ/detail/shape_file.hpp>

#include <string>
#include <vector>

#include <TopTools_IndexedMapOfShape.hxx>
#include <TopoDS_Edge.hxx>
#include <TopoDS_Face.hxx>
#include <TopoDS_Vertex.hxx>

namespace camber::occ {

/// Tags as Gmsh gives them: sub-shapes of all solids first, then of shells, faces, wires, edges,
/// the whole.
class Topology {
 public:
  explicit Topology(const ShapeFile& file);

  [[nodiscard]] int count(int dim) const;
  [[nodiscard]] const TopoDS_Shape& whole() const { return whole_; }
  [[nodiscard]] TopoDS_Face face(int tag) const;
  [[nodiscard]] TopoDS_Edge edge(int tag) const;
  [[nodiscard]] TopoDS_Vertex vertex(int tag) const;
  [[nodiscard]] const TopoDS_Shape& shape(int dim, int tag) const;
  [[nodiscard]] int edge_tag(const TopoDS_Shape& edge) const { return edges_.FindIndex(edge); }
  [[nodiscard]] std::string name(int dim, int tag) const;

  [[nodiscard]] const std::vector<int>& faces_of_edge(int tag) const;
  [[nodiscard]] const std::vector<int>& edges_of_face(int tag) const;
  [[nodiscard]] std::vector<int> vertices_of_edge(int tag) const;

 private:
  TopoDS_Shape whole_;
  TopTools_IndexedMapOfShape faces_, edges_, vertices_;
  std::vector<std::vector<int>> edge2face_, face2edge_;
  std::vector<std::string> names_[3];
};

}  // namespace camber::occ
