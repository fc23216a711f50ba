#pragma once
#include <camber/base/error.hpp>

#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <sanitizer/allocator_interface.h>
#include <string_view>

namespace camber::fuzz {

/// Bytes in use, and the most that were in use since `peak` was last set. One thread.
struct Memory {
  std::size_t now = 0, peak = 0;
};
inline Memory memory;

inline void count_malloc(const volatile void* /*block*/, std::size_t size) {
  memory.now += size;
  if (memory.now > memory.peak) memory.peak = memory.now;
}
inline void count_free(const volatile void* block) {
  if (block == nullptr) return;
  // Blocks from before the hooks were set were never counted.
  const std::size_t size = __sanitizer_get_allocated_size(block);
  memory.now -= size < memory.now ? size : memory.now;
}
inline const bool k_hooked =
    __sanitizer_install_malloc_and_free_hooks(count_malloc, count_free) != 0;

/// What a reader may take at any moment: 4 times the file plus 64 MiB.
inline constexpr std::size_t k_memory_factor = 4, k_memory_base = std::size_t{64} << 20;

/// Runs a reader on the bytes. Errors of the file are what it shall find; anything else that is
/// thrown ends the fuzzer, and so does a reader that takes more memory than is allowed.
template <class Parse>
int one_input(const std::uint8_t* data, std::size_t size, const Parse& parse) {
  const std::size_t before = memory.now;
  memory.peak = before;
  try {
    parse(std::string_view(reinterpret_cast<const char*>(data), size));
  } catch (const FileError&) {
    static_cast<void>(k_hooked);
  }
  if (memory.peak - before > k_memory_factor * size + k_memory_base) {
    static_cast<void>(std::fprintf(stderr, "reader took %zu bytes for a file of %zu\n",
                                   memory.peak - before, size));
    std::abort();
  }
  return 0;
}

}  // namespace camber::fuzz
