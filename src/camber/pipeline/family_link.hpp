#pragma once
// Families of a CGNS mesh that name the CAD faces of their patches, as rules for the link.
#include <camber/associate/by_tags.hpp>
#include <camber/io/cgns/cgns_families.hpp>
#include <camber/mesh/mesh_data.hpp>

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

}  // namespace camber
