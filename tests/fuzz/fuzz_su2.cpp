// Any bytes are a mesh or one FileError.
#include <camber/io/su2/su2_reader.hpp>

#include "one_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return camber::fuzz::one_input(data, size, [](std::string_view bytes) {
    static_cast<void>(camber::io::parse_su2("fuzz.su2", bytes));
  });
}
