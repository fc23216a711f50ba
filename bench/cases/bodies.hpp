#pragma once
// Analytic bodies with thin layers on them: what the ladder of smoothing cases is made of.
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "layer_meshes.hpp"

namespace camber::testing {

/// A mesh that can be made with any height of the first cell, and its CAD.
struct BodyCase {
  std::string body, filling;  // "sphere", "prisms"
  double edge = 0.0;          // mean edge of the surface mesh: what first cells are measured by
  /// @param first_over_edge  height of the first cell / edge
  std::function<MeshData(double first_over_edge)> mesh;
  std::function<std::unique_ptr<GeometryModel>()> model;
};

enum class CaseSize {
  small,  // about 100 faces, heights growing 30-fold from layer to layer: unit tests
  full    // about 400 faces, heights growing 3-fold
};

/// sphere, ellipsoid (3:1:0.5), wing (nose of a 10:1 ellipse), bump, torus-inside,
/// ellipsoid-inside, tip (2 faces round 180 degrees, [karman2022] Fig. 16) and corner (two walls
/// that meet in a concave edge), filled with prisms, hexes, tets (prisms cut in three) and caps
/// (hexes, pyramids on them, tets between the pyramids) where these exist.
[[nodiscard]] std::vector<BodyCase> body_cases(CaseSize size);
/// The one with that name. @throws std::invalid_argument if there is none
[[nodiscard]] BodyCase body_case(const std::string& body, const std::string& filling,
                                 CaseSize size);

/// Section in the x-z plane, swept along y from 0 to span: half an ellipse x = -a cos t, z = b sin
/// t (nose at x = -a), continued by straight sides of length `flat` up to x = flat. Exact NURBS;
/// parameter u runs from the lower end round the nose to the upper one, v along the span.
[[nodiscard]] BsplineSurface rounded_edge(double a, double b, double flat, double span);

/// Hexes in the corner between a floor z = f(x, y) and a wall x = g(y, z) over unit squares, both 0
/// along their common edge, layers on both. Vertex (i, j, k) is number i + n (j + m k), where n is
/// the number of `heights` (from 0 to 1), m that of the vertices along the edge. Surface 1 is the
/// floor, 2 the wall.
[[nodiscard]] MeshData concave_corner(const std::vector<double>& heights, Index m);
[[nodiscard]] std::unique_ptr<GeometryModel> concave_corner_model();

}  // namespace camber::testing
