#pragma once
// What an energy kernel reads and writes: plain pointers into tables that an EnergyPlan owns.

namespace camber::detail {

/// Which function of T = A W^-1 is summed over the samples of an element.
enum class EnergyKind {
  shape,    // distortion(): |T|^2 |cof T|^2 / (9 h^2) (h + 1/h) / 2, h regularised by delta
  quality,  // (WCN (1 + m^2))^k, m = max(0, 1/det T - 1): 1/C of [karman2022] eq. (2) with a smooth
            // cap, at rest where T is a rotation; +inf where det T <= 0
  metric    // |T|^2: its slope is the stiffness times the argument
};

/// Power k of the quality energy: the worst samples and cells count most, and it stays smooth.
inline constexpr int k_quality_power = 4;

struct EnergyView {
  int nodes = 0, corners = 0, samples = 0;
  const double* gradient = nullptr;           // [sample][3][node]: d/dxi of the basis
  const double* straight_gradient = nullptr;  // [sample][3][corner], of the linear basis
  const double* weight = nullptr;             // [sample]
};

/// For `lanes` elements at once: energy = sum_s weight_s f(T_s), least = min_s det T_s, and the
/// derivative by the nodes.
/// @param x         [component][node][lane], @param corners [component][corner][lane]
/// @param delta     [lane]
/// @param slope     [component][node][lane], overwritten
/// @param energy, least  [lane]
using EnergyKernel = void (*)(EnergyKind kind, const EnergyView& view, const double* x,
                              const double* corners, const double* delta, double* slope,
                              double* energy, double* least);

/// For `lanes` elements at once: sums[pair] = sum_s weight_s (W^-T grad N_a) . (W^-T grad N_b) for
/// pairs (a, b) of nodes, W the Jacobian of the straight element: entries of the stiffness that
/// EnergyKind::metric is the energy of.
/// @param corners  [component][corner][lane], in the order of the cell's corners
/// @param linear   [corner]: its node of the linear basis
/// @param pairs    [pair][2]
/// @param room     [3][node][lane], overwritten
/// @param sums     [pair][lane], overwritten
using StiffnessKernel = void (*)(const EnergyView& view, const double* corners, const int* linear,
                                 const int* pairs, int pair_count, double* room, double* sums);

struct EnergyKernelChoice {
  EnergyKernel run = nullptr;
  StiffnessKernel stiffness = nullptr;
  int lanes = 1;
};
/// The kernel for 1, 2, 4 or 8 lanes; run is null where this build or this machine has none. All
/// give the same bits.
[[nodiscard]] EnergyKernelChoice energy_kernel_of(int lanes);

}  // namespace camber::detail
