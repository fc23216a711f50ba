#pragma once
// Costs and sensitivities of all sub-simplices of one element.
#include <camber/basis/lattice.hpp>
#include <camber/smooth/marching/sub_cost.hpp>

#include <array>
#include <span>
#include <vector>

namespace camber {

/// Cost of a sub-simplex and its derivatives by the places of its corners: 13 numbers for a
/// tetrahedron. [karman2022] "Marching Direction".
template <int d>
struct SubCost {
  double cost = 1.0;                                        // [-]
  std::array<Vec3, static_cast<std::size_t>(d) + 1> slope;  // dC/dx of each corner [1/length]
};

/// Highest level of subdivision: Figs 8c, 11c.
inline constexpr int k_max_level = 2;

/// Costs of all sub-simplices of an element, in the order of sub_simplices(), by dual numbers.
/// The normalised Jacobian is taken
///   level 0: from the area or volume of the sub-simplex;
///   level L: at the lattice of order 2^L of the sub-simplex, from the polynomial through all nodes
///   of the element, averaged by eq. (5); its derivatives are those by the sub-simplex's corners,
///   the element's other nodes held fixed.
/// @param x  the element's nodes of order p, canonical order [length]
/// @param X  the same on the computational mesh (straight copy)
/// Reentrant.
template <int d>
void element_costs(Shape shape, int p, std::span<const Vec3> x, std::span<const Vec3> X, int level,
                   std::vector<SubCost<d>>& costs);

/// Inscribed radius of every sub-simplex on the computational mesh [length] (Fig. 12).
template <int d>
void inscribed_radii(Shape shape, int p, std::span<const Vec3> X, std::vector<double>& radii);

}  // namespace camber
