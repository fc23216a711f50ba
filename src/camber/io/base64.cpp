#include <camber/io/base64.hpp>

namespace camber::io {
namespace {

constexpr std::string_view k_digits =
    "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

std::optional<std::vector<std::int32_t>> decode_base64(std::string_view text) {
  std::vector<std::uint8_t> bytes;
  std::uint32_t bits = 0;
  int count = 0;  // of the bits held
  std::size_t digits = 0, padding = 0;
  for (char c : text) {
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    if (c == '=') {
      ++padding;
      continue;
    }
    const std::size_t value = k_digits.find(c);
    if (value == std::string_view::npos || padding > 0) return {};
    ++digits;
    bits = (bits << 6) | static_cast<std::uint32_t>(value);
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes.push_back(static_cast<std::uint8_t>((bits >> count) & 0xffu));
  }
  if ((digits + padding) % 4 != 0 || padding > 2 || bytes.size() % 4 != 0) return {};
  std::vector<std::int32_t> values;
  for (std::size_t i = 0; i < bytes.size(); i += 4) {
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) {
      value |= static_cast<std::uint32_t>(bytes[i + k]) << (8 * k);
    }
    values.push_back(static_cast<std::int32_t>(value));
  }
  return values;
}

std::optional<std::string> decode_base64_bytes(std::string_view text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int digits = 0, padding = 0;  // of the current four
  for (const char c : text) {
    if (c == ' ' || c == '\n' || c == '\r' || c == '\t') continue;
    const std::size_t value = c == '=' ? 0 : k_digits.find(c);
    if (value == std::string_view::npos || (c != '=' && padding > 0)) return {};
    bits = (bits << 6) | static_cast<std::uint32_t>(value);
    padding += c == '=' ? 1 : 0;
    if (++digits < 4) continue;
    if (padding > 2) return {};
    for (int k = 0; k < 3 - padding; ++k) {
      bytes += static_cast<char>((bits >> (16 - 8 * k)) & 0xffu);
    }
    bits = 0;
    digits = padding = 0;
  }
  if (digits != 0) return {};
  return bytes;
}

std::string encode_base64(std::string_view bytes) {
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t triple = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool inside = i + k < bytes.size();
      triple = (triple << 8U) | (inside ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool inside = k <= bytes.size() - i;
      text += inside ? k_digits[(triple >> (18 - 6 * k)) & 63U] : '=';
    }
  }
  return text;
}

}  // namespace camber::io
