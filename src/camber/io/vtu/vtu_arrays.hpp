#pragma once
// The data arrays of VTK's XML files, in every encoding but the compressed ones.
#include <string>
#include <string_view>
#include <vector>

namespace pugi {
class xml_node;
}

namespace camber::io::vtu {

/// A file cut into its XML and what is appended behind it.
class Document {
 public:
  /// @param path  for messages; `bytes` must live as long as the document
  /// @throws FileError for other files than uncompressed grids
  Document(const std::string& path, std::string_view bytes);

  /// XML without the appended data.
  [[nodiscard]] const std::string& xml() const { return xml_; }
  /// What the attributes of <VTKFile> say. @throws FileError
  void set_header(const pugi::xml_node& root);

  /// The values of a <DataArray>, as doubles or 64-bit integers.
  /// @throws FileError if it is damaged or no number fits
  [[nodiscard]] std::vector<double> reals(const pugi::xml_node& array) const;
  [[nodiscard]] std::vector<long long> integers(const pugi::xml_node& array) const;

  [[noreturn]] void fail(const std::string& what, const std::string& remedy) const;

 private:
  template <class T>
  [[nodiscard]] std::vector<T> values(const pugi::xml_node& array) const;
  [[nodiscard]] std::string binary(const pugi::xml_node& array) const;

  const std::string& path_;
  std::string xml_;
  std::string_view appended_;
  bool is_appended_base64_ = false, is_swapped_ = false;
  std::size_t header_bytes_ = 4;
};

}  // namespace camber::io::vtu
