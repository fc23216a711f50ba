#pragma once
// Formats by extension, and safe writing.
#include <camber/io/formats.hpp>
#include <camber/mesh/mesh_data.hpp>

#include <functional>
#include <string>

namespace camber::io {

struct ReadOptions {
  Format format = Format::automatic;
};
struct WriteOptions {
  Format format = Format::automatic;
  bool binary = true;
  double gmsh_version = 4.1;  // 4.1 or 2.2
  std::string geometry = {};  // CAD file that a .cgns file refers to, "" for none
};

/// Reads a mesh file of any format that formats() says can be read.
/// @throws FileError naming path, line or byte offset, what was found and what was expected.
[[nodiscard]] MeshData read_mesh(const std::string& path, const ReadOptions& options = {});

/// Fails at once with the error that write_mesh would end in (unknown extension, missing folder,
/// not writable), so that nobody waits for a run whose result cannot be written.
void check_writable(const std::string& path, const WriteOptions& options = {});

/// The order to which write_mesh raises all elements because the format holds one order only; 0
/// where every element keeps its own (also if all have one order already).
[[nodiscard]] int raised_order(const MeshData& mesh, const std::string& path,
                               const WriteOptions& options = {});

/// Writes to a temporary file beside `path`, flushes it to disk, reads it back where a reader
/// exists, calls verify(what was read), then renames. On any failure the temporary is removed, the
/// old file is untouched and a FileError is thrown; what verify throws passes through. A kill may
/// leave the temporary ".NAME.XXXXXX.tmp" behind, never a damaged `path`.
/// Points may come back sorted by entity; elements keep their order (see gmsh_writer.hpp). Formats
/// that know patches by name only join entities of one name; verify gets the source mesh with the
/// nodes as read back. Formats without a reader (.vtu, .mesh, .xml, .h5) are compared with what
/// was meant, and verify is not called. Where a format holds one order, elements of lower order are
/// raised exactly (see raised_order), which is logged.
void write_mesh(const MeshData& mesh, const std::string& path, const WriteOptions& options = {},
                const std::function<void(const MeshData&)>& verify = {});

/// The same safety for any writer: produce(temporary path) must fill the file, which exists and is
/// empty; verify(temporary path) may look at the result. What they throw passes through.
/// @throws FileError
void write_atomically(const std::string& path,
                      const std::function<void(const std::string&)>& produce,
                      const std::function<void(const std::string&)>& verify = {});

/// The same for a text: `path` is replaced in one step, or left as it was. @throws FileError
void write_text(const std::string& path, const std::string& text);

}  // namespace camber::io
