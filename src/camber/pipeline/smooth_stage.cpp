#include <camber/pipeline/smooth_stage.hpp>

namespace camber {

std::vector<SmoothRow> smooth_stage(std::unique_ptr<CurvedMesh>& curved,
                                    const Association& association, const GeometryModel& geometry,
                                    const CurveOptions& options, const Progress& progress) {
  switch (options.smoothing) {
    case Smoothing::marching:
    case Smoothing::automatic:
    case Smoothing::none:
      break;
  }
  static_cast<void>(curved);
  static_cast<void>(association);
  static_cast<void>(geometry);
  static_cast<void>(progress);
  return {};
}

}  // namespace camber
