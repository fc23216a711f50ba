#pragma once
// What was written, to be compared with what is on the disk: for formats without a reader.
#include <cstdint>
#include <string>

namespace camber::io {

struct FileSummary {
  std::uint64_t size = 0;  // bytes
  std::uint64_t hash = 0;  // FNV-1a
};

/// Reads the file again and compares it with the summary.
/// @param display  name used in errors (the user's file, when `path` is a temporary)
/// @throws FileError if it differs
void check_file(const std::string& path, const FileSummary& summary, const std::string& display);

}  // namespace camber::io
