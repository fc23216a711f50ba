#pragma once
// One run of the ladder: a body with layers, curved with every cell at one order, and its numbers.
#include <camber/pipeline/curve.hpp>

#include "bodies.hpp"

namespace camber::testing {

struct LadderSettings {
  double first_over_edge = 1e-2;
  int order = 4;                           // of every cell
  Propagation start = Propagation::layer;  // what smoothing starts from
  Smoothing smoothing = Smoothing::none;
};

/// Cost C of eq. (2) over the cells of a mesh.
struct MeshCost {
  double minimum = 1.0;
  double mean = 1.0;  // of the cells' averages
};
[[nodiscard]] MeshCost mesh_cost(const CurvedMesh& curved);

struct LadderRow {
  std::string body, filling;
  LadderSettings settings;
  std::string error;  // why there are no numbers; empty if there are
  std::size_t cells = 0;
  std::size_t invalid_at_start = 0;  // not certified as propagated, before any rescue
  std::size_t invalid_at_end = 0;
  std::size_t patches = 0, smoothed_faces = 0, lowered = 0, scaled_back = 0;  // rescues
  int iterations = 0;                                                         // of smoothing
  /// With the stiffness, of the elastic solve that replaced a tangled start.
  std::size_t products = 0;
  // CPU seconds; what replaces a tangled start counts as certification.
  double certify_s = 0.0, rescue_s = 0.0, smooth_s = 0.0;
  MeshCost start, end;
  double min_jacobian_ratio = 1.0;  // certified

  [[nodiscard]] bool is_certified() const { return error.empty() && invalid_at_end == 0; }
  [[nodiscard]] bool is_rescued() const {
    return patches + smoothed_faces + lowered + scaled_back > 0;
  }
  /// CPU seconds of certification, rescue and smoothing per 1000 cells.
  [[nodiscard]] double seconds_per_1000() const {
    return cells == 0 ? 0.0
                      : 1000.0 * (certify_s + rescue_s + smooth_s) / static_cast<double>(cells);
  }
};

/// What climb_ladder() asks of curve().
[[nodiscard]] CurveOptions curve_options(const LadderSettings& settings);

/// True if the name is in the list of those asked for, or the list is empty.
[[nodiscard]] bool is_wanted(const std::vector<std::string>& names, const std::string& name);

/// Runs curve() on the case. CPU times are those of the whole process: run one at a time.
/// Errors of the library are put in the row.
[[nodiscard]] LadderRow climb_ladder(const BodyCase& body, const LadderSettings& settings);

/// Fills in what the result of curve() and the CPU clock of its stages say.
void read_result(const CurveResult& result, LadderRow& row);

[[nodiscard]] const char* name_of(Propagation start);    // "carried", "elastic", "cell"
[[nodiscard]] const char* name_of(Smoothing smoothing);  // "auto", "marching", "none"

}  // namespace camber::testing
