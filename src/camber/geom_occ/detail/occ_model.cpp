#include <camber/geom_occ/detail/kernel_errors.hpp>
#include <camber/geom_occ/detail/kernel_shapes.hpp>
#include <camber/geom_occ/detail/occ_model.hpp>
#include <camber/geom_occ/detail/occ_projector.hpp>

#include <BRepBndLib.hxx>
#include <BRep_Tool.hxx>
#include <Bnd_Box.hxx>
#include <Precision.hxx>
#include <TopoDS.hxx>

namespace camber::occ {
namespace {

std::string label(GeomEntity entity) {
  static constexpr const char* k_kind[3] = {"vertex", "curve", "face"};
  const std::string kind = entity.dim >= 0 && entity.dim < 3 ? k_kind[entity.dim] : "entity";
  return "CAD " + kind + " " + std::to_string(entity.tag);
}

Box box_of(const TopoDS_Shape& shape) {
  // Both boxes hold the shape, and each is too large in places: the optimal one ignores the trim of
  // a part of a torus, the quick one takes in control points.
  Bnd_Box optimal, quick;
  BRepBndLib::AddOptimal(shape, optimal, false, false);
  BRepBndLib::Add(shape, quick, false);
  Box result;
  if (optimal.IsVoid() || quick.IsVoid()) return result;
  optimal.SetGap(0.0);
  quick.SetGap(0.0);
  Vec3 a, b, c, d;
  optimal.Get(a[0], a[1], a[2], b[0], b[1], b[2]);
  quick.Get(c[0], c[1], c[2], d[0], d[1], d[2]);
  result.add(a.cwiseMax(c));
  result.add(b.cwiseMin(d));
  return result;
}

Box scaled(const Box& box, double scale) {
  if (box.is_empty()) return box;
  Box result;
  result.add(Vec3(scale * box.lower));
  result.add(Vec3(scale * box.upper));
  return result;
}

}  // namespace

Body::Body(const ShapeFile& file)
    : topology_(file),
      curves_(new Lazy<CurveData>[at(topology_.count(1))]),
      faces_(new Lazy<FaceData>[at(topology_.count(2))]) {
  for (int dim = 0; dim < 3; ++dim) boxes_[dim].reset(new Lazy<Box>[at(topology_.count(dim))]);
}

void Body::check(GeomEntity entity) const {
  if (entity.dim < 0 || entity.dim > 2 || entity.tag < 1 ||
      entity.tag > topology_.count(entity.dim))
    throw GeometryError("the CAD model has no such entity", label(entity),
                        "check that mesh and CAD belong together");
}

const CurveData& Body::curve(int tag) const {
  check({1, tag});
  return curves_[at(tag - 1)].get([&] {
    return guarded(label({1, tag}),
                   [&] { return std::make_unique<const CurveData>(topology_.edge(tag)); });
  });
}

const FaceData& Body::face(int tag) const {
  check({2, tag});
  return faces_[at(tag - 1)].get([&] {
    return guarded(label({2, tag}), [&] {
      std::vector<std::pair<int, TopoDS_Shape>> edges;
      for (const int e : topology_.edges_of_face(tag)) edges.emplace_back(e, topology_.edge(e));
      return std::make_unique<const FaceData>(topology_.face(tag), edges);
    });
  });
}

Box Body::box(GeomEntity entity) const {
  check(entity);
  return boxes_[entity.dim][at(entity.tag - 1)].get([&] {
    return guarded(label(entity), [&] {
      return std::make_unique<const Box>(box_of(topology_.shape(entity.dim, entity.tag)));
    });
  });
}

Box Body::box() const {
  return box_.get([&] {
    auto result = std::make_unique<Box>();
    // Of the faces: construction points and lines that come with some files would spoil it.
    for (int tag = 1; tag <= topology_.count(2); ++tag) result->add(box({2, tag}));
    return std::unique_ptr<const Box>(std::move(result));
  });
}

int OccModel::count(int dim) const { return body_->topology().count(dim); }

std::string OccModel::name(GeomEntity entity) const {
  body_->check(entity);
  return body_->topology().name(entity.dim, entity.tag);
}

Box OccModel::box() const { return scaled(body_->box(), scale_); }
Box OccModel::box(GeomEntity entity) const { return scaled(body_->box(entity), scale_); }

double OccModel::tolerance(GeomEntity entity) const {
  body_->check(entity);
  const Topology& topology = body_->topology();
  if (entity.dim == 2) return scale_ * BRep_Tool::Tolerance(topology.face(entity.tag));
  if (entity.dim == 1) return scale_ * BRep_Tool::Tolerance(topology.edge(entity.tag));
  return scale_ * BRep_Tool::Tolerance(topology.vertex(entity.tag));
}

bool OccModel::is_degenerate(int curve) const { return body_->curve(curve).is_degenerate; }

bool OccModel::is_seam(int curve, int face) const {
  body_->check({1, curve});
  body_->check({2, face});
  return BRep_Tool::IsClosed(body_->topology().edge(curve), body_->topology().face(face));
}

bool OccModel::is_planar(int face) const {
  body_->check({2, face});
  return guarded(label({2, face}), [&] {
    return occ::is_planar(BRep_Tool::Surface(body_->topology().face(face)), Precision::Confusion());
  });
}

bool OccModel::is_straight(int curve) const {
  body_->check({1, curve});
  double first = 0.0, last = 0.0;
  const Handle(Geom_Curve) kernel = BRep_Tool::Curve(body_->topology().edge(curve), first, last);
  return !kernel.IsNull() && occ::is_straight(kernel);
}

std::vector<int> OccModel::faces_of_curve(int curve) const {
  body_->check({1, curve});
  return body_->topology().faces_of_edge(curve);
}

std::vector<int> OccModel::curves_of_face(int face) const {
  body_->check({2, face});
  return body_->topology().edges_of_face(face);
}

std::vector<int> OccModel::vertices_of_curve(int curve) const {
  body_->check({1, curve});
  return body_->topology().vertices_of_edge(curve);
}

GeometryModel::CurveRange OccModel::range(int curve) const {
  const CurveData& data = body_->curve(curve);
  return {data.first, data.last, data.period};
}

Vec2 OccModel::periods(int face) const { return body_->face(face).periods; }

Vec2 OccModel::curve_on_face(int curve, int face, double t, const std::optional<Vec2>& near) const {
  const FaceData& data = body_->face(face);
  const CurveData& edge = body_->curve(curve);
  const FaceEdge* side = data.find(curve);
  if (side == nullptr)
    throw GeometryError(label({1, curve}) + " does not bound " + label({2, face}), "CAD",
                        "check that mesh and CAD belong together");
  const double wrapped = t == edge.last ? t : wrap_period(t, edge.first, edge.period);
  return guarded(label({1, curve}), [&] { return edge_uv(data, *side, wrapped, near); });
}

std::unique_ptr<Projector> OccModel::projector() const {
  return std::make_unique<OccProjector>(body_, scale_);
}

void OccModel::set_scale(double scale) {
  if (!(scale > 0.0) || !std::isfinite(scale))
    throw GeometryError("the scale of a CAD model must be positive", std::to_string(scale),
                        "give a unit such as m, mm or in");
  scale_ = scale;
}

}  // namespace camber::occ
