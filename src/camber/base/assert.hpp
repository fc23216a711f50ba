#pragma once
// Internal invariants: on in `dev` and `asan`, off in `release`. Never for user input.
#include <cstdio>
#include <cstdlib>

#if defined(CAMBER_ASSERTIONS)
#define CAMBER_ASSERT(condition, hint)                                                          \
  do {                                                                                          \
    if (!(condition)) {                                                                         \
      std::fprintf(stderr, "%s:%d: assertion failed: %s: %s\n", __FILE__, __LINE__, #condition, \
                   hint);                                                                       \
      std::abort();                                                                             \
    }                                                                                           \
  } while (false)
#else
#define CAMBER_ASSERT(condition, hint) static_cast<void>(0)
#endif
