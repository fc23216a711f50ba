// The determinant kernel, written once for any number of lanes. Included by the kernel_*.cpp files
// only, each compiled for one instruction set: everything here has internal linkage on purpose, and
// no library header may be used.
#pragma once
#include <camber/base/lanes.hpp>
#include <camber/validity/detail/kernel_plan.hpp>

namespace camber::detail {
namespace {

constexpr double k_unit_roundoff = 0x1p-53;
// Below this a product of three differences may have lost digits to underflow.
constexpr double k_underflow = 0x1p-1000;

template <int W>
void apply(const PassView& pass, const Pack<W>* __restrict in, Pack<W>* __restrict out) {
  for (int o = 0; o < pass.outer; ++o) {
    for (int r = 0; r < pass.rows; ++r) {
      const double* row = pass.matrix + r * pass.columns;
      for (int i = 0; i < pass.inner; ++i) out[i] = row[0] * in[i];
      for (int c = 1; c < pass.columns; ++c) {
        const Pack<W>* x = in + c * pass.inner;
        for (int i = 0; i < pass.inner; ++i) out[i] = out[i] + row[c] * x[i];
      }
      out += pass.inner;
    }
    in += pass.columns * pass.inner;
  }
}

/// Applies all passes to `values`; the result is in the returned one of the two buffers.
template <int W>
Pack<W>* apply_all(const PassView* passes, int count, Pack<W>* values, Pack<W>* other) {
  for (int p = 0; p < count; ++p) {
    apply(passes[p], values, other);
    Pack<W>* swap = values;
    values = other;
    other = swap;
  }
  return values;
}

template <int W>
struct Column {
  Pack<W>* net[3];   // scaled coefficients of each component
  Pack<W> peak[3];   // largest plain coefficient, by magnitude
  Pack<W> error[3];  // bound of a plain coefficient's error, in units of u
};

template <int W>
Column<W> column_net(const ColumnView& view, int nodes, const Pack<W>* x, Scratch<W>& scratch) {
  Column<W> column;
  int room = view.differences;
  for (int p = 0; p < view.pass_count; ++p) {
    const int size = view.passes[p].rows * view.passes[p].inner * view.passes[p].outer;
    room = size > room ? size : room;
  }
  for (int d = 0; d < 3; ++d) {
    Pack<W>* difference = scratch.take(room);
    Pack<W>* other = scratch.take(room);
    const Pack<W>* xd = x + d * nodes;
    Pack<W> largest{};
    for (int n = 0; n < view.differences; ++n) {
      difference[n] = xd[view.to[n]] - xd[view.from[n]];
      largest = higher(largest, magnitude(difference[n]));
    }
    column.net[d] = apply_all(view.passes, view.pass_count, difference, other);
    Pack<W> peak{};
    for (int n = 0; n < view.size; ++n) {
      peak = higher(peak, view.inverse_multinomial[n] * magnitude(column.net[d][n]));
    }
    column.peak[d] = peak;
    column.error[d] = view.rounding * largest;
  }
  return column;
}

/// Sum of the magnitudes of the six products in a determinant.
template <int W>
Pack<W> permanent(const Pack<W>* a, const Pack<W>* b, const Pack<W>* c) {
  return a[0] * (b[1] * c[2] + b[2] * c[1]) + a[1] * (b[0] * c[2] + b[2] * c[0]) +
         a[2] * (b[0] * c[1] + b[1] * c[0]);
}

/// out_d += (a x b)_d; scaled form.
template <int W>
void cross(const ProductView& view, Pack<W>* const* a, Pack<W>* const* b, Pack<W>* const* out) {
  for (int d = 0; d < 3; ++d) {
    for (int n = 0; n < view.size; ++n) out[d][n] = Pack<W>{};
  }
  for (int i = 0; i < view.a_rows; ++i) {
    const CoefficientRow row_a = view.a[i];
    for (int j = 0; j < view.b_rows; ++j) {
      const CoefficientRow row_b = view.b[j];
      const int to = view.out[i * view.b_rows + j];
      for (int s = 0; s < row_a.length; ++s) {
        const Pack<W> ax = a[0][row_a.start + s], ay = a[1][row_a.start + s],
                      az = a[2][row_a.start + s];
        const Pack<W>* __restrict bx = b[0] + row_b.start;
        const Pack<W>* __restrict by = b[1] + row_b.start;
        const Pack<W>* __restrict bz = b[2] + row_b.start;
        Pack<W>* __restrict ox = out[0] + to + s;
        Pack<W>* __restrict oy = out[1] + to + s;
        Pack<W>* __restrict oz = out[2] + to + s;
        for (int t = 0; t < row_b.length; ++t) {
          ox[t] = ox[t] + (ay * bz[t] - az * by[t]);
          oy[t] = oy[t] + (az * bx[t] - ax * bz[t]);
          oz[t] = oz[t] + (ax * by[t] - ay * bx[t]);
        }
      }
    }
  }
}

/// out = a . b; scaled form.
template <int W>
void dot(const ProductView& view, Pack<W>* const* a, Pack<W>* const* b, Pack<W>* __restrict out) {
  for (int n = 0; n < view.size; ++n) out[n] = Pack<W>{};
  for (int i = 0; i < view.a_rows; ++i) {
    const CoefficientRow row_a = view.a[i];
    const Pack<W>* __restrict ax = a[0] + row_a.start;
    const Pack<W>* __restrict ay = a[1] + row_a.start;
    const Pack<W>* __restrict az = a[2] + row_a.start;
    for (int j = 0; j < view.b_rows; ++j) {
      const CoefficientRow row_b = view.b[j];
      Pack<W>* o = out + view.out[i * view.b_rows + j];
      for (int s = 0; s < row_b.length; ++s, ++o) {
        const Pack<W> bx = b[0][row_b.start + s], by = b[1][row_b.start + s],
                      bz = b[2][row_b.start + s];
        for (int t = 0; t < row_a.length; ++t) {
          o[t] = o[t] + ((ax[t] * bx + ay[t] * by) + az[t] * bz);
        }
      }
    }
  }
}

template <int W>
struct Determinant {
  Pack<W>* coefficients;
  Pack<W> margin;
};

/// Plain coefficients of (a x b) . c and their round-off bound. `area` is a x b, with its columns'
/// peaks.
template <int W>
Determinant<W> finish(const KernelPlan& plan, Pack<W>* const* area, const Column<W>* column,
                      Scratch<W>& scratch) {
  Determinant<W> result;
  result.coefficients = scratch.take(plan.size);
  dot(plan.dot, area, column[2].net, result.coefficients);
  for (int n = 0; n < plan.size; ++n) {
    result.coefficients[n] = plan.inverse_multinomial[n] * result.coefficients[n];
  }
  const Column<W>&a = column[0], &b = column[1], &c = column[2];
  const Pack<W> products = permanent(a.peak, b.peak, c.peak);
  const Pack<W> inherited = permanent(a.error, b.peak, c.peak) +
                            permanent(a.peak, b.error, c.peak) + permanent(a.peak, b.peak, c.error);
  result.margin =
      k_unit_roundoff * (plan.rounding * products + 2.0 * inherited) + broadcast<W>(k_underflow);
  return result;
}

/// Columns 0 and 1, and their cross product.
template <int W>
void area_net(const KernelPlan& plan, const Pack<W>* x, Column<W>* column, Pack<W>** area,
              Scratch<W>& scratch) {
  column[0] = column_net(plan.column[0], plan.nodes, x, scratch);
  column[1] = column_net(plan.column[1], plan.nodes, x, scratch);
  for (int d = 0; d < 3; ++d) area[d] = scratch.take(plan.cross.size);
  cross(plan.cross, column[0].net, column[1].net, area);
}

template <int W>
Determinant<W> volume_determinant(const KernelPlan& plan, const Pack<W>* x, Scratch<W>& scratch) {
  Column<W> column[3];
  Pack<W>* area[3];
  area_net(plan, x, column, area, scratch);
  column[2] = column_net(plan.column[2], plan.nodes, x, scratch);
  return finish(plan, area, column, scratch);
}

/// n . N of a face and |N|^2 of its straight copy.
template <int W>
void face_determinants(const KernelPlan& plan, const KernelPlan& straight_plan, const Pack<W>* x,
                       const Pack<W>* straight_x, Scratch<W>& scratch, Determinant<W>& curved,
                       Determinant<W>& straight) {
  Column<W> straight_column[3], column[3];
  Pack<W>* straight_area[3];
  Pack<W>* area[3];
  area_net(straight_plan, straight_x, straight_column, straight_area, scratch);
  area_net(plan, x, column, area, scratch);
  Column<W>& normal = straight_column[2];
  for (int d = 0; d < 3; ++d) {
    const int e = (d + 1) % 3, f = (d + 2) % 3;
    const Column<W>&a = straight_column[0], &b = straight_column[1];
    normal.net[d] = straight_area[d];
    normal.peak[d] = a.peak[e] * b.peak[f] + a.peak[f] * b.peak[e];
    normal.error[d] = straight_plan.rounding * normal.peak[d] +
                      2.0 * (a.error[e] * b.peak[f] + a.error[f] * b.peak[e] +
                             a.peak[e] * b.error[f] + a.peak[f] * b.error[e]);
  }
  column[2] = normal;
  curved = finish(plan, area, column, scratch);
  straight = finish(straight_plan, straight_area, straight_column, scratch);
}

template <int W>
void store(const Pack<W>& value, double* to) {
  *reinterpret_cast<Pack<W>*>(to) = value;
}

template <int W>
void summarise(const KernelPlan& plan, const Determinant<W>& curved, const KernelOutput& out) {
  const Pack<W>* c = curved.coefficients;
  Pack<W> low = c[0], high = c[0], sum{};
  for (int n = 0; n < plan.size; ++n) {
    low = lower(low, c[n]);
    high = higher(high, c[n]);
    sum = sum + c[n];
  }
  Pack<W> corner_low = c[plan.corner[0]], corner_high = corner_low;
  for (int n = 1; n < plan.corners; ++n) {
    corner_low = lower(corner_low, c[plan.corner[n]]);
    corner_high = higher(corner_high, c[plan.corner[n]]);
  }
  store(low, out.lowest);
  store(high, out.highest);
  store(corner_low, out.corner_lowest);
  store(corner_high, out.corner_highest);
  store(curved.margin, out.margin);
  sum = sum + curved.margin;
  store(sum - sum, out.finite);
}

template <int W>
void summarise_ratio(const KernelPlan& plan, const Determinant<W>& curved,
                     const Determinant<W>& straight, const KernelOutput& out) {
  const Pack<W> infinity = broadcast<W>(__builtin_inf());
  const Pack<W> zero{};
  Pack<W> low = infinity, corner = infinity;
  for (int n = 0; n < plan.size; ++n) {
    // The fraction made as small as the margins allow.
    const Pack<W> top = curved.coefficients[n] - curved.margin;
    const Pack<W> small = straight.coefficients[n] - straight.margin;
    const Pack<W> large = straight.coefficients[n] + straight.margin;
    const Pack<W> ratio = top / where_not_negative(top, large, small);
    // zero - small >= 0: the straight determinant is not certainly positive here.
    low = lower(low, where_not_negative(zero - small, zero - infinity, ratio));
  }
  for (int n = 0; n < plan.corners; ++n) {
    const int at = plan.corner[n];
    const Pack<W> top = curved.coefficients[at] + curved.margin;
    const Pack<W> small = straight.coefficients[at] - straight.margin;
    const Pack<W> large = straight.coefficients[at] + straight.margin;
    const Pack<W> ratio = top / where_not_negative(top, small, large);
    corner = lower(corner, where_not_negative(zero - small, infinity, ratio));
  }
  store(low, out.ratio_lowest);
  store(corner, out.ratio_corner);
  store(straight.margin, out.straight_margin);
}

template <int W>
void kernel(const KernelPlan& plan, const StraightView* straight_view, const double* nodes,
            double* work, const KernelOutput& out) {
  Scratch<W> scratch{work};
  const Pack<W>* x = reinterpret_cast<const Pack<W>*>(nodes);
  Determinant<W> curved, straight;
  if (straight_view == nullptr) {
    curved = volume_determinant(plan, x, scratch);
  } else {
    const KernelPlan& straight_plan = *straight_view->plan;
    Pack<W>* straight_x = scratch.take(3 * straight_plan.nodes);
    for (int d = 0; d < 3; ++d) {
      for (int n = 0; n < straight_plan.nodes; ++n) {
        straight_x[d * straight_plan.nodes + n] = x[d * plan.nodes + straight_view->corner_node[n]];
      }
    }
    if (plan.columns == 3) {
      curved = volume_determinant(plan, x, scratch);
      straight = volume_determinant(straight_plan, straight_x, scratch);
    } else {
      face_determinants(plan, straight_plan, x, straight_x, scratch, curved, straight);
    }
    Pack<W>* first = scratch.take(straight_view->work);
    Pack<W>* second = scratch.take(straight_view->work);
    for (int n = 0; n < straight_plan.size; ++n) first[n] = straight.coefficients[n];
    straight.coefficients =
        apply_all(straight_view->passes, straight_view->pass_count, first, second);
    straight.margin =
        2.0 * straight.margin;  // the elevation rounds, by less than the margin itself
  }
  summarise(plan, curved, out);
  Pack<W>* coefficients = reinterpret_cast<Pack<W>*>(out.coefficients);
  for (int n = 0; n < plan.size; ++n) coefficients[n] = curved.coefficients[n];
  if (straight_view != nullptr) {
    summarise_ratio(plan, curved, straight, out);
    Pack<W>* elevated = reinterpret_cast<Pack<W>*>(out.straight_coefficients);
    for (int n = 0; n < plan.size; ++n) elevated[n] = straight.coefficients[n];
  }
}

}  // namespace
}  // namespace camber::detail
