#include <camber/base/error.hpp>
#include <camber/io/detail/file_descriptor.hpp>
#include <camber/io/detail/output_file.hpp>
#include <camber/io/detail/temporary_file.hpp>

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <random>
#include <sys/stat.h>
#include <unistd.h>
#include <utility>

namespace camber::io {
namespace {

namespace fs = std::filesystem;

/// Longest file name of common file systems, and what the temporary adds to it: two dots, six
/// random letters, ".tmp".
constexpr std::size_t k_name_max = 255, k_decoration = 12;
constexpr int k_attempts = 100;

std::string folder_of(const std::string& target) {
  const std::string folder = fs::path(target).parent_path().string();
  return folder.empty() ? "." : folder;
}

/// For the effective user, as opening the file will be.
bool may_use(const std::string& path, int mode) {
  return ::faccessat(AT_FDCWD, path.c_str(), mode, AT_EACCESS) == 0;
}

std::string random_letters() {
  static constexpr std::string_view k_letters = "abcdefghijklmnopqrstuvwxyz0123456789";
  std::random_device source;
  std::uniform_int_distribution<std::size_t> pick(0, k_letters.size() - 1);
  std::string letters;
  for (int i = 0; i < 6; ++i) letters += k_letters[pick(source)];
  return letters;
}

}  // namespace

std::string writable_target(const std::string& path) {
  if (path.empty()) throw FileError("no name given for the file to write", "", "name a file");
  std::string target = path;
  struct stat status {};
  if (::lstat(path.c_str(), &status) == 0 && S_ISLNK(status.st_mode)) {
    std::error_code error;
    target = fs::canonical(path, error).string();
    if (error) throw FileError("is a link to nothing", path, "remove the link or repair it");
  }
  if (::stat(target.c_str(), &status) == 0) {
    if (S_ISDIR(status.st_mode)) {
      throw FileError("is a folder, expected the name of a file", path, "name a file in it");
    }
    if (!S_ISREG(status.st_mode)) {
      throw FileError("is a device or a pipe, expected a regular file", path, "");
    }
    if (!may_use(target, W_OK)) {
      throw FileError("is write-protected: " + system_message(errno), path,
                      "choose another name or allow writing");
    }
  }
  if (target.back() == '/') throw FileError("is the name of a folder", path, "name a file in it");
  const std::string folder = folder_of(target);
  if (::stat(folder.c_str(), &status) != 0) {
    throw FileError("its folder cannot be used: " + system_message(errno), path,
                    "create the folder " + folder);
  }
  if (!S_ISDIR(status.st_mode)) throw FileError(folder + " is not a folder", path, "");
  if (!may_use(folder, W_OK | X_OK)) throw_write_error(path, errno);
  if (fs::path(target).filename().string().size() > k_name_max) {
    throw_write_error(path, ENAMETOOLONG);
  }
  return target;
}

TemporaryFile::TemporaryFile(const std::string& target, std::string display)
    : target_(target), display_(std::move(display)) {
  const std::string name =
      fs::path(target).filename().string().substr(0, k_name_max - k_decoration);
  for (int attempt = 0;; ++attempt) {
    path_ = (fs::path(folder_of(target)) / ("." + name + "." + random_letters() + ".tmp")).string();
    FileDescriptor fd(::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666));
    if (fd.value() >= 0) {
      // The new file keeps the permissions of the one it replaces; not vital if refused.
      struct stat old {};
      if (::stat(target.c_str(), &old) == 0) {
        static_cast<void>(::fchmod(fd.value(), old.st_mode & 07777U) == 0);
      }
      return;
    }
    if (errno != EEXIST || attempt == k_attempts) throw_write_error(display_, errno);
  }
}

TemporaryFile::~TemporaryFile() {
  if (!path_.empty()) ::unlink(path_.c_str());
}

void TemporaryFile::sync() const {
  FileDescriptor fd(::open(path_.c_str(), O_RDONLY | O_CLOEXEC));
  if (fd.value() < 0 || ::fsync(fd.value()) != 0 || !fd.close()) throw_write_error(display_, errno);
}

void TemporaryFile::replace_target() {
  if (std::rename(path_.c_str(), target_.c_str()) != 0) throw_write_error(display_, errno);
  path_.clear();
  FileDescriptor folder(::open(folder_of(target_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  // Some file systems cannot flush folders and say EINVAL; the file itself is complete then.
  if (folder.value() >= 0 && ::fsync(folder.value()) != 0 && errno != EINVAL) {
    throw_write_error(display_, errno);
  }
}

}  // namespace camber::io
