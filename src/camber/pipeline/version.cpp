#include <camber/pipeline/version.hpp>

namespace camber {

std::string_view version() { return CAMBER_VERSION; }

}  // namespace camber
