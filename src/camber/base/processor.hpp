#pragma once

namespace camber {

/// Doubles that one instruction of this machine works on, for kernels that this build has: 8
/// (AVX-512), 4 (AVX2) or 2.
[[nodiscard]] int widest_lanes();
/// Kernels of that many lanes exist in this build and run on this machine.
[[nodiscard]] bool has_lanes(int lanes);

}  // namespace camber
