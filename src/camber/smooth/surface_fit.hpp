#pragma once
// Slides the high-order nodes of wall faces so that the faces follow the surface more closely.
#include <camber/smooth/surface_patch.hpp>

#include <functional>

namespace camber {

/// Nearest points on the surface for points of the faces: `faces[i]` is the face (number in
/// SurfacePatch::faces) of `points[i]`. A point without answer is its own foot. Called with the
/// same faces in the same order every time, so that the answers of the last call may be seeds.
using NearestPoints =
    std::function<void(std::span<const Index> faces, const Points& points, Points& feet)>;

struct SurfaceFit {
  double before = 0.0, after = 0.0;  // sqrt of the mean squared distance at the Gauss points
  int iterations = 0;
};

/// Minimises  sum over faces of F_f / (F_f0 + g_f^2 A_f)  +  k sum over nodes of s_n |t_n|^2  +  b
/// E over the parameters t of the free nodes (L-BFGS). F_f = int |x - foot(x)|^2 ds at the
/// sixth-order Gauss points of eq. (1) in [karman2022], F_f0 its value at the start, g_f the
/// distance that is good enough, A_f the area; each face counts by what it was, so that none pays
/// for another. The second term (s_n: sum of |dN/dx|^2, a strain squared) leaves nodes alone that
/// gain little. E is the shape energy of smooth_surface, with little weight: faces cannot fold. d|x
/// - foot(x)|^2 / dx = 2 (x - foot(x)). The state is kept only if the total distance fell and the
/// least tau did not fall below a fifth of the start's (or of 1); else the patch is as it was
/// given, with after = before.
SurfaceFit fit_surface(SurfacePatch& patch, const OnSurface& on_surface,
                       const NearestPoints& nearest);

}  // namespace camber
