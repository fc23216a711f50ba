#pragma once
// A whole file in memory.
#include <cstddef>
#include <memory>
#include <string>
#include <string_view>

namespace camber::io {

/// The bytes of one regular file.
class InputFile {
 public:
  /// Reads all of `path`.
  /// @throws FileError if it is missing, no regular file, unreadable, empty or larger than memory.
  explicit InputFile(const std::string& path);

  [[nodiscard]] std::string_view text() const { return {bytes_.get(), size_}; }

 private:
  std::unique_ptr<char[]> bytes_;
  std::size_t size_ = 0;
};

/// The checks of InputFile for a file that a library will open by its name. @throws FileError
void require_regular_file(const std::string& path);

}  // namespace camber::io
