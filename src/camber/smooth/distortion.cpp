#include <camber/smooth/distortion.hpp>

#include <cmath>
#include <limits>

namespace camber {
namespace {

Mat3 cofactor(const Mat3& T) {
  Mat3 C;
  C.col(0) = T.col(1).cross(T.col(2));
  C.col(1) = T.col(2).cross(T.col(0));
  C.col(2) = T.col(0).cross(T.col(1));
  return C;
}

}  // namespace

double regularised_determinant(double tau, double delta) {
  const double root = std::sqrt(tau * tau + 4.0 * delta * delta);
  // The same number without the cancellation of root and tau.
  return tau < 0.0 ? 2.0 * delta * delta / (root - tau) : 0.5 * (tau + root);
}

Distortion distortion(const Mat3& T, double delta) {
  Distortion result;
  const Mat3 cof = cofactor(T);
  const double tau = T.col(0).dot(cof.col(0));
  const double h = regularised_determinant(tau, delta);
  if (!(h > 0.0)) {
    result.energy = std::numeric_limits<double>::infinity();
    return result;
  }
  const double a = T.squaredNorm(), b = cof.squaredNorm();
  const double size = 0.5 * (1.0 / h + 1.0 / (h * h * h));
  const double size_slope = -0.5 / (h * h) - 1.5 / (h * h * h * h);
  const double h_slope = h / std::sqrt(tau * tau + 4.0 * delta * delta);
  result.energy = a * b * size / 9.0;
  // d|cof T|^2/dT = 2 (|T|^2 T - T T^t T);  d det T/dT = cof T.
  const Mat3 b_slope = 2.0 * (a * T - T * (T.transpose() * T));
  result.gradient =
      (2.0 * b * size * T + a * size * b_slope + a * b * size_slope * h_slope * cof) / 9.0;
  return result;
}

}  // namespace camber
