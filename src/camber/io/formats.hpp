#pragma once
// What is known about each mesh format: the one table that readers, writers, help texts and the
// documentation follow.
#include <span>
#include <string>
#include <string_view>

namespace camber::io {

enum class Format { automatic, gmsh, vtu, cgns, su2, ugrid, mfem, nektar, hopr, meshb };

struct FormatInfo {
  Format format;
  std::string_view name;        // for --from and --to
  std::string_view extensions;  // ".cgns .hdf"
  std::string_view title;
  bool reads, writes;
  int highest_order;  // of elements
  bool mixes_orders;  // elements of different orders in one file
  bool has_text_and_binary;
  std::string_view keeps;    // what of a mesh survives
  std::string_view solvers;  // who takes it
};

/// One entry a format, in the order they are listed to users.
[[nodiscard]] std::span<const FormatInfo> formats();
/// @throws std::invalid_argument for Format::automatic
[[nodiscard]] const FormatInfo& format_info(Format format);
/// Format by the extension of the name, any case. @throws FileError listing what is known
[[nodiscard]] Format format_by_name(const std::string& path);
/// The same for a file to be read: ".mesh" is Medit's text here, and MFEM's where it is written.
[[nodiscard]] Format format_to_read(const std::string& path);

/// The table as it stands in docs/formats.md.
[[nodiscard]] std::string format_table();

}  // namespace camber::io
