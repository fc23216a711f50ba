#pragma once
// CGNS files (HDF5) of any mix of shapes and orders.
#include <camber/io/detail/named_mesh.hpp>

#include <string>

namespace camber::io {

/// What CGNS allows in names.
[[nodiscard]] NameRules cgns_name_rules();

/// Writes one base, one unstructured zone, a section for each (volume or patch, shape, order) of
/// complete Lagrange elements, for each patch a boundary condition (faces, type "FamilySpecified")
/// and a family of its name. With `geometry` the family refers to the CAD file and to the faces
/// "face_N" whose numbers the patch had in the source mesh.
/// @param display  name used in errors (the user's file, when `path` is a temporary)
/// @throws FileError if the library refuses, or numbers do not fit its integers
void write_cgns(const NamedMesh& named, const std::string& path, const std::string& geometry,
                const std::string& display);

}  // namespace camber::io
