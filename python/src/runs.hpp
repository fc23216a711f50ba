#pragma once
// What the bindings of runs and of pages share.
#include <camber/pipeline/curve.hpp>

#include <string>

#include "bindings.hpp"

namespace camber::python {

/// A result with the options it was made with, which say how it is exported. A geometry is kept to
/// measure on, with the scale that the run found.
struct Run {
  CurveResult result;
  CurveOptions options;
  std::shared_ptr<Geometry> geometry;
  double scale = 1.0;

  [[nodiscard]] bool is_certified() const {
    return result.report.validity.invalid + result.report.validity.undecided == 0;
  }
};

/// Mesh length per CAD length, which is read in millimetres; 0: found. @throws OptionError
[[nodiscard]] double scale_of(const std::string& unit);

}  // namespace camber::python
