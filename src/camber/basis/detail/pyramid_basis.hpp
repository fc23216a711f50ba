#pragma once
// The nodal basis of the pyramid, on the collapsed cube x = a (1-z), y = b (1-z).
#include <camber/base/vec.hpp>

#include <span>

namespace camber::detail {

/// N_n(xi), canonical order. A mode is, with s = 1-z, m = max(i,j) and k <= p - m,
///   psi_ijk = c_ijk P_i(2a-1) P_j(2b-1) s^m P_k^(2m+2,0)(2z-1),
/// P_i Legendre and P_k^(.,.) Jacobi polynomials, orthonormal on the pyramid: a polynomial in
/// (a, b, z), so finite up to the apex, where a = b = 1/2 is taken. N = V^-T psi with V the modes
/// at the nodes, inverted once an order in long double. Source: Bergot, Cohen, Durufle 2010,
/// doi 10.1007/s10915-009-9334-9. Any thread.
void pyramid_values(int p, const Vec3& xi, std::span<double> N);
void pyramid_gradients(int p, const Vec3& xi, std::span<Vec3> dN);

}  // namespace camber::detail
