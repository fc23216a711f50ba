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
  std::array<Vec3, 4> corner_normal;  // unit, of the surface at the corners, all to one side
};

struct SurfacePatch {
  int order = 2;
  Points nodes;
  std::vector<std::uint8_t> is_free;  // nodes that may slide
  std::vector<SurfaceFace> faces;
};

/// Where a node that was moved to x comes to lie on its surface, and the unit normal there.
struct SurfaceFoot {
  Vec3 point, normal;
};
using OntoSurface = std::function<SurfaceFoot(Index node, const Vec3& x)>;

/// Minimises the sum over faces of the mean of |T|^2 / (2 h), T = J W^-1 (3 x 2), the surface form
/// of the weighted condition number ([karman2022] eq. (4)) with the signed area ratio tau = ((dT/dx
/// x dT/dy) . n), n the interpolated corner normal, regularised to h while some tau <= 0. Free
/// nodes move in their tangent planes (L-BFGS) and are put back on the surface after each round.
/// @return true if every sample ends with tau clearly positive; else the nodes are as they were
/// given
[[nodiscard]] bool smooth_surface(SurfacePatch& patch, const OntoSurface& onto);

}  // namespace camber
