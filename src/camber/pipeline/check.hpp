#pragma once
// Judges any linear or curved mesh as it stands in a file.
#include <camber/geom/geometry_model.hpp>
#include <camber/mesh/mesh_data.hpp>
#include <camber/pipeline/report.hpp>

namespace camber {

struct CheckOptions {
  double deviation = 0.01;  // share of the face's shortest edge over which a face counts as off the CAD
  bool with_quality = true;  // cost C of every cell
};

/// Certificates of every volume element, gaps and order jumps between face neighbours (both sides are
/// evaluated at the lattice of the higher order), and with a CAD the surface error of the patches
/// whose tags refer to it. Works on the elements as written, knowing nothing of how they were made.
/// validity counts: `certified` includes linear elements.
/// @param geometry  may be null
[[nodiscard]] Report check(const MeshData& data, const GeometryModel* geometry, const CheckOptions& options = {});

/// For safe writing: throws FileError if the mesh read back differs from the one written (counts, nodes) or if
/// an element is not certified although `expected_certified`.
void verify_written(const MeshData& written, const MeshData& read_back, bool expect_certified);

}  // namespace camber
