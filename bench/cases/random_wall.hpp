#pragma once
// Random hybrid layers on random walls, the same on every machine for a given seed.
#include <camber/pipeline/options.hpp>

#include <cstdint>
#include <string>

#include "layer_meshes.hpp"

namespace camber::testing {

struct RandomCase {
  std::uint32_t seed = 0;
  double edge = 0.0;             // mean edge of the wall
  double first_over_edge = 0.0;  // 1e-6 .. 1e-1, evenly in the logarithm
  double growth = 0.0;
  bool is_all_tets = false;  // else hexes and prisms in one surface, pyramids and tets on top
  bool is_normal = false;    // layers along the wall's normals, else straight up
  MeshData mesh;
  std::unique_ptr<GeometryModel> model;
  CurveOptions options;  // highest order 2 .. 4; lowest 1 or the same

  [[nodiscard]] std::string text() const;  // one line
};

/// A wall of 2 to 5 bumps and hollows (Gaussians in a cubic B-spline over the unit square, flat at
/// its border), meshed by quadrilaterals with moved vertices, some of them cut; layers on it.
[[nodiscard]] RandomCase random_case(std::uint32_t seed);

}  // namespace camber::testing
