#pragma once
// Buffered writing with errors that name the user's file.
#include <camber/io/detail/file_descriptor.hpp>
#include <camber/io/detail/hash.hpp>

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace camber::io {

/// Writes a file from its start; the whole of it is on disk only after finish().
class OutputFile {
 public:
  /// @param path     file to create or to empty
  /// @param display  name used in errors (the user's file, when `path` is a temporary)
  /// @throws FileError
  OutputFile(const std::string& path, std::string display);

  void append(std::string_view text);
  /// Bytes of a number in the machine's own order.
  template <class T>
  void append_raw(const T& value) {
    char bytes[sizeof(T)];
    std::memcpy(bytes, &value, sizeof(T));
    append({bytes, sizeof(T)});
  }
  template <class... Arguments>
  void print(fmt::format_string<Arguments...> format, Arguments&&... arguments) {
    fmt::format_to(fmt::appender(buffer_), format, std::forward<Arguments>(arguments)...);
    if (buffer_.size() >= k_buffer) flush();
  }

  /// hash() is not asked for: saves its time.
  void leave_out_hash() { has_hash_ = false; }
  /// Writes what is left and closes. @throws FileError
  void finish();
  /// FNV-1a hash and number of all bytes given so far; call after finish().
  [[nodiscard]] std::uint64_t hash() const { return hash_; }
  [[nodiscard]] std::uint64_t size() const { return size_; }

 private:
  static constexpr std::size_t k_buffer = std::size_t{1} << 20;
  void flush();

  std::string display_;
  FileDescriptor fd_;
  fmt::memory_buffer buffer_;
  std::uint64_t hash_ = k_fnv_start;
  std::uint64_t size_ = 0;
  bool has_hash_ = true;
};

/// The error for a failed write: what went wrong and what to do about it.
[[noreturn]] void throw_write_error(const std::string& display, int error);

}  // namespace camber::io
