#include <camber/base/error.hpp>
#include <camber/io/cgns/detail/cgns_types.hpp>

#include <cerrno>
#include <cgns_io.h>
#include <cstdlib>
#include <fcntl.h>
#include <filesystem>
#include <unistd.h>

#include <fmt/format.h>

namespace camber::io::cgns {
namespace {

/// The version as files state it: 3.4.
constexpr float k_library_version = static_cast<float>(CGNS_VERSION) / 1000.0F;
/// Files state versions as decimal fractions in single precision.
constexpr float k_version_slack = 1e-3F;

std::string descriptor_name(const FileDescriptor& fd) {
  return fmt::format("/proc/self/fd/{}", fd.value());
}

/// Calls use(library's number of the file, node of the version). @return false if there is none
template <class Use>
bool with_version(const std::string& path, int mode, const Use& use) {
  int file = 0;
  if (cgio_open_file(path.c_str(), mode, CGIO_FILE_NONE, &file) != CGIO_ERR_NONE) return false;
  double root = 0.0, node = 0.0;
  const bool is_there = cgio_get_root_id(file, &root) == CGIO_ERR_NONE &&
                        cgio_get_node_id(file, root, "CGNSLibraryVersion", &node) == CGIO_ERR_NONE;
  const bool is_done = is_there && use(file, node);
  return cgio_close_file(file) == CGIO_ERR_NONE && is_done;
}

}  // namespace

ReadableFile::ReadableFile(const std::string& path) {
  open_ = std::make_unique<FileDescriptor>(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (open_->value() < 0) throw FileError("cannot be opened: " + system_message(errno), path, "");
  float version = 0.0F;
  const bool is_cgns = with_version(descriptor_name(*open_), CGIO_MODE_READ, [&](int f, double n) {
    // One single-precision number, or the library's answer is no version at all.
    char type[CGIO_MAX_DATATYPE_LENGTH + 1] = {};
    int dimensions = 0;
    cgsize_t sizes[CGIO_MAX_DIMENSIONS] = {};
    return cgio_get_data_type(f, n, type) == CGIO_ERR_NONE && std::string(type) == "R4" &&
           cgio_get_dimensions(f, n, &dimensions, sizes) == CGIO_ERR_NONE && dimensions == 1 &&
           sizes[0] == 1 && cgio_read_all_data(f, n, &version) == CGIO_ERR_NONE;
  });
  if (!is_cgns) {
    throw FileError("found no CGNS file (HDF5 or ADF), or a damaged one", path,
                    "save the mesh again as CGNS");
  }
  if (version < k_library_version + k_version_slack) return;
  std::string pattern = (std::filesystem::temp_directory_path() / "camber_XXXXXX").string();
  const int number = ::mkostemp(pattern.data(), O_CLOEXEC);
  if (number < 0) {
    throw FileError("no temporary copy can be made: " + system_message(errno), path,
                    "set TMPDIR to a folder with room for the file");
  }
  copy_ = pattern;
  auto opened = std::make_unique<FileDescriptor>(number);
  std::error_code failed;
  std::filesystem::copy_file(path, copy_, std::filesystem::copy_options::overwrite_existing,
                             failed);
  const float stated = k_library_version;
  const bool is_done = !failed && with_version(copy_, CGIO_MODE_MODIFY, [&](int f, double n) {
    return cgio_write_all_data(f, n, &stated) == CGIO_ERR_NONE;
  });
  if (!is_done) {
    ::unlink(copy_.c_str());
    throw FileError(fmt::format("version {:.3g} of CGNS cannot be read by this library", version),
                    path, "set TMPDIR to a folder with room for a copy of the file");
  }
  open_ = std::move(opened);
}

ReadableFile::~ReadableFile() {
  if (!copy_.empty()) ::unlink(copy_.c_str());
}

std::string ReadableFile::short_name() const { return descriptor_name(*open_); }

}  // namespace camber::io::cgns
