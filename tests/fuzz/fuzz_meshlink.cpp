// Any bytes are a link or one FileError.
#include <camber/io/meshlink/meshlink.hpp>

#include "one_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return camber::fuzz::one_input(data, size, [](std::string_view bytes) {
    static_cast<void>(camber::io::parse_meshlink("fuzz.xml", bytes));
  });
}
