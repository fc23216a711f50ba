#pragma once
// Arrays and facts in the form that the page's script reads.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace camber::detail {

/// HTML elements that hold arrays as base64 of little-endian numbers, and one with JSON.
class Payload {
 public:
  void add(std::string_view name, std::span<const float> values) { put(name, "f32", values); }
  void add(std::string_view name, std::span<const double> values) { put(name, "f64", values); }
  void add(std::string_view name, std::span<const std::int16_t> values) {
    put(name, "i16", values);
  }
  void add(std::string_view name, std::span<const std::uint8_t> values) { put(name, "u8", values); }
  void add(std::string_view name, std::span<const std::uint16_t> values) {
    put(name, "u16", values);
  }
  void add(std::string_view name, std::span<const std::uint32_t> values) {
    put(name, "u32", values);
  }
  /// JSON; what could end a script element is escaped.
  void add_json(std::string_view name, std::string_view json);

  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  template <class T>
  void put(std::string_view name, std::string_view type, std::span<const T> values) {
    put_bytes(name, type,
              {reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
  }
  void put_bytes(std::string_view name, std::string_view type, std::string_view bytes);

  std::string text_;
};

}  // namespace camber::detail
