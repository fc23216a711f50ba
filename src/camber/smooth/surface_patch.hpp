#pragma once
// Slides the high-order nodes of a few wall faces along their surface until no face is folded.
#include <camber/base/ids.hpp>
#include <camber/basis/shape.hpp>

#include <array>
#include <functional>
#include <vector>

namespace camber {

/// One curved face of the patch; all faces have the patch's order.
struct SurfaceFace {
  Shape shape = Shape::triangle;
  std::vector<Index> nodes;           // canonical lattice order, into SurfacePatch::nodes
  Points straight;                    // the straight face's lattice nodes
  std::array<Vec3, 4> corner_normal;  // unit; which way is up at the corners, all to one side
  double good_enough = 0.0;           // distance to the surface not worth a slide (fit_surface)
};

struct SurfacePatch {
  int order = 2;
  Points nodes;
  std::vector<Vec2> uv;               // parameters of the free nodes on their surface
  std::vector<std::uint8_t> is_free;  // nodes that may slide
  std::vector<SurfaceFace> faces;
};

/// Point of a node's surface at some parameters, and the derivatives by them.
struct SurfaceSample {
  Vec3 point, du, dv;
};
using OnSurface = std::function<SurfaceSample(Index node, const Vec2& uv)>;

/// Minimises the sum over faces of the mean of |T|^2 / (2 h), T = J W^-1 (3 x 2), the surface form
/// of the weighted condition number ([karman2022] eq. (4)) with the signed area ratio tau = ((dT/dx
/// x dT/dy) . n), n the interpolated corner normal, regularised to h while some tau <= 0. The ideal
/// W of a triangle has the lengths of its curved edges as they are given: where the surface turns
/// inside a face the straight one may be a sliver, or stand upright, when the curved one is
/// neither. Quadrilaterals take the straight face's. The unknowns are the parameters of the free
/// nodes (L-BFGS, in units of length at the start), so that every state lies on the surface.
/// @return true if every sample ends with tau clearly positive; else nodes and parameters are as
/// they were given
[[nodiscard]] bool smooth_surface(SurfacePatch& patch, const OnSurface& on_surface);

}  // namespace camber
