#include <camber/io/detail/file_descriptor.hpp>

#include <system_error>
#include <unistd.h>
#include <utility>

namespace camber::io {

FileDescriptor::~FileDescriptor() {
  if (value_ >= 0) ::close(value_);
}

bool FileDescriptor::close() { return ::close(std::exchange(value_, -1)) == 0; }

std::string system_message(int error) { return std::generic_category().message(error); }

}  // namespace camber::io
