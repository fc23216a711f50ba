#pragma once
#include <camber/associate/association.hpp>
#include <camber/pipeline/options.hpp>
#include <camber/pipeline/report.hpp>

namespace camber {

/// Links a mesh to its CAD: as a MeshLink file says, by the mesh's tags if these
/// fit the CAD, else by shape. The way taken
/// for the first mesh is kept for those that follow (the same mesh after local changes).
class CadLink {
 public:
  /// All are kept by reference. The geometry's scale may be changed.
  CadLink(const MeshData& data, GeometryModel& geometry, const CurveOptions& options)
      : data_(data), geometry_(geometry), options_(options) {}

  /// @param report its section `link` is filled
  /// @throws GeometryError if mesh and CAD fit neither way; OptionError
  [[nodiscard]] Association link(const LinearMesh& mesh, const Topology& topology, Report& report);

 private:
  [[nodiscard]] Association by_file(const LinearMesh& mesh, const Topology& topology,
                                    Report& report);
  [[nodiscard]] Association by_shape(const LinearMesh& mesh, const Topology& topology,
                                     Report& report) const;

  const MeshData& data_;
  GeometryModel& geometry_;
  const CurveOptions& options_;
  bool is_by_shape_ = false, is_scaled_ = false;
};

}  // namespace camber
