#include <camber/base/error.hpp>
#include <camber/io/detail/hash.hpp>
#include <camber/io/detail/input_file.hpp>
#include <camber/io/file_summary.hpp>

namespace camber::io {

void check_file(const std::string& path, const FileSummary& summary, const std::string& display) {
  const InputFile file(path);
  if (file.text().size() != summary.size || fnv1a(file.text()) != summary.hash) {
    throw FileError("what was written differs from what is on the disk", display, "check the disk");
  }
}

}  // namespace camber::io
