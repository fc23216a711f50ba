#pragma once
#include <functional>
#include <string_view>
#include <vector>

namespace camber {

/// The numbers of "1,2.5,-3e4". `refuse` is called with the first word that is no finite number and
/// must throw.
[[nodiscard]] std::vector<double> comma_separated(
    std::string_view list, const std::function<void(std::string_view)>& refuse);

}  // namespace camber
