// Any bytes are a mesh or one FileError; the first byte chooses the kind of UGRID.
#include <camber/io/ugrid/ugrid_reader.hpp>

#include <array>

#include "one_input.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return camber::fuzz::one_input(data, size, [](std::string_view bytes) {
    constexpr std::array k_names{"f.ugrid", "f.b8.ugrid", "f.lb8.ugrid", "f.r8.ugrid",
                                 "f.lr8.ugrid"};
    const auto kind =
        static_cast<unsigned char>(bytes.empty() ? 0 : bytes.front()) % k_names.size();
    if (!bytes.empty()) bytes.remove_prefix(1);
    static_cast<void>(camber::io::parse_ugrid(k_names[kind], bytes, ""));
  });
}
