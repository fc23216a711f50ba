#pragma once
// What a cost kernel reads and writes: plain pointers into tables that element_quality.cpp owns.

namespace camber::detail {

struct CostView {
  int nodes = 0, corners = 0, points = 0;
  const double* gradient = nullptr;           // [point][3][node]: d/dxi of the basis
  const double* straight_gradient = nullptr;  // [point][3][corner], of the linear basis
};

/// For `lanes` volume elements at once: the smallest C = min(1, tau) / WCN over the points, and the
/// sum over them.
/// @param x               [component][node][lane], @param corners [component][corner][lane]
/// @param minimum, sum    [lane]
using CostKernel = void (*)(const CostView& view, const double* x, const double* corners,
                            double* minimum, double* sum);

struct CostKernelChoice {
  CostKernel run = nullptr;
  int lanes = 1;
};
/// The kernel for 1, 2, 4 or 8 lanes; run is null where this build or this machine has none. All
/// give the same bits.
[[nodiscard]] CostKernelChoice cost_kernel_of(int lanes);

}  // namespace camber::detail
