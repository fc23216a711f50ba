#pragma once
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace camber::io {

/// Little-endian 32-bit integers in base64 (RFC 4648); white space is skipped. Empty if the text is
/// no base64 or not a whole number of integers.
[[nodiscard]] std::optional<std::vector<std::int32_t>> decode_base64(std::string_view text);
/// The bytes of base64 text; white space is skipped, and padding may stand after any four digits,
/// as where encoded pieces follow each other. Empty if the text is no base64.
[[nodiscard]] std::optional<std::string> decode_base64_bytes(std::string_view text);
/// Any bytes in base64 (RFC 4648), in one line.
[[nodiscard]] std::string encode_base64(std::string_view bytes);

}  // namespace camber::io
