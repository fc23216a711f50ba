#pragma once
// Geometry that the families of a CGNS file refer to.
#include <string>
#include <vector>

namespace camber::io {

/// What the family of one patch says of its geometry (GeometryReference_t; SIDS, "Family").
struct PatchGeometry {
  std::string patch;               // name of the boundary condition, which is the patch's name
  std::string family, file;        // the family; the CAD file it names, as it is written there
  std::vector<std::string> names;  // GeometryEntity_t: of CAD faces, such as face_3
};

/// Patches of all zones whose family refers to geometry by the names of its entities, by name; the
/// first file wins where a family names several. A family that is not in a condition counts for a
/// patch of its own name.
/// @throws FileError if the file cannot be read
[[nodiscard]] std::vector<PatchGeometry> read_cgns_geometry(const std::string& path);

}  // namespace camber::io
