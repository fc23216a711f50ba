#include <camber/base/error.hpp>
#include <camber/io/formats.hpp>

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <stdexcept>

#include <fmt/format.h>

namespace camber::io {
namespace {

constexpr std::array k_formats{
    FormatInfo{Format::gmsh, "msh", ".msh", "Gmsh 4.1 and 2.2", true, true, 4, true, true,
               "everything: entities, groups, numbers, parameters",
               "PyFR, MFEM, Nektar++ (NekMesh), DOLFINx, PETSc: one order in the whole mesh"},
    FormatInfo{Format::cgns, "cgns", ".cgns", "CGNS (HDF5; ADF is read)", true, true, 4, true,
               false, "volumes and patches by name, families, CAD faces of a patch",
               "SU2-DG, hpMusic, NekMesh; linear: most finite-volume solvers"},
    FormatInfo{Format::su2, "su2", ".su2", "SU2", true, true, 4, true, false, "patches by name",
               "SU2, SU2-DG"},
    FormatInfo{Format::ugrid, "ugrid", ".ugrid", "UGRID (AFLR3), ASCII, b8, lb8, r8, lr8", true,
               true, 1, false, true, "patches by name (.mapbc)", "FUN3D, Kestrel and others"},
    FormatInfo{Format::meshb, "meshb", ".meshb", "libMeshb (GMF; Medit's text `.mesh`)", true,
               false, 1, false, true,
               "references as tags and patch names, vertices on CAD entities",
               "refine, the GAMMA tools"},
    FormatInfo{Format::mfem, "mfem", ".mesh", "MFEM 1.0", false, true, 4, false, false,
               "volumes and patches by number, names as comments",
               "MFEM, GLVis; pyramids above order 1: MFEM 4.8 or later"},
    FormatInfo{Format::nektar, "nektar", ".xml", "Nektar++ geometry (XML, text)", false, true, 4,
               false, false, "volumes and patches by name; no nodes inside of cells", "Nektar++"},
    FormatInfo{Format::hopr, "hopr", ".h5", "HOPR mesh (HDF5)", false, true, 4, false, false,
               "patches by name, volumes by number", "FLEXI, PICLas; HORSES3D: hexes only"},
    FormatInfo{Format::vtu, "vtu", ".vtu", "VTK unstructured grid", true, true, 4, true, true,
               "groups and results when written, surfaces and volumes by number when read",
               "ParaView, PyVista"},
};

std::string lower_extension(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

const char* yes_no(bool yes) { return yes ? "yes" : "no"; }

}  // namespace

std::span<const FormatInfo> formats() { return k_formats; }

const FormatInfo& format_info(Format format) {
  const auto info = std::find_if(k_formats.begin(), k_formats.end(),
                                 [&](const FormatInfo& i) { return i.format == format; });
  if (info == k_formats.end()) throw std::invalid_argument("no such format");
  return *info;
}

Format format_by_name(const std::string& path) {
  const std::string extension = lower_extension(path);
  std::string known;
  for (const FormatInfo& info : k_formats) {
    if (extension == info.extensions) return info.format;
    known += fmt::format("{}{} ({}{})", known.empty() ? "" : ", ", info.extensions, info.title,
                         info.reads ? "" : ", writing only");
  }
  throw FileError(extension.empty() ? "the name has no extension that tells its format"
                                    : "unknown extension '" + extension + "'",
                  path, "use " + known);
}

Format format_to_read(const std::string& path) {
  const Format format = format_by_name(path);
  return format == Format::mfem ? Format::meshb : format;
}

std::string format_table() {
  std::string table =
      "| format | extension | read | written | orders | mixed orders | keeps | taken by |\n"
      "|---|---|---|---|---|---|---|---|\n";
  for (const FormatInfo& i : k_formats) {
    table += fmt::format("| {} | `{}` | {} | {} | {} | {} | {} | {} |\n", i.title, i.extensions,
                         yes_no(i.reads), yes_no(i.writes),
                         i.highest_order == 1 ? "1" : fmt::format("1 to {}", i.highest_order),
                         yes_no(i.mixes_orders), i.keeps, i.solvers);
  }
  return table;
}

}  // namespace camber::io
