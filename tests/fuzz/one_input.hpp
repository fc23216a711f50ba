#pragma once
#include <camber/base/error.hpp>

#include <cstddef>
#include <cstdint>
#include <string_view>

namespace camber::fuzz {

/// Runs a reader on the bytes. Errors of the file are what it shall find; anything else that is
/// thrown ends the fuzzer.
template <class Parse>
int one_input(const std::uint8_t* data, std::size_t size, const Parse& parse) {
  try {
    parse(std::string_view(reinterpret_cast<const char*>(data), size));
  } catch (const FileError&) {
    return 0;
  }
  return 0;
}

}  // namespace camber::fuzz
