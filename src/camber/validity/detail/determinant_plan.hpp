#pragma once
// The tables behind the certificate of one (shape, order): how node differences become Bernstein
// nets of the columns of dx/dxi, how these multiply, and how the straight copy is raised to the
// same degree.
#include <camber/basis/shape.hpp>
#include <camber/validity/detail/coefficient_space.hpp>
#include <camber/validity/detail/kernel_plan.hpp>
#include <camber/validity/detail/subdivision.hpp>

#include <deque>
#include <vector>

namespace camber::detail {

/// Highest order whose conversion tables keep full precision; beyond, certify throws.
inline constexpr int k_max_certified_order = 8;

/// A linear map of one factor of a tensor: applied to every line of values along it.
struct FactorPass {
  MatX matrix;
  int inner = 1, outer = 1;
};

/// One column of the Jacobian before it is packed for the kernels.
struct ColumnTable {
  CoefficientSpace space;
  std::vector<std::int32_t> from, to;
  std::vector<FactorPass> passes;  // the last rows give plain coefficients
};

/// Columns of dx/dxi for tet, prism, hexahedron (3), triangle and quadrilateral (2).
[[nodiscard]] std::vector<ColumnTable> tensor_columns(Shape shape, int p);
/// Columns for the pyramid, pulled back to the cube: see pyramid_columns.cpp.
[[nodiscard]] std::vector<ColumnTable> pyramid_columns(int p);

class DeterminantPlan {
 public:
  DeterminantPlan(Shape shape, int p);
  DeterminantPlan(const DeterminantPlan&) = delete;
  DeterminantPlan& operator=(const DeterminantPlan&) = delete;

  [[nodiscard]] const KernelPlan& kernel() const { return kernel_; }
  [[nodiscard]] const StraightView& straight() const { return straight_; }
  [[nodiscard]] const CoefficientSpace& space() const { return space_; }
  [[nodiscard]] const SubdivisionTable& subdivision() const { return subdivision_; }
  /// Doubles of scratch a lane, for any call of a kernel.
  [[nodiscard]] int work() const { return work_; }

  /// The plan of (shape, p); built once, any thread. Throws std::invalid_argument for a shape
  /// without determinant (point, line) and for p outside 1..k_max_certified_order.
  [[nodiscard]] static const DeterminantPlan& of(Shape shape, int p);

 private:
  const double* keep(std::vector<double> values);
  const std::int32_t* keep(std::vector<std::int32_t> values);
  const PassView* keep(const std::vector<FactorPass>& passes);
  ProductView product(const CoefficientSpace& a, const CoefficientSpace& b);
  ColumnView pack(const ColumnTable& table);
  void link_straight(Shape shape, int p);

  CoefficientSpace space_;
  SubdivisionTable subdivision_;
  KernelPlan kernel_;
  StraightView straight_;
  int work_ = 0;
  // Owners of what the views point to; deques never move their elements.
  std::deque<std::vector<double>> doubles_;
  std::deque<std::vector<std::int32_t>> integers_;
  std::deque<std::vector<PassView>> passes_;
  std::deque<std::vector<CoefficientRow>> rows_;
};

}  // namespace camber::detail
