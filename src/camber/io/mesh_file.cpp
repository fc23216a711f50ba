#include <camber/base/error.hpp>
#include <camber/base/log.hpp>
#include <camber/io/cgns/cgns_reader.hpp>
#include <camber/io/cgns/cgns_writer.hpp>
#include <camber/io/detail/input_file.hpp>
#include <camber/io/detail/named_mesh.hpp>
#include <camber/io/detail/output_file.hpp>
#include <camber/io/detail/temporary_file.hpp>
#include <camber/io/gmsh/gmsh_reader.hpp>
#include <camber/io/gmsh/gmsh_writer.hpp>
#include <camber/io/hopr/hopr_file.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/io/meshb/meshb_reader.hpp>
#include <camber/io/mfem/mfem_writer.hpp>
#include <camber/io/nektar/nektar_writer.hpp>
#include <camber/io/su2/su2_reader.hpp>
#include <camber/io/su2/su2_writer.hpp>
#include <camber/io/ugrid/ugrid_layout.hpp>
#include <camber/io/ugrid/ugrid_reader.hpp>
#include <camber/io/ugrid/ugrid_writer.hpp>
#include <camber/io/vtu/vtu_reader.hpp>
#include <camber/io/vtu/vtu_writer.hpp>
#include <camber/mesh/elevate_data.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <map>
#include <new>
#include <optional>

#include <fmt/format.h>

namespace camber::io {
namespace {

constexpr double k_version_slack = 1e-6;  // versions are decimal fractions

Format format_of(const std::string& path, Format wanted) {
  return wanted == Format::automatic ? format_by_name(path) : wanted;
}

void check_version(const std::string& path, const WriteOptions& options) {
  for (const double known : {4.1, 2.2}) {
    if (std::abs(options.gmsh_version - known) < k_version_slack) return;
  }
  throw FileError("cannot be written as Gmsh version " + std::to_string(options.gmsh_version), path,
                  "choose version 4.1 or 2.2");
}

MeshData read_as(Format format, const std::string& path) {
  switch (format) {
    case Format::gmsh:
      return read_gmsh(path);
    case Format::cgns:
      return read_cgns(path);
    case Format::su2:
      return read_su2(path);
    case Format::ugrid:
      return read_ugrid(path);
    case Format::vtu:
      return read_vtu(path);
    case Format::meshb:
      return read_meshb(path);
    case Format::mfem:
    case Format::nektar:
    case Format::hopr:
    case Format::automatic:
      break;
  }
  throw FileError(std::string(format_info(format).title) + " files can only be written", path,
                  "read the .msh file of the mesh");
}

/// Errors of the reader as errors of the writer.
template <class Read>
MeshData read_back(const std::string& path, const Read& read) {
  try {
    MeshData mesh = read();
    mesh.source = path;
    return mesh;
  } catch (const FileError& error) {
    throw FileError("what was written cannot be read back: " + error.message(), path,
                    "check the disk");
  }
}

/// What a writer without high orders cannot take.
void require_order(const MeshData& mesh, const FormatInfo& info, const std::string& path) {
  for (const ElementBlock& block : mesh.blocks) {
    if (block.order <= info.highest_order || block.nodes.empty() || dimension(block.shape) < 2)
      continue;
    throw FileError(std::string(info.title) + " files hold elements of order " +
                        std::to_string(info.highest_order) + " only, the mesh is of order " +
                        std::to_string(block.order),
                    path, "write another format, or the corners only: camber convert --order 1");
  }
}

NameRules name_rules(Format format) {
  if (format == Format::mfem) return mfem_name_rules();
  if (format == Format::nektar) return nektar_name_rules();
  if (format == Format::hopr) return hopr_name_rules();
  if (format == Format::cgns) return cgns_name_rules();
  return format == Format::su2 ? su2_name_rules() : ugrid_name_rules();
}

/// Formats that cannot be read back: the bytes on the disk must be those that were meant.
template <class Write>
void write_only(const std::string& path, const Write& write) {
  FileSummary summary;
  write_atomically(
      path, [&](const std::string& temporary) { summary = write(temporary); },
      [&](const std::string& temporary) { check_file(temporary, summary, path); });
}

/// True if the file gives the patches of the mesh their names already; its boundary conditions may
/// be the user's.
bool has_names(const std::string& mapbc, const NamedMesh& named) {
  std::error_code failed;
  if (!std::filesystem::is_regular_file(mapbc, failed)) return false;
  std::map<std::int64_t, std::string> names;
  for (const EntityRecord& patch : named.mesh.entities) {
    if (patch.key.dim == 2) names[patch.key.tag] = patch.name;
  }
  try {
    return parse_mapbc(mapbc, InputFile(mapbc).text()) == names;
  } catch (const FileError&) {
    return false;
  }
}

/// UGRID and the names of its patches, two files. Both are complete on the disk before the first
/// takes its place; names go first, so that a new mesh always has its own. Names that are right
/// stay as they are.
void write_ugrid_pair(const NamedMesh& named, const std::string& path,
                      const std::function<void(const std::string&)>& verify) {
  const std::string mapbc = ugrid::mapbc_path(path);
  TemporaryFile mesh_file(writable_target(path), path);
  write_ugrid(named, mesh_file.path(), path);
  mesh_file.sync();
  verify(mesh_file.path());
  if (has_names(mapbc, named)) {
    mesh_file.replace_target();
    return;
  }
  const std::string names_target = writable_target(mapbc);
  std::optional<std::string> before;
  if (std::filesystem::exists(names_target) && std::filesystem::file_size(names_target) > 0) {
    before = InputFile(names_target).text();
  }
  TemporaryFile names_file(names_target, mapbc);
  {
    OutputFile out(names_file.path(), mapbc);
    out.append(mapbc_text(named));
    out.finish();
  }
  names_file.sync();
  names_file.replace_target();
  try {
    mesh_file.replace_target();
  } catch (const FileError&) {
    if (before) write_text(mapbc, *before);
    throw;
  }
}

/// Formats that know entities by name only.
void write_named(const MeshData& mesh, const std::string& path, Format format,
                 const WriteOptions& options, const std::function<void(const MeshData&)>& verify) {
  const NamedMesh named = by_names(mesh, name_rules(format));
  if (format == Format::mfem) {
    write_only(path, [&](const std::string& to) { return write_mfem(named, to, path); });
    return;
  }
  if (format == Format::nektar) {
    write_only(path, [&](const std::string& to) { return write_nektar(named, to, path); });
    return;
  }
  if (format == Format::hopr) {
    const hopr::Arrays arrays = hopr::make_arrays(named, path);
    write_atomically(
        path, [&](const std::string& temporary) { write_hopr(arrays, temporary, path); },
        [&](const std::string& temporary) { check_hopr(arrays, temporary, path); });
    return;
  }
  const auto check = [&](const std::string& temporary) {
    const MeshData read = read_back(path, [&] {
      if (format != Format::ugrid) return read_as(format, temporary);
      return parse_ugrid(path, InputFile(temporary).text(), mapbc_text(named));
    });
    const MeshData written = relabel(mesh, named, read);
    if (verify) verify(written);
  };
  if (format == Format::ugrid) {
    write_ugrid_pair(named, path, check);
    return;
  }
  write_atomically(
      path,
      [&](const std::string& temporary) {
        if (format == Format::cgns) write_cgns(named, temporary, options.geometry, path);
        if (format == Format::su2) write_su2(named, temporary, path);
      },
      check);
}

}  // namespace

MeshData read_mesh(const std::string& path, const ReadOptions& options) {
  const Format format = options.format == Format::automatic ? format_to_read(path) : options.format;
  try {
    return read_as(format, path);
  } catch (const std::bad_alloc&) {
    throw FileError("the mesh does not fit into memory", path, "use a machine with more memory");
  }
}

void check_writable(const std::string& path, const WriteOptions& options) {
  const Format format = format_of(path, options.format);
  if (!format_info(format).writes) {
    throw FileError(std::string(format_info(format).title) + " files can only be read", path,
                    "write .msh, .cgns or another format of: camber info --formats");
  }
  if (format == Format::gmsh) check_version(path, options);
  if (format == Format::ugrid) {
    static_cast<void>(ugrid::layout_of(path));
    static_cast<void>(writable_target(ugrid::mapbc_path(path)));
  }
  static_cast<void>(writable_target(path));
}

int raised_order(const MeshData& mesh, const std::string& path, const WriteOptions& options) {
  if (format_info(format_of(path, options.format)).mixes_orders) return 0;
  int lowest = k_max_order, highest = 0;
  for (const ElementBlock& block : mesh.blocks) {
    if (dimension(block.shape) < 2 || block.nodes.empty()) continue;
    lowest = std::min(lowest, block.order);
    highest = std::max(highest, block.order);
  }
  return lowest < highest ? highest : 0;
}

void write_atomically(const std::string& path,
                      const std::function<void(const std::string&)>& produce,
                      const std::function<void(const std::string&)>& verify) {
  TemporaryFile temporary(writable_target(path), path);
  produce(temporary.path());
  temporary.sync();
  if (verify) verify(temporary.path());
  temporary.replace_target();
}

void write_mesh(const MeshData& mesh, const std::string& path, const WriteOptions& options,
                const std::function<void(const MeshData&)>& verify) {
  check_writable(path, options);
  const Format format = format_of(path, options.format);
  if (format == Format::vtu) {
    write_only(path, [&](const std::string& to) {
      return write_vtu(mesh, to, {.binary = options.binary}, path);
    });
    return;
  }
  if (format != Format::gmsh) {
    require_order(mesh, format_info(format), path);
    const int order = raised_order(mesh, path, options);
    if (order > 0)
      log(LogLevel::info, fmt::format("{}: all elements raised to order {}", path, order));
    write_named(order > 0 ? at_order(mesh, order) : mesh, path, format, options, verify);
    return;
  }
  const GmshWriteOptions gmsh{.binary = options.binary, .version = options.gmsh_version};
  write_atomically(
      path, [&](const std::string& temporary) { write_gmsh(mesh, temporary, gmsh, path); },
      [&](const std::string& temporary) {
        const MeshData written = read_back(path, [&] { return read_gmsh(temporary); });
        if (written.points.size() != mesh.points.size() ||
            written.element_count() != mesh.element_count()) {
          throw FileError("what was written has other counts of nodes or elements than the mesh",
                          path, "check the disk");
        }
        if (verify) verify(written);
      });
}

void write_text(const std::string& path, const std::string& text) {
  write_atomically(path, [&](const std::string& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out << text;
    out.close();
    if (!out) throw FileError("cannot be written", path, "check that the disk is not full");
  });
}

}  // namespace camber::io
