#pragma once
// Halving the domain of a polynomial in Bernstein form: along an edge of one factor of the product.
#include <camber/basis/shape.hpp>
#include <camber/validity/detail/coefficient_space.hpp>

#include <array>
#include <span>
#include <vector>

namespace camber::detail {

/// A part of the reference domain: the corners of its factors, as places that add up. A point is
/// the sum over the factors of a convex combination of that factor's corners.
struct Region {
  std::array<std::array<Vec3, 4>, 3> vertex;
};

/// One way to halve: the edge (first, second) of a factor is cut at its midpoint.
struct SplitDirection {
  int factor = 0, first = 0, second = 1;
  std::vector<std::int32_t> index;      // coefficients of all rows along the edge, row after row
  std::vector<std::int32_t> row_begin;  // into index; one more than rows
};

class SubdivisionTable {
 public:
  SubdivisionTable() = default;
  SubdivisionTable(Shape shape, const CoefficientSpace& space);

  [[nodiscard]] std::span<const SplitDirection> directions() const { return directions_; }
  [[nodiscard]] std::span<const CornerCoefficient> corners() const { return corners_; }
  [[nodiscard]] int size() const { return size_; }
  /// Longest chain of halvings that one split puts a coefficient through.
  [[nodiscard]] int degree() const { return degree_; }

  /// Direction in which the control net bends most (largest second difference along its rows); the
  /// first of equals; -1 if it bends nowhere: then the corners are the extreme values already.
  [[nodiscard]] int most_bent(const double* coefficients) const;
  /// De Casteljau at one half: `coefficients` becomes the half with `first` replaced by the
  /// midpoint, `other` the half that keeps `first`.
  void split(int direction, double* coefficients, double* other) const;

  /// The whole reference domain, and a half of a region (`keeps_first`: `second` moves to the
  /// midpoint).
  [[nodiscard]] Region whole() const;
  void halve(Region& region, int direction, bool keeps_first) const;
  /// Reference coordinates of a corner of a region (for a pyramid these are of the pyramid, not the
  /// cube).
  [[nodiscard]] Vec3 place(const Region& region, const CornerCoefficient& corner) const;

 private:
  Shape shape_ = Shape::point;
  int size_ = 0, degree_ = 0;
  std::vector<Factor> factors_;
  std::vector<SplitDirection> directions_;
  std::vector<CornerCoefficient> corners_;
};

}  // namespace camber::detail
