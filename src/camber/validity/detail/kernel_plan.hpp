#pragma once
// What a determinant kernel reads and writes: plain pointers into tables that a DeterminantPlan
// owns. The kernels are compiled once per instruction set, so no inline library code may be
// instantiated there.
#include <cstdint>

namespace camber::detail {

/// A run of coefficients: start, start + 1, .. start + length - 1.
struct CoefficientRow {
  std::int32_t start = 0;
  std::int32_t length = 0;
};

/// out[o][r][i] = sum_c matrix[r * columns + c] * in[o][c][i]; i < inner, o < outer.
struct PassView {
  const double* matrix = nullptr;
  int rows = 0, columns = 0, inner = 1, outer = 1;
};

/// Product of two polynomials in scaled Bernstein form: row i of a times row j of b is added to the
/// product from coefficient out[i * b_rows + j] on.
struct ProductView {
  const CoefficientRow* a = nullptr;
  const CoefficientRow* b = nullptr;
  const std::int32_t* out = nullptr;
  int a_rows = 0, b_rows = 0, size = 0;
};

/// One column of dx/dxi as a scaled Bernstein net: the passes applied to differences of nodes.
struct ColumnView {
  const std::int32_t* from = nullptr;  // difference d is node[to[d]] - node[from[d]]
  const std::int32_t* to = nullptr;
  const double* inverse_multinomial = nullptr;  // of the net: scaled -> plain coefficient
  const PassView* passes = nullptr;
  int differences = 0, pass_count = 0, size = 0;
  double rounding = 0.0;  // error of a plain coefficient <= rounding * u * max |difference|
};

/// det of three columns; a face has two, its third is the normal of the straight face.
struct KernelPlan {
  int nodes = 0, columns = 3;
  ColumnView column[3];
  ProductView cross;                            // column 0 x column 1
  ProductView dot;                              // (column 0 x column 1) . column 2
  const double* inverse_multinomial = nullptr;  // of the determinant
  const std::int32_t* corner = nullptr;         // coefficients that are values at corners
  int corners = 0, size = 0;
  double rounding = 0.0;  // error of a coefficient <= rounding * u * sum of magnitudes
  int work = 0;           // values of scratch a lane
};

/// The straight copy: its nodes are corners of the curved element, its determinant is raised to the
/// degree of the curved one.
struct StraightView {
  const KernelPlan* plan = nullptr;
  const std::int32_t* corner_node = nullptr;  // node of the curved element for node n of the plan
  const PassView* passes = nullptr;
  int pass_count = 0;
  int work = 0;
};

/// What a kernel finds; every pointer is to one value per lane unless said otherwise.
struct KernelOutput {
  double* coefficients = nullptr;           // [size][lane] plain Bernstein coefficients
  double* straight_coefficients = nullptr;  // [size][lane] those of the straight copy
  double* margin = nullptr;                 // round-off bound of every coefficient
  double* straight_margin = nullptr;
  double* lowest = nullptr;  // of the coefficients
  double* highest = nullptr;
  double* corner_lowest = nullptr;  // of those that are values at corners
  double* corner_highest = nullptr;
  double* ratio_lowest = nullptr;  // certified lower bound of curved / straight; -inf if none
  double* ratio_corner = nullptr;  // certified upper bound of the ratio's minimum
  double* finite = nullptr;        // 0 if all went well, NaN otherwise
};

/// Determinant of `lanes` elements at once. `nodes` is [component][node][lane]; with `straight`
/// also the straight copy and the ratios. A plan with two columns is a face and needs `straight`:
/// its determinant is n . N, that of the straight copy |N|^2.
using Kernel = void (*)(const KernelPlan& plan, const StraightView* straight, const double* nodes,
                        double* work, const KernelOutput& out);

/// A kernel and how many elements it takes; all kernels give the same bits.
struct KernelChoice {
  Kernel run = nullptr;
  int lanes = 1;
};
/// The kernel for 1, 2, 4 or 8 lanes; run is null where this build or this machine has none.
[[nodiscard]] KernelChoice kernel_of(int lanes);
[[nodiscard]] KernelChoice scalar_kernel();
/// The one with the most lanes this machine has.
[[nodiscard]] KernelChoice widest_kernel();

}  // namespace camber::detail
