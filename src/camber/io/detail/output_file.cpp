#include <camber/base/error.hpp>
#include <camber/io/detail/output_file.hpp>

#include <cerrno>
#include <fcntl.h>
#include <unistd.h>

namespace camber::io {

void throw_write_error(const std::string& display, int error) {
  std::string remedy = "choose a folder that can be written to";
  if (error == ENOSPC || error == EDQUOT) remedy = "free some disk space or write elsewhere";
  if (error == EFBIG) remedy = "raise the limit of the file size (ulimit -f)";
  throw FileError("cannot be written: " + system_message(error), display, remedy);
}

OutputFile::OutputFile(const std::string& path, std::string display)
    : display_(std::move(display)),
      fd_(::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)) {
  if (fd_.value() < 0) throw_write_error(display_, errno);
}

void OutputFile::append(std::string_view text) {
  buffer_.append(text.data(), text.data() + text.size());
  if (buffer_.size() >= k_buffer) flush();
}

void OutputFile::flush() {
  const char* from = buffer_.data();
  std::size_t left = buffer_.size();
  if (has_hash_) hash_ = fnv1a({from, left}, hash_);
  size_ += left;
  while (left > 0) {
    const ssize_t n = ::write(fd_.value(), from, left);
    if (n < 0) {
      if (errno == EINTR) continue;
      throw_write_error(display_, errno);
    }
    from += n;
    left -= static_cast<std::size_t>(n);
  }
  buffer_.clear();
}

void OutputFile::finish() {
  flush();
  if (!fd_.close()) throw_write_error(display_, errno);
}

}  // namespace camber::io
