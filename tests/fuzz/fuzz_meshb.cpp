// Any bytes are a mesh or one FileError.
#include <camber/io/meshb/meshb_reader.hpp>

#include "one_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return camber::fuzz::one_input(data, size, [](std::string_view bytes) {
    static_cast<void>(camber::io::parse_meshb("fuzz.meshb", bytes));
  });
}
