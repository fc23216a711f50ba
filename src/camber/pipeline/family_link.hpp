#pragma once
// Families of a CGNS mesh that name the CAD faces of their patches, as rules for the link.
#include <camber/associate/by_tags.hpp>
#include <camber/io/cgns/cgns_families.hpp>
#include <camber/io/formats.hpp>
#include <camber/mesh/mesh_data.hpp>
#include <camber/pipeline/options.hpp>
#include <camber/pipeline/report.hpp>

#include <string>
#include <vector>

namespace camber {

/// What was taken of the families, and what not and why.
struct FamilyLink {
  std::size_t patches = 0;            // that got a rule
  std::vector<std::string> left_out;  // "wing: the CAD has no face 'upper side'"
};

/// Adds to `rules.faces`, for each patch of the mesh whose family names faces that the CAD has, the
/// rule that --patch NAME=face_3,.. would: the link by shape looks for the patch on these only. A
/// name is that of a CAD face (GeometryModel::name), or face_N where the family refers to a file of
/// this CAD's file name or to none: numbers of another file mean nothing. A patch with one unknown
/// name gets no rule. Rules for a patch that are there already are kept.
/// @param cad  path of the CAD file
[[nodiscard]] FamilyLink link_by_families(const std::vector<io::PatchGeometry>& families,
                                          const MeshData& mesh, const GeometryModel& geometry,
                                          const std::string& cad, TagOptions& rules);

/// The same for a run: the families of the CGNS file `path`, unless the options say what links mesh
/// and CAD, or the file is of another format (automatic: by its name). Patches that are left out
/// are named in the log.
/// @return what the report says of it, "" if no rule came of it. @throws FileError
[[nodiscard]] std::string take_families(const std::string& path, io::Format format,
                                        const MeshData& mesh, const GeometryModel& geometry,
                                        const std::string& cad, CurveOptions& options);

/// Notes in the report that families made the link; nothing for "".
void note_families(const std::string& families, Report& report);

}  // namespace camber
