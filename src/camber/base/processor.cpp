#include <camber/base/processor.hpp>

namespace camber {

bool has_lanes(int lanes) {
  if (lanes == 1 || lanes == 2) return true;
#if defined(CAMBER_KERNELS_AVX2)
  if (lanes == 4) return __builtin_cpu_supports("avx2") != 0;
#endif
#if defined(CAMBER_KERNELS_AVX512)
  if (lanes == 8) return __builtin_cpu_supports("avx512f") != 0;
#endif
  return false;
}

int widest_lanes() {
  for (int lanes = 8; lanes > 2; lanes /= 2) {
    if (has_lanes(lanes)) return lanes;
  }
  return 2;
}

}  // namespace camber
