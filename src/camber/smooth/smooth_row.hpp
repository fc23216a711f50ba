#pragma once
// What smoothing says of itself while it runs: data, shown by whoever called it.
#include <camber/base/ids.hpp>
#include <camber/base/vec.hpp>
#include <camber/basis/shape.hpp>

#include <cstddef>
#include <functional>
#include <string>

namespace camber {

/// State of the mesh at the start of one iteration; in the last row of a pass, the state it leaves.
struct SmoothRow {
  std::string stage;                  // "surface" or "volume"
  int pass = 1;                       // of the stage
  int iteration = 0;                  // of the pass
  std::size_t active_nodes = 0;       // that are to be moved
  std::size_t negative_elements = 0;  // with a cost below 0 somewhere
  std::size_t elevated_elements = 0;  // raised in order since smoothing began
  double worst_cost = 1.0;            // lowest cost C, eq. (2), of any element looked at
  // The element that has it.
  Vec3 place = Vec3::Zero();  // its centre
  GlobalId element = 0;
  Shape shape = Shape::point;
  int order = 0;
};

/// Called for every row as it is made; may throw (Cancelled) to end the work.
using SmoothListener = std::function<void(const SmoothRow&)>;

}  // namespace camber
