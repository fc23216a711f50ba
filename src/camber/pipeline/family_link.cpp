#include <camber/base/log.hpp>
#include <camber/pipeline/family_link.hpp>

#include <algorithm>
#include <charconv>
#include <set>
#include <string_view>

#include <fmt/format.h>

namespace camber {
namespace {

/// 7 of face_7; 0 for any other name.
int number_of(const std::string& name) {
  constexpr std::string_view k_prefix = "face_";
  if (!name.starts_with(k_prefix)) return 0;
  int number = 0;
  const char* end = name.data() + name.size();
  const auto [stop, error] = std::from_chars(name.data() + k_prefix.size(), end, number);
  return error == std::errc{} && stop == end ? number : 0;
}

/// The part after the last / or \: files may come from another system.
std::string file_name(const std::string& path) {
  const std::size_t slash = path.find_last_of("/\\");
  return slash == std::string::npos ? path : path.substr(slash + 1);
}

std::set<std::string> face_names(const GeometryModel& geometry) {
  std::set<std::string> names;
  for (int tag = 1; tag <= geometry.count(2); ++tag) names.insert(geometry.name({2, tag}));
  return names;
}

/// Why the name means no face of the CAD; "" if it does.
std::string objection(const std::string& name, const io::PatchGeometry& patch,
                      const std::set<std::string>& names, int faces, const std::string& cad) {
  if (names.contains(name)) return "";
  const int number = number_of(name);
  if (number < 1 || number > faces) return fmt::format("the CAD has no face '{}'", name);
  if (patch.file.empty() || file_name(patch.file) == file_name(cad)) return "";
  return fmt::format("'{}' is a face of '{}', not of this CAD", name, patch.file);
}

}  // namespace

FamilyLink link_by_families(const std::vector<io::PatchGeometry>& families, const MeshData& mesh,
                            const GeometryModel& geometry, const std::string& cad,
                            TagOptions& rules) {
  FamilyLink link;
  const std::set<std::string> names = face_names(geometry);
  for (const io::PatchGeometry& patch : families) {
    const bool is_there =
        std::any_of(mesh.entities.begin(), mesh.entities.end(),
                    [&](const EntityRecord& e) { return e.key.dim == 2 && e.name == patch.patch; });
    if (!is_there || rules.faces.contains(patch.patch) || rules.patches.contains(patch.patch)) {
      continue;
    }
    std::string problem;
    for (const std::string& name : patch.names) {
      if (problem.empty()) problem = objection(name, patch, names, geometry.count(2), cad);
    }
    if (!problem.empty()) {
      link.left_out.push_back(fmt::format("{}: {}", patch.patch, problem));
      continue;
    }
    rules.faces[patch.patch] = patch.names;
    ++link.patches;
  }
  return link;
}

std::string take_families(const std::string& path, io::Format format, const MeshData& mesh,
                          const GeometryModel& geometry, const std::string& cad,
                          CurveOptions& options) {
  if (options.link_by != LinkBy::automatic) return "";
  if (format == io::Format::automatic) format = io::format_by_name(path);
  if (format != io::Format::cgns) return "";
  const std::vector<io::PatchGeometry> families = io::read_cgns_geometry(path);
  const FamilyLink link = link_by_families(families, mesh, geometry, cad, options.association);
  for (const std::string& reason : link.left_out) {
    log(LogLevel::info, "family of patch " + reason + "; it is linked by shape");
  }
  if (link.patches == 0) return "";
  return fmt::format(
      "the families of the mesh name the CAD faces of {} patches{}", link.patches,
      link.left_out.empty() ? "" : fmt::format("; not taken: {}", fmt::join(link.left_out, "; ")));
}

void note_families(const std::string& families, Report& report) {
  if (families.empty()) return;
  report.link.method = "families";
  report.link.reason = families;
}

}  // namespace camber
