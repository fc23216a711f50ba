#pragma once
#include <cstddef>
#include <span>

namespace camber {

/// Numerator and denominator of eq. (1) for one face; add them up over faces to average over a
/// group.
struct ShapeConformity {
  double integral = 0.0;  // of the distance over the face [length^3]
  double area = 0.0;      // [length^2]
  double maximum = 0.0;   // largest distance at a point [length]

  void add(const ShapeConformity& other) {
    integral += other.integral;
    area += other.area;
    maximum = other.maximum > maximum ? other.maximum : maximum;
  }
  /// SC = integral / area [length]; 0 without area.
  [[nodiscard]] double average() const { return area > 0.0 ? integral / area : 0.0; }
};

/// Shape conformity of one boundary face:  SC = int |dr| ds / int ds.
/// Source: [karman2022] eq. (1), at the sixth-order Gauss points (Fig. 4).
/// @param distances     |x - proj x| at the Gauss points [length]
/// @param area_weights  Gauss weight times |dx/dxi x dx/deta| there [length^2]; as many
[[nodiscard]] inline ShapeConformity shape_conformity(std::span<const double> distances,
                                                      std::span<const double> area_weights) {
  ShapeConformity sum;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    sum.add({distances[i] * area_weights[i], area_weights[i], distances[i]});
  }
  return sum;
}

}  // namespace camber
