#pragma once
#include <string>

namespace camber::io {

/// Owns a POSIX file descriptor; closes it when it goes.
class FileDescriptor {
 public:
  explicit FileDescriptor(int value) : value_(value) {}
  ~FileDescriptor();
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  [[nodiscard]] int value() const { return value_; }
  /// Closes now. @return false with errno set if the system reports a late write error.
  [[nodiscard]] bool close();

 private:
  int value_;
};

/// Text of an errno value. Any thread.
[[nodiscard]] std::string system_message(int error);

}  // namespace camber::io
