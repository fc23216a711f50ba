#include <camber/base/error.hpp>
#include <camber/io/base64.hpp>
#include <camber/io/vtu/vtu_arrays.hpp>

#include <algorithm>
#include <bit>
#include <charconv>
#include <cstdint>
#include <cstring>
#include <optional>
#include <pugixml.hpp>
#include <type_traits>

#include <fmt/format.h>

namespace camber::io::vtu {
namespace {

template <class From, class To>
bool convert(const std::string& bytes, bool is_swapped, std::vector<To>& values) {
  if (bytes.size() % sizeof(From) != 0) return false;
  values.reserve(bytes.size() / sizeof(From));
  for (std::size_t i = 0; i < bytes.size(); i += sizeof(From)) {
    char raw[sizeof(From)];
    std::memcpy(raw, bytes.data() + i, sizeof(From));
    if (is_swapped) std::reverse(raw, raw + sizeof(From));
    From value;
    std::memcpy(&value, raw, sizeof(From));
    if constexpr (std::is_floating_point_v<From> && !std::is_floating_point_v<To>) {
      return false;  // numbers of nodes and cells are integers
    } else {
      values.push_back(static_cast<To>(value));
    }
  }
  return true;
}

template <class To>
bool convert_named(std::string_view type, const std::string& bytes, bool swap,
                   std::vector<To>& values) {
  if (type == "Float64") return convert<double>(bytes, swap, values);
  if (type == "Float32") return convert<float>(bytes, swap, values);
  if (type == "Int64") return convert<std::int64_t>(bytes, swap, values);
  if (type == "UInt64") return convert<std::uint64_t>(bytes, swap, values);
  if (type == "Int32") return convert<std::int32_t>(bytes, swap, values);
  if (type == "UInt32") return convert<std::uint32_t>(bytes, swap, values);
  if (type == "Int16") return convert<std::int16_t>(bytes, swap, values);
  if (type == "UInt16") return convert<std::uint16_t>(bytes, swap, values);
  if (type == "Int8") return convert<std::int8_t>(bytes, swap, values);
  if (type == "UInt8") return convert<std::uint8_t>(bytes, swap, values);
  return false;
}

template <class T>
bool parse_text(std::string_view text, std::vector<T>& values) {
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    while (at != end && static_cast<unsigned char>(*at) <= ' ') ++at;
    if (at == end) return true;
    T value{};
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc{}) return false;
    if (next != end && static_cast<unsigned char>(*next) > ' ') return false;
    values.push_back(value);
    at = next;
  }
}

}  // namespace

Document::Document(const std::string& path, std::string_view bytes) : path_(path) {
  const std::size_t tag = bytes.find("<AppendedData");
  if (tag == std::string_view::npos) {
    xml_ = bytes;
    return;
  }
  // Raw bytes are no XML: they start behind the first '_' of the element.
  const std::size_t open = bytes.find('>', tag);
  const std::size_t mark = open == std::string_view::npos ? open : bytes.find('_', open);
  if (mark == std::string_view::npos) {
    fail("appended data without the '_' that starts it", "write the file again");
  }
  is_appended_base64_ = bytes.substr(tag, open - tag).find("base64") != std::string_view::npos;
  appended_ = bytes.substr(mark + 1);
  xml_ = std::string(bytes.substr(0, tag)) + "</VTKFile>";
}

void Document::fail(const std::string& what, const std::string& remedy) const {
  throw FileError(what, path_, remedy);
}

void Document::set_header(const pugi::xml_node& root) {
  if (std::string_view(root.attribute("type").value()) != "UnstructuredGrid") {
    fail(fmt::format("found a VTK file of type '{}', expected UnstructuredGrid",
                     root.attribute("type").value()),
         "");
  }
  if (root.attribute("compressor")) {
    fail("the data is compressed", "save the grid without compression (ParaView: Compressor None)");
  }
  const bool is_big = std::string_view(root.attribute("byte_order").value()) == "BigEndian";
  is_swapped_ = is_big != (std::endian::native == std::endian::big);
  header_bytes_ = std::string_view(root.attribute("header_type").value()) == "UInt64" ? 8 : 4;
}

std::string Document::binary(const pugi::xml_node& array) const {
  const auto broken = [&](const char* what) {
    fail(fmt::format("data array '{}' {}", array.attribute("Name").value(), what),
         "write the file again");
  };
  const bool is_appended = std::string_view(array.attribute("format").value()) == "appended";
  std::string_view source = array.child_value();
  bool is_base64 = true;
  if (is_appended) {
    const unsigned long long offset = array.attribute("offset").as_ullong();
    if (offset > appended_.size()) broken("begins behind the end of the file");
    source = appended_.substr(static_cast<std::size_t>(offset));
    is_base64 = is_appended_base64_;
  }
  std::string held;
  if (is_base64) {
    // Other arrays follow in the appended text: decode the length first, then what it asks for.
    const std::size_t digits = (header_bytes_ + 2) / 3 * 4;
    const std::size_t first = source.find_first_not_of(" \t\r\n");
    source.remove_prefix(first == std::string_view::npos ? source.size() : first);
    const std::optional<std::string> head = decode_base64_bytes(source.substr(0, digits));
    if (!head || head->size() < header_bytes_) broken("does not begin with its length");
    std::vector<unsigned long long> length;
    convert_named(header_bytes_ == 8 ? "UInt64" : "UInt32", head->substr(0, header_bytes_),
                  is_swapped_, length);
    if (length[0] > source.size()) broken("is shorter than it says");
    std::string_view text = source;
    if (is_appended) {  // one stream, or two where the length is padded
      const bool is_padded = source.substr(0, digits).find('=') != std::string_view::npos;
      const std::size_t bytes = static_cast<std::size_t>(length[0]);
      const std::size_t all =
          is_padded ? digits + (bytes + 2) / 3 * 4 : (header_bytes_ + bytes + 2) / 3 * 4;
      text = source.substr(0, all);
    }
    std::optional<std::string> decoded = decode_base64_bytes(text);
    if (!decoded) broken("is no base64");
    held = std::move(*decoded);
    source = held;
  }
  if (source.size() < header_bytes_) broken("has no length");
  std::vector<unsigned long long> length;
  convert_named(header_bytes_ == 8 ? "UInt64" : "UInt32",
                std::string(source.substr(0, header_bytes_)), is_swapped_, length);
  if (length[0] > source.size() - header_bytes_) broken("is shorter than it says");
  return std::string(source.substr(header_bytes_, static_cast<std::size_t>(length[0])));
}

template <class T>
std::vector<T> Document::values(const pugi::xml_node& array) const {
  if (!array) fail("a data array is missing", "write the file again");
  std::vector<T> result;
  const std::string_view format = array.attribute("format").value();
  const char* const type = array.attribute("type").value();
  bool is_good = false;
  if (format == "ascii") {
    is_good = parse_text(array.child_value(), result);
  } else if (format == "binary" || format == "appended") {
    is_good = convert_named(type, binary(array), is_swapped_, result);
  }
  if (!is_good) {
    fail(fmt::format("data array '{}' of type '{}' and format '{}' cannot be read",
                     array.attribute("Name").value(), type, format),
         "text, binary and appended numbers are");
  }
  return result;
}

std::vector<double> Document::reals(const pugi::xml_node& array) const {
  return values<double>(array);
}
std::vector<long long> Document::integers(const pugi::xml_node& array) const {
  return values<long long>(array);
}

}  // namespace camber::io::vtu
