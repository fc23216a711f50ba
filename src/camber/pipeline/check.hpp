#pragma once
// Judges any linear or curved mesh as it stands in a file.
#include <camber/geom/geometry_model.hpp>
#include <camber/mesh/mesh_data.hpp>
#include <camber/pipeline/report.hpp>

#include <vector>

namespace camber {

struct CheckOptions {
  double deviation =
      0.01;  // share of the face's shortest edge over which a face counts as off the CAD
  bool with_quality = true;  // cost C of every cell
  bool strict = false;       // faces over the deviation count as failure (exit code 3)
};

/// What check() found of each volume element, in the order of ElementList(data, 3).
struct CellFindings {
  std::vector<double> bound;  // certified scaled Jacobian, in [-1, 1]
  std::vector<double> cost;   // minimum of C, eq. (2); 1 for linear cells; empty without quality
};

/// Two sides of a face farther apart than this share of the model size are a gap, not rounding.
inline constexpr double k_gap_tolerance = 1e-10;

/// Certificates of every volume element, gaps and order jumps between face neighbours (both sides
/// are evaluated at the lattice of the higher order), and with a CAD the surface error of the
/// patches whose tags refer to it. Works on the elements as written, knowing nothing of how they
/// were made. validity counts: `certified` includes linear elements. status: "not_certified", else
/// "not_watertight" (a gap over k_gap_tolerance, a face of more than two cells), else with `strict`
/// "over_deviation", else "ok"; exit_code 3 unless ok.
/// @param geometry  may be null; else its scale is that of the mesh (fit_cad_scale)
/// @param findings  may be null; else filled with what the report only counts
/// @throws MeshError if there is no volume element or one of an order that cannot be certified
[[nodiscard]] Report check(const MeshData& data, const GeometryModel* geometry,
                           const CheckOptions& options = {}, CellFindings* findings = nullptr);

/// For safe writing: throws FileError if the mesh read back differs from the one written (kinds and
/// numbers of elements, which nodes they share, any bit of a coordinate; order of nodes and blocks
/// is free) or if an element is not certified although `expect_certified`.
void verify_written(const MeshData& written, const MeshData& read_back, bool expect_certified);

}  // namespace camber
