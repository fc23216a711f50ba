#include <camber/io/base64.hpp>
#include <camber/page/detail/payload.hpp>

#include <bit>

#include <fmt/format.h>

namespace camber::detail {

static_assert(std::endian::native == std::endian::little, "the page's arrays are little-endian");

void Payload::put_bytes(std::string_view name, std::string_view type, std::string_view bytes) {
  text_ +=
      fmt::format("<script type=\"text/plain\" data-array=\"{}\" data-type=\"{}\">", name, type);
  text_ += io::encode_base64(bytes);
  text_ += "</script>\n";
}

void Payload::add_json(std::string_view name, std::string_view json) {
  text_ += fmt::format("<script type=\"application/json\" data-json=\"{}\">", name);
  for (char c : json) {
    // Only strings can hold it, and there an escape means the same.
    if (c == '<')
      text_ += "\\u003c";
    else
      text_ += c;
  }
  text_ += "</script>\n";
}

}  // namespace camber::detail
