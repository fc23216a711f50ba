#pragma once
// Models of one face with an exact closest point: tests, examples and studies without a CAD kernel.
#include <camber/geom/analytic_surface.hpp>
#include <camber/geom/geometry_model.hpp>

#include <memory>

namespace camber {

/// A model whose one face (tag 1) is the whole surface; no curves, no vertices. The normal is su x
/// sv. `name`, if given, is the face's name.
[[nodiscard]] std::unique_ptr<GeometryModel> make_analytic_model(
    std::unique_ptr<AnalyticSurface> surface, std::string name = {});

/// Rectangle origin + u a + v b; a and b at right angles, normal a x b.
[[nodiscard]] std::unique_ptr<GeometryModel> make_plane(const Vec3& origin, const Vec3& a,
                                                        const Vec3& b);
/// Longitude u, latitude v, poles at +-z; normals point outwards, as for all that follow.
[[nodiscard]] std::unique_ptr<GeometryModel> make_sphere(const Vec3& centre, double radius);
/// Without caps; `axis` runs from the centre of one rim to the centre of the other.
[[nodiscard]] std::unique_ptr<GeometryModel> make_cylinder(const Vec3& base, const Vec3& axis,
                                                           double radius);
[[nodiscard]] std::unique_ptr<GeometryModel> make_torus(const Vec3& centre, const Vec3& axis,
                                                        double major, double minor);
[[nodiscard]] std::unique_ptr<GeometryModel> make_ellipsoid(const Vec3& centre,
                                                            const Vec3& semi_axes);
[[nodiscard]] std::unique_ptr<GeometryModel> make_bspline_patch(BsplineSurface patch);

}  // namespace camber
