#include <camber/base/ids.hpp>
#include <camber/geom_occ/detail/topology.hpp>

#include <algorithm>

#include <BRepLib.hxx>
#include <BRep_Tool.hxx>
#include <TopExp.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

namespace camber::occ {
namespace {

void add_once(std::vector<int>& list, int value) {
  if (std::find(list.begin(), list.end(), value) == list.end()) list.push_back(value);
}

}  // namespace

Topology::Topology(const ShapeFile& file) : whole_(file.shape) {
  const auto map_parts = [&](const TopoDS_Shape& part) {
    TopExp::MapShapes(part, TopAbs_FACE, faces_);
    TopExp::MapShapes(part, TopAbs_EDGE, edges_);
    TopExp::MapShapes(part, TopAbs_VERTEX, vertices_);
  };
  for (const TopAbs_ShapeEnum kind :
       {TopAbs_SOLID, TopAbs_SHELL, TopAbs_FACE, TopAbs_WIRE, TopAbs_EDGE})
    for (TopExp_Explorer i(whole_, kind); i.More(); i.Next()) map_parts(i.Current());
  map_parts(whole_);

  for (int e = 1; e <= edges_.Extent();
       ++e) {  // edges that only have curves in their faces' parameters
    const TopoDS_Edge edge = TopoDS::Edge(edges_(e));
    double first = 0.0, last = 0.0;
    if (!BRep_Tool::Degenerated(edge) && BRep_Tool::Curve(edge, first, last).IsNull())
      BRepLib::BuildCurve3d(edge);
  }
  edge2face_.resize(at(edges_.Extent()));
  face2edge_.resize(at(faces_.Extent()));
  for (int f = 1; f <= faces_.Extent(); ++f) {
    for (TopExp_Explorer i(faces_(f), TopAbs_EDGE); i.More(); i.Next()) {
      const int e = edges_.FindIndex(i.Current());
      add_once(edge2face_[at(e - 1)], f);
      add_once(face2edge_[at(f - 1)], e);
    }
  }
  for (int dim = 0; dim < 3; ++dim) {
    for (int tag = 1; tag <= count(dim); ++tag) {
      const auto found = file.names.find(shape(dim, tag).TShape().get());
      names_[dim].push_back(found == file.names.end() ? std::string() : found->second);
    }
  }
}

int Topology::count(int dim) const {
  return dim == 2   ? faces_.Extent()
         : dim == 1 ? edges_.Extent()
         : dim == 0 ? vertices_.Extent()
                    : 0;
}

const TopoDS_Shape& Topology::shape(int dim, int tag) const {
  return dim == 2 ? faces_(tag) : dim == 1 ? edges_(tag) : vertices_(tag);
}

TopoDS_Face Topology::face(int tag) const { return TopoDS::Face(faces_(tag)); }
TopoDS_Edge Topology::edge(int tag) const { return TopoDS::Edge(edges_(tag)); }
TopoDS_Vertex Topology::vertex(int tag) const { return TopoDS::Vertex(vertices_(tag)); }

std::string Topology::name(int dim, int tag) const { return names_[dim][at(tag - 1)]; }

const std::vector<int>& Topology::faces_of_edge(int tag) const { return edge2face_[at(tag - 1)]; }
const std::vector<int>& Topology::edges_of_face(int tag) const { return face2edge_[at(tag - 1)]; }

std::vector<int> Topology::vertices_of_edge(int tag) const {
  TopoDS_Vertex first, last;
  TopExp::Vertices(edge(tag), first, last);
  std::vector<int> result;
  for (const TopoDS_Vertex& v : {first, last})
    if (!v.IsNull()) add_once(result, vertices_.FindIndex(v));
  return result;
}

}  // namespace camber::occ
