#pragma once
// CGNS element types and calls, for the files of this folder only.
#include <camber/basis/shape.hpp>
#include <camber/io/detail/file_descriptor.hpp>

#include <cgnslib.h>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace camber::io::cgns {

/// A full Lagrange element that Camber handles.
struct ElementType {
  Shape shape = Shape::point;
  int order = 1;
};
[[nodiscard]] std::optional<ElementType> element_type(CGNS_ENUMT(ElementType_t) type);
/// @throws std::invalid_argument for orders beyond 4
[[nodiscard]] CGNS_ENUMT(ElementType_t) cgns_type(Shape shape, int order);

/// The library keeps its state in globals: one user at a time.
[[nodiscard]] std::mutex& library_mutex();

/// The library refuses files of a later version, though what Camber reads has not changed since
/// 3.4: such a file is read through a copy, in the folder for temporary files, that states the
/// library's own version.
class ReadableFile {
 public:
  /// @throws FileError if it is no CGNS file or the copy cannot be made
  explicit ReadableFile(const std::string& path);
  ~ReadableFile();
  ReadableFile(const ReadableFile&) = delete;
  ReadableFile& operator=(const ReadableFile&) = delete;

  /// A short name for it: the library writes names into messages of 200 bytes, whatever their
  /// length.
  [[nodiscard]] std::string short_name() const;

 private:
  std::string copy_;
  std::unique_ptr<FileDescriptor> open_;
};

/// An open file, closed at the end of its life.
class File {
 public:
  /// @throws FileError if the library refuses
  File(const std::string& path, int mode, std::string display);
  ~File();
  File(const File&) = delete;
  File& operator=(const File&) = delete;

  [[nodiscard]] int number() const { return number_; }
  [[nodiscard]] const std::string& display() const { return display_; }
  /// Turns a failed call into a FileError with the library's words.
  void require(int status, const std::string& what) const;
  void close();

 private:
  int number_ = -1;
  bool is_open_ = false;
  std::string display_;
};

/// Longest name of a CGNS node, and the room the library asks for.
inline constexpr std::size_t k_longest_name = 32, k_name_room = 33;

}  // namespace camber::io::cgns
