#pragma once
#include <camber/pipeline/curve.hpp>

namespace camber::detail {

/// Adds what a user should know of the mesh and of the run though it is no failure: joined
/// vertices, boundary without surface elements, solves that stopped early, cells too flat for any
/// certificate.
void warn(const CurveResult& result, Report& report);

}  // namespace camber::detail
