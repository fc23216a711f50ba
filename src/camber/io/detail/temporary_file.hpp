#pragma once
#include <string>

namespace camber::io {

/// Where a file will really be written: links are followed, so that a link stays a link.
/// @throws FileError if `path` cannot become a file: empty, a folder, a device, a link to nothing,
/// in a
///         missing or unwritable folder, or an existing file that is write-protected.
[[nodiscard]] std::string writable_target(const std::string& path);

/// An empty file ".NAME.XXXXXX.tmp" beside `target`, created by nobody else (O_EXCL); removed at
/// the end of its life unless it was moved to the target.
class TemporaryFile {
 public:
  /// @param display  name used in errors
  TemporaryFile(const std::string& target, std::string display);
  ~TemporaryFile();
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] const std::string& path() const { return path_; }
  /// Flushes the content to the disk. @throws FileError
  void sync() const;
  /// Puts it in the place of the target in one step and flushes the folder. @throws FileError
  void replace_target();

 private:
  std::string target_, display_, path_;
};

}  // namespace camber::io
