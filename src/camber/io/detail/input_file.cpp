#include <camber/base/error.hpp>
#include <camber/io/detail/file_descriptor.hpp>
#include <camber/io/detail/input_file.hpp>

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <new>
#include <sys/stat.h>
#include <unistd.h>

namespace camber::io {
namespace {

/// A system call may refuse more than 2 GiB at once.
constexpr std::size_t k_read_chunk = std::size_t{1} << 30;

/// Opens without waiting: a pipe must not wait for a writer; it is refused afterwards.
int open_for_reading(const std::string& path) {
  const int number = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
  if (number < 0) {
    const int error = errno;
    throw FileError("cannot be opened: " + system_message(error), path,
                    error == ENOENT ? "check the name and the folder" : "");
  }
  return number;
}

/// Size of a regular file with content; anything else is refused.
std::size_t examined_size(const FileDescriptor& fd, const std::string& path) {
  struct stat status {};
  if (::fstat(fd.value(), &status) != 0) {
    throw FileError("cannot be examined: " + system_message(errno), path, "");
  }
  if (S_ISDIR(status.st_mode)) {
    throw FileError("found a folder, expected a mesh file", path, "name a file in it");
  }
  if (!S_ISREG(status.st_mode)) {
    throw FileError("found a device or a pipe, expected a regular file", path, "");
  }
  if (status.st_size == 0) {
    throw FileError("found an empty file, expected a mesh", path, "write it again");
  }
  return static_cast<std::size_t>(status.st_size);
}

}  // namespace

void require_regular_file(const std::string& path) {
  const FileDescriptor fd(open_for_reading(path));
  static_cast<void>(examined_size(fd, path));
}

InputFile::InputFile(const std::string& path) {
  const FileDescriptor fd(open_for_reading(path));
  const std::size_t expected = examined_size(fd, path);
  try {
    bytes_ = std::make_unique_for_overwrite<char[]>(expected);
  } catch (const std::bad_alloc&) {
    throw FileError("the file of " + std::to_string(expected) + " bytes does not fit into memory",
                    path, "use a machine with more memory");
  }
  while (size_ < expected) {
    const ssize_t n =
        ::read(fd.value(), bytes_.get() + size_, std::min(k_read_chunk, expected - size_));
    if (n < 0) {
      if (errno == EINTR) continue;
      throw FileError("cannot be read: " + system_message(errno), path, "");
    }
    if (n == 0) break;  // shrunk while being read: the parser names what is missing
    size_ += static_cast<std::size_t>(n);
  }
}

}  // namespace camber::io
