#include <camber/base/error.hpp>

#include <utility>

namespace camber {
namespace {

std::string one_line(const std::string& what, const std::string& where, const std::string& remedy) {
  std::string line;
  if (!where.empty()) line += where + ": ";
  line += what;
  if (!remedy.empty()) line += " (" + remedy + ")";
  return line;
}

}  // namespace

Error::Error(std::string what, std::string where, std::string remedy)
    : std::runtime_error(one_line(what, where, remedy)),
      message_(std::move(what)),
      where_(std::move(where)),
      remedy_(std::move(remedy)) {}

}  // namespace camber
