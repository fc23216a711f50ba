#pragma once
// Private: kernel curves and surfaces as ParametricCurve and ParametricSurface.
#include <camber/geom/parametric.hpp>

#include <memory>

#include <Geom_Curve.hxx>
#include <Geom_Surface.hxx>
#include <gp_XYZ.hxx>

namespace camber::occ {

/// Evaluator of a kernel surface over `domain`; B-splines are copied into our own evaluator, others
/// are asked through Geom_Surface, which keeps no caches: any number of threads may share it. A
/// direction in which the surface closes on itself over the whole domain is made periodic.
[[nodiscard]] std::unique_ptr<ParametricSurface> make_surface(Handle(Geom_Surface) surface,
                                                              const UvBox& domain);

/// The same for a curve on [first, last]; `is_closed`: both ends are one vertex.
[[nodiscard]] std::unique_ptr<ParametricCurve> make_curve(Handle(Geom_Curve) curve, double first,
                                                          double last, bool is_closed);

/// All points of the curve lie on one line (exactly known for lines and B-splines).
[[nodiscard]] bool is_straight(Handle(Geom_Curve) curve);

/// All points of the surface lie in one plane, within `tolerance`.
[[nodiscard]] bool is_planar(const Handle(Geom_Surface) & surface, double tolerance);

inline Vec3 to_vec(const gp_XYZ& p) { return {p.X(), p.Y(), p.Z()}; }

}  // namespace camber::occ
