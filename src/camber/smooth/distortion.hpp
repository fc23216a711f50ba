#pragma once
// The energy that untangles: squared weighted condition number times a two-sided size term.
#include <camber/base/vec.hpp>

namespace camber {

/// h(tau) = (tau + sqrt(tau^2 + 4 delta^2)) / 2: tau itself for delta = 0, positive for every tau
/// otherwise. Source: Escobar et al. 2003, Comput. Methods Appl. Mech. Engrg. 192,
/// p. 2775.
[[nodiscard]] double regularised_determinant(double tau, double delta);

struct Distortion {
  double energy = 0.0;           // >= 1; 1 iff T is a rotation; +inf where h <= 0
  Mat3 gradient = Mat3::Zero();  // dE/dT
};

/// E(T) = |T|^2 |cof T|^2 / (9 h^2) * (h + 1/h) / 2, T = A W^-1, h = h(det T). |.| is Frobenius.
/// The first factor is WCN^2 of [karman2022] eq. (6) with det T replaced by h; the second penalises
/// change of size both ways. Infinite at inversion for delta = 0; smooth everywhere for delta > 0.
[[nodiscard]] Distortion distortion(const Mat3& T, double delta);

}  // namespace camber
