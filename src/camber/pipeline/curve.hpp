#pragma once
// The main job, in the order of the paper's Fig. 1.
#include <camber/base/progress.hpp>
#include <camber/mesh/export_mesh.hpp>
#include <camber/pipeline/options.hpp>
#include <camber/pipeline/report.hpp>

#include <memory>

namespace camber {

/// A curved mesh with the linear mesh and topology it stands on, and what is known of each cell.
struct CurveResult {
  std::unique_ptr<LinearMesh> linear;
  std::unique_ptr<Topology> topology;
  std::unique_ptr<CurvedMesh> curved;
  Association association;
  std::vector<double> cell_bound;  // certified scaled Jacobian
  std::vector<double> cell_cost;   // minimum of C, eq. (2)
  std::vector<double>
      face_deviation;  // by topology face: largest Gauss-point distance (NaN off the CAD)
  Report report;
};

/// Curves a linear mesh onto the CAD its entity tags refer to. The geometry's scale may be changed.
/// @throws MeshError, GeometryError, OptionError; Cancelled through progress
[[nodiscard]] CurveResult curve(const MeshData& data, GeometryModel& geometry,
                                const CurveOptions& options, const Progress& progress = {});
/// The same for less memory: `data` is emptied once mesh and CAD are linked.
[[nodiscard]] CurveResult curve(MeshData&& data, GeometryModel& geometry,
                                const CurveOptions& options, const Progress& progress = {});

/// The mesh to write (mixed, or uniform as the options say) with the element fields
/// scaled_jacobian, cost, patch and deviation; and shape_order, the order before the elevation,
/// when it is uniform.
[[nodiscard]] MeshData exported(const CurveResult& result, const CurveOptions& options);
/// The same for less memory: of `result` only the report stays.
/// @param with_fields  false: no element fields (of the formats only .vtu takes them)
[[nodiscard]] MeshData exported(CurveResult&& result, const CurveOptions& options,
                                bool with_fields);

}  // namespace camber
