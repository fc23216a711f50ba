#include <camber/base/error.hpp>
#include <camber/io/detail/temporary_file.hpp>
#include <camber/io/gmsh/gmsh_reader.hpp>
#include <camber/io/gmsh/gmsh_writer.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/io/vtu/vtu_writer.hpp>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <new>

namespace camber::io {
namespace {

constexpr double k_version_slack = 1e-6;  // versions are decimal fractions

Format format_of(const std::string& path, Format wanted) {
  if (wanted != Format::automatic) return wanted;
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension == ".msh") return Format::gmsh;
  if (extension == ".vtu") return Format::vtu;
  throw FileError(extension.empty() ? "the name has no extension that tells its format"
                                    : "unknown extension '" + extension + "'",
                  path, "use .msh (Gmsh) or .vtu (VTK, writing only)");
}

void check_version(const std::string& path, const WriteOptions& options) {
  for (const double known : {4.1, 2.2}) {
    if (std::abs(options.gmsh_version - known) < k_version_slack) return;
  }
  throw FileError("cannot be written as Gmsh version " + std::to_string(options.gmsh_version), path,
                  "choose version 4.1 or 2.2");
}

MeshData read_back(const std::string& temporary, const std::string& path) {
  try {
    MeshData mesh = read_gmsh(temporary);
    mesh.source = path;
    return mesh;
  } catch (const FileError& error) {
    throw FileError("what was written cannot be read back: " + error.message(), path,
                    "check the disk");
  }
}

}  // namespace

MeshData read_mesh(const std::string& path, const ReadOptions& options) {
  if (format_of(path, options.format) == Format::vtu) {
    throw FileError("VTK files can only be written", path, "read the .msh file of the mesh");
  }
  try {
    return read_gmsh(path);
  } catch (const std::bad_alloc&) {
    throw FileError("the mesh does not fit into memory", path, "use a machine with more memory");
  }
}

void check_writable(const std::string& path, const WriteOptions& options) {
  if (format_of(path, options.format) == Format::gmsh) check_version(path, options);
  static_cast<void>(writable_target(path));
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
  if (format_of(path, options.format) == Format::vtu) {
    VtuSummary summary;
    write_atomically(
        path,
        [&](const std::string& temporary) {
          summary = write_vtu(mesh, temporary, {.binary = options.binary}, path);
        },
        [&](const std::string& temporary) { check_vtu(temporary, summary, path); });
    return;
  }
  const GmshWriteOptions gmsh{.binary = options.binary, .version = options.gmsh_version};
  write_atomically(
      path, [&](const std::string& temporary) { write_gmsh(mesh, temporary, gmsh, path); },
      [&](const std::string& temporary) {
        const MeshData written = read_back(temporary, path);
        if (written.points.size() != mesh.points.size() ||
            written.element_count() != mesh.element_count()) {
          throw FileError("what was written has other counts of nodes or elements than the mesh",
                          path, "check the disk");
        }
        if (verify) verify(written);
      });
}

}  // namespace camber::io
