#include <camber/base/number_list.hpp>

#include <charconv>
#include <cmath>

namespace camber {

std::vector<double> comma_separated(std::string_view list,
                                    const std::function<void(std::string_view)>& refuse) {
  std::vector<double> numbers;
  while (true) {
    const std::string_view word = list.substr(0, list.find(','));
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (error != std::errc{} || end != word.data() + word.size() || !std::isfinite(value)) {
      refuse(word);
    }
    numbers.push_back(value);
    if (word.size() == list.size()) return numbers;
    list.remove_prefix(word.size() + 1);
  }
}

}  // namespace camber
