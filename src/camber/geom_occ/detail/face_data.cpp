#include <camber/base/error.hpp>
#include <camber/geom_occ/detail/face_data.hpp>
#include <camber/geom_occ/detail/kernel_shapes.hpp>

#include <algorithm>
#include <cmath>

#include <BRepTools.hxx>
#include <BRepTopAdaptor_FClass2d.hxx>
#include <BRep_Tool.hxx>
#include <Precision.hxx>
#include <TopExp_Explorer.hxx>
#include <TopoDS.hxx>

namespace camber::occ {
namespace {

/// Parameters this near to a side of the rectangle (of its extent) lie on it.
constexpr double k_on_side = 1e-9;

/// All of the edge's curve runs along one side of the rectangle.
bool is_on_side(const Handle(Geom2d_Curve) & curve, double first, double last, const UvBox& box) {
  bool on[4] = {true, true, true, true};
  for (int i = 0; i <= 6; ++i) {
    const gp_Pnt2d p = curve->Value(first + (last - first) * i / 6.0);
    const Vec2 uv(p.X(), p.Y());
    for (int k = 0; k < 2; ++k) {
      const double close = k_on_side * (box.upper[k] - box.lower[k]);
      on[k] = on[k] && std::abs(uv[k] - box.lower[k]) <= close;
      on[2 + k] = on[2 + k] && std::abs(uv[k] - box.upper[k]) <= close;
    }
  }
  return on[0] || on[1] || on[2] || on[3];
}

}  // namespace

FaceData::FaceData(const TopoDS_Face& shape, const std::vector<std::pair<int, TopoDS_Shape>>& parts)
    : face(shape), is_reversed(shape.Orientation() == TopAbs_REVERSED) {
  const Handle(Geom_Surface) kernel = BRep_Tool::Surface(face);
  if (kernel.IsNull())
    throw GeometryError("a face has no surface", "CAD face", "export the model again");
  BRepTools::UVBounds(face, limits.lower[0], limits.upper[0], limits.lower[1], limits.upper[1]);
  double natural[4];
  kernel->Bounds(natural[0], natural[1], natural[2], natural[3]);
  for (int k = 0; k < 2; ++k) {  // the box of a trimming curve may be loose: not beyond the surface
    const bool is_periodic = k == 0 ? kernel->IsUPeriodic() : kernel->IsVPeriodic();
    if (is_periodic) {
      const double period = k == 0 ? kernel->UPeriod() : kernel->VPeriod();
      limits.upper[k] = std::min(limits.upper[k], limits.lower[k] + period);
    } else {
      limits.lower[k] = std::max(limits.lower[k], natural[2 * k]);
      limits.upper[k] = std::min(limits.upper[k], natural[2 * k + 1]);
    }
    if (Precision::IsInfinite(limits.lower[k]) || Precision::IsInfinite(limits.upper[k]) ||
        !(limits.lower[k] < limits.upper[k]))
      throw GeometryError("a face has no finite border", "CAD face", "trim the face, export again");
  }
  surface = make_surface(kernel, limits);
  periods = surface->periods();
  tree = std::make_unique<SurfaceTree>(*surface, limits);

  gap = std::max(BRep_Tool::Tolerance(face), Precision::Confusion());
  is_rectangle = true;
  std::vector<TrimGrid::Loop> loops;
  for (const auto& [tag, part] : parts) {
    const TopoDS_Edge edge = TopoDS::Edge(part);
    FaceEdge item;
    item.tag = tag;
    double first = 0.0, last = 0.0;
    item.curve =
        BRep_Tool::CurveOnSurface(TopoDS::Edge(edge.Oriented(TopAbs_FORWARD)), face, first, last);
    if (item.curve.IsNull()) continue;
    if (BRep_Tool::IsClosed(edge, face))
      item.seam_curve = BRep_Tool::CurveOnSurface(TopoDS::Edge(edge.Oriented(TopAbs_REVERSED)),
                                                  face, first, last);
    is_rectangle = is_rectangle && is_on_side(item.curve, first, last, limits) &&
                   (!item.is_seam() || is_on_side(item.seam_curve, first, last, limits));
    loops.push_back({item.curve, first, last});
    if (item.is_seam()) loops.push_back({item.seam_curve, first, last});
    if (!BRep_Tool::Degenerated(edge)) gap = std::max(gap, BRep_Tool::Tolerance(edge));
    edges.push_back(item);
  }
  if (is_rectangle) return;
  BRepTopAdaptor_FClass2d exact(face, k_on_side * (limits.upper - limits.lower).minCoeff());
  trim = TrimGrid(limits, loops, [&](const Vec2& uv) {
    return exact.Perform(gp_Pnt2d(uv[0], uv[1]), true) != TopAbs_OUT;
  });
}

const FaceEdge* FaceData::find(int edge) const {
  const auto found =
      std::find_if(edges.begin(), edges.end(), [&](const FaceEdge& e) { return e.tag == edge; });
  return found == edges.end() ? nullptr : &*found;
}

Vec2 FaceData::wrapped(const Vec2& uv) const {
  Vec2 result = uv;
  for (int k = 0; k < 2; ++k)
    // The upper end of a whole period stays: it is the other side of the seam.
    if (uv[k] < limits.lower[k] || uv[k] > limits.upper[k])
      result[k] = wrap_period(uv[k], limits.lower[k], periods[k]);
  return result;
}

Vec2 FaceData::beside(const Vec2& uv, const Vec2& near) const {
  return {nearest_period(uv[0], near[0], periods[0]), nearest_period(uv[1], near[1], periods[1])};
}

Vec2 edge_uv(const FaceData& face, const FaceEdge& edge, double t,
             const std::optional<Vec2>& near) {
  const gp_Pnt2d p = edge.curve->Value(t);
  Vec2 uv(p.X(), p.Y());
  if (!near) return uv;
  if (edge.is_seam()) {
    const gp_Pnt2d q = edge.seam_curve->Value(t);
    const Vec2 other(q.X(), q.Y());
    if ((other - *near).squaredNorm() < (uv - *near).squaredNorm()) uv = other;
  }
  return face.beside(uv, *near);
}

}  // namespace camber::occ
