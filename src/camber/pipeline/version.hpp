#pragma once
#include <string_view>

namespace camber {

/// Version of the library, "0.1.0".
[[nodiscard]] std::string_view version();

}  // namespace camber
