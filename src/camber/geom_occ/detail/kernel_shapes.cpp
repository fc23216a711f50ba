#include <camber/geom/bspline.hpp>
#include <camber/geom_occ/detail/kernel_shapes.hpp>

#include <cmath>

#include <GeomAdaptor_Curve.hxx>
#include <GeomAdaptor_Surface.hxx>
#include <GeomConvert.hxx>
#include <GeomLib_IsPlanarSurface.hxx>
#include <Geom_BSplineCurve.hxx>
#include <Geom_BSplineSurface.hxx>
#include <Geom_BezierCurve.hxx>
#include <Geom_BezierSurface.hxx>
#include <Geom_Line.hxx>
#include <Geom_RectangularTrimmedSurface.hxx>
#include <Geom_TrimmedCurve.hxx>
#include <Standard_Failure.hxx>
#include <TColStd_Array1OfReal.hxx>

namespace camber::occ {
namespace {

std::vector<double> to_vector(const TColStd_Array1OfReal& values) {
  return {values.begin(), values.end()};
}

// ---- surfaces ----

/// Copy of a kernel B-spline that is not periodic any more.
BsplineSurface copy_of(const Handle(Geom_BSplineSurface) & kernel) {
  std::vector<Vec3> poles;
  std::vector<double> weights;
  const bool is_rational = kernel->IsURational() || kernel->IsVRational();
  for (int i = 1; i <= kernel->NbUPoles(); ++i) {
    for (int j = 1; j <= kernel->NbVPoles(); ++j) {
      poles.push_back(to_vec(kernel->Pole(i, j).XYZ()));
      if (is_rational) weights.push_back(kernel->Weight(i, j));
    }
  }
  return {BsplineBasis(kernel->UDegree(), to_vector(kernel->UKnotSequence())),
          BsplineBasis(kernel->VDegree(), to_vector(kernel->VKnotSequence())), poles, weights};
}

class SplineSurface final : public ParametricSurface {
 public:
  SplineSurface(BsplineSurface spline, const UvBox& domain, const Vec2& periods)
      : spline_(std::move(spline)),
        natural_(spline_.domain()),
        domain_(domain),
        periods_(periods) {}

  SurfaceJet jet(const Vec2& uv) const override {
    return spline_.jet({wrap_period(uv[0], natural_.lower[0], periods_[0]),
                        wrap_period(uv[1], natural_.lower[1], periods_[1])});
  }
  UvBox domain() const override { return domain_; }
  Vec2 periods() const override { return periods_; }
  std::vector<double> breaks(int direction) const override {
    // The domain of a periodic spline may reach over its knots' end.
    std::vector<double> result{domain_.lower[direction]};
    const double first = natural_.lower[direction], period = periods_[direction];
    const std::vector<double> knots = spline_.breaks(direction);
    const int turns =
        period > 0.0 ? static_cast<int>(std::floor((domain_.lower[direction] - first) / period))
                     : 0;
    for (int turn = turns; turn <= turns + (period > 0.0 ? 1 : 0); ++turn)
      for (const double knot : knots)
        if (const double t = knot + turn * period;
            t > result.back() && t < domain_.upper[direction])
          result.push_back(t);
    result.push_back(domain_.upper[direction]);
    return result;
  }

 private:
  BsplineSurface spline_;
  UvBox natural_, domain_;
  Vec2 periods_;
};

class KernelSurface final : public ParametricSurface {
 public:
  KernelSurface(Handle(Geom_Surface) surface, const UvBox& domain, const Vec2& periods)
      : surface_(std::move(surface)), domain_(domain), periods_(periods) {
    surface_->Bounds(natural_.lower[0], natural_.upper[0], natural_.lower[1], natural_.upper[1]);
  }

  SurfaceJet jet(const Vec2& uv) const override {
    gp_Pnt s;
    gp_Vec su, sv, suu, svv, suv;  // zero vectors
    const double u = wrap_period(uv[0], natural_.lower[0], periods_[0]);
    const double v = wrap_period(uv[1], natural_.lower[1], periods_[1]);
    try {
      surface_->D2(u, v, s, su, sv, suu, svv, suv);
    } catch (const Standard_Failure&) {  // offset surfaces at singular points have a place only
      su = sv = suu = svv = suv = gp_Vec();
      surface_->D0(u, v, s);
    }
    return {to_vec(s.XYZ()),   to_vec(su.XYZ()),  to_vec(sv.XYZ()),
            to_vec(suu.XYZ()), to_vec(suv.XYZ()), to_vec(svv.XYZ())};
  }
  UvBox domain() const override { return domain_; }
  Vec2 periods() const override { return periods_; }
  std::vector<double> breaks(int direction) const override {
    const GeomAdaptor_Surface adaptor(surface_, domain_.lower[0], domain_.upper[0],
                                      domain_.lower[1], domain_.upper[1]);
    const int count =
        direction == 0 ? adaptor.NbUIntervals(GeomAbs_C2) : adaptor.NbVIntervals(GeomAbs_C2);
    TColStd_Array1OfReal values(1, count + 1);
    direction == 0 ? adaptor.UIntervals(values, GeomAbs_C2)
                   : adaptor.VIntervals(values, GeomAbs_C2);
    return to_vector(values);
  }

 private:
  Handle(Geom_Surface) surface_;
  UvBox natural_, domain_;
  Vec2 periods_;
};

// ---- curves ----

BsplineCurve copy_of(const Handle(Geom_BSplineCurve) & kernel) {
  std::vector<Vec3> poles;
  std::vector<double> weights;
  for (int i = 1; i <= kernel->NbPoles(); ++i) {
    poles.push_back(to_vec(kernel->Pole(i).XYZ()));
    if (kernel->IsRational()) weights.push_back(kernel->Weight(i));
  }
  return {BsplineBasis(kernel->Degree(), to_vector(kernel->KnotSequence())), poles, weights};
}

/// A stretch of a curve; closed: parameters are taken modulo its length.
class CurveStretch : public ParametricCurve {
 public:
  CurveStretch(double first, double last, bool is_closed)
      : first_(first), last_(last), period_(is_closed ? last - first : 0.0) {}
  double first() const override { return first_; }
  double last() const override { return last_; }
  double period() const override { return period_; }

 protected:
  /// Into [first, last]; the last parameter itself stays.
  double wrapped(double t) const { return t == last_ ? t : wrap_period(t, first_, period_); }

 private:
  double first_, last_, period_;
};

class SplineCurve final : public CurveStretch {
 public:
  SplineCurve(BsplineCurve spline, double natural_period, double first, double last, bool is_closed)
      : CurveStretch(first, last, is_closed),
        spline_(std::move(spline)),
        natural_period_(natural_period) {}

  CurveJet jet(double t) const override {
    return spline_.jet(wrap_period(wrapped(t), spline_.first(), natural_period_));
  }
  std::vector<double> breaks() const override {
    std::vector<double> result{first()};
    const int turns =
        natural_period_ > 0.0
            ? static_cast<int>(std::floor((first() - spline_.first()) / natural_period_))
            : 0;
    for (int turn = turns; turn <= turns + (natural_period_ > 0.0 ? 1 : 0); ++turn)
      for (const double knot : spline_.breaks())
        if (const double t = knot + turn * natural_period_; t > result.back() && t < last())
          result.push_back(t);
    result.push_back(last());
    return result;
  }

 private:
  BsplineCurve spline_;
  double natural_period_;
};

class KernelCurve final : public CurveStretch {
 public:
  KernelCurve(Handle(Geom_Curve) curve, double first, double last, bool is_closed)
      : CurveStretch(first, last, is_closed), curve_(std::move(curve)) {}

  CurveJet jet(double t) const override {
    gp_Pnt c;
    gp_Vec ct, ctt;
    curve_->D2(wrapped(t), c, ct, ctt);
    return {to_vec(c.XYZ()), to_vec(ct.XYZ()), to_vec(ctt.XYZ())};
  }
  std::vector<double> breaks() const override {
    const GeomAdaptor_Curve adaptor(curve_, first(), last());
    TColStd_Array1OfReal values(1, adaptor.NbIntervals(GeomAbs_C2) + 1);
    adaptor.Intervals(values, GeomAbs_C2);
    return to_vector(values);
  }

 private:
  Handle(Geom_Curve) curve_;
};

Handle(Geom_Curve) untrimmed(Handle(Geom_Curve) curve) {
  while (const auto trimmed = Handle(Geom_TrimmedCurve)::DownCast(curve))
    curve = trimmed->BasisCurve();
  return curve;
}

/// Closes on itself over the whole domain, though not periodic.
bool is_closed_over(bool is_closed, double first, double last, double lower, double upper) {
  return is_closed && upper - lower >= (last - first) * (1.0 - 1e-9);
}

}  // namespace

std::unique_ptr<ParametricSurface> make_surface(Handle(Geom_Surface) surface, const UvBox& domain) {
  while (const auto trimmed = Handle(Geom_RectangularTrimmedSurface)::DownCast(surface))
    surface = trimmed->BasisSurface();
  if (const auto bezier = Handle(Geom_BezierSurface)::DownCast(surface))
    surface = GeomConvert::SurfaceToBSplineSurface(bezier);
  double u0 = 0.0, u1 = 0.0, v0 = 0.0, v1 = 0.0;
  surface->Bounds(u0, u1, v0, v1);
  Vec2 periods(surface->IsUPeriodic() ? surface->UPeriod() : 0.0,
               surface->IsVPeriodic() ? surface->VPeriod() : 0.0);
  if (periods[0] == 0.0 &&
      is_closed_over(surface->IsUClosed(), u0, u1, domain.lower[0], domain.upper[0]))
    periods[0] = u1 - u0;
  if (periods[1] == 0.0 &&
      is_closed_over(surface->IsVClosed(), v0, v1, domain.lower[1], domain.upper[1]))
    periods[1] = v1 - v0;
  if (const auto spline = Handle(Geom_BSplineSurface)::DownCast(surface)) {
    const auto copy = Handle(Geom_BSplineSurface)::DownCast(spline->Copy());
    if (copy->IsUPeriodic()) copy->SetUNotPeriodic();
    if (copy->IsVPeriodic()) copy->SetVNotPeriodic();
    return std::make_unique<SplineSurface>(copy_of(copy), domain, periods);
  }
  return std::make_unique<KernelSurface>(surface, domain, periods);
}

std::unique_ptr<ParametricCurve> make_curve(Handle(Geom_Curve) curve, double first, double last,
                                            bool is_closed) {
  curve = untrimmed(curve);
  if (const auto bezier = Handle(Geom_BezierCurve)::DownCast(curve))
    curve = GeomConvert::CurveToBSplineCurve(bezier);
  if (const auto spline = Handle(Geom_BSplineCurve)::DownCast(curve)) {
    const double period = spline->IsPeriodic() ? spline->Period() : 0.0;
    const auto copy = Handle(Geom_BSplineCurve)::DownCast(spline->Copy());
    if (copy->IsPeriodic()) copy->SetNotPeriodic();
    return std::make_unique<SplineCurve>(copy_of(copy), period, first, last, is_closed);
  }
  return std::make_unique<KernelCurve>(curve, first, last, is_closed);
}

bool is_straight(Handle(Geom_Curve) curve) {
  curve = untrimmed(curve);
  if (!Handle(Geom_Line)::DownCast(curve).IsNull()) return true;
  if (const auto bezier = Handle(Geom_BezierCurve)::DownCast(curve))
    curve = GeomConvert::CurveToBSplineCurve(bezier);
  const auto spline = Handle(Geom_BSplineCurve)::DownCast(curve);
  if (spline.IsNull()) return false;
  const Vec3 first = to_vec(spline->Pole(1).XYZ());
  const Vec3 chord = to_vec(spline->Pole(spline->NbPoles()).XYZ()) - first;
  for (int i = 2; i < spline->NbPoles(); ++i) {
    const Vec3 pole = to_vec(spline->Pole(i).XYZ()) - first;
    if (chord.cross(pole).norm() > 1e-10 * chord.squaredNorm()) return false;
  }
  return true;
}

bool is_planar(const Handle(Geom_Surface) & surface, double tolerance) {
  return GeomLib_IsPlanarSurface(surface, tolerance).IsPlanar();
}

}  // namespace camber::occ
