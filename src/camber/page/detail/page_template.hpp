#pragma once
#include <string_view>

namespace camber::detail {

/// The page without its data, as tools/build_page.sh made it; k_data_mark is where data goes.
[[nodiscard]] std::string_view page_template();
inline constexpr std::string_view k_data_mark = "<!--camber-data-->";

}  // namespace camber::detail
