#pragma once
// The arrays of a HOPR mesh file, as they stand in it.
#include <camber/io/detail/named_mesh.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace camber::io::hopr {

inline constexpr std::size_t k_elem_columns = 6, k_side_columns = 5, k_type_columns = 4,
                             k_name_length = 255, k_counted_types = 11;

/// Rows are elements, sides, nodes and boundary conditions; numbers start at 1 as in Fortran.
struct Arrays {
  int order = 0;  // Ngeo
  std::int32_t unique_sides = 0, unique_nodes = 0;
  std::vector<std::int32_t> elem_info;     // type, zone, sides before and with it, nodes likewise
  std::vector<std::int32_t> side_info;     // type, global number (< 0: the second to see it),
                                           // neighbour, 10 its side + flip, boundary condition
  std::vector<double> node_coords;         // x y z, element after element, lattice order
  std::vector<std::int32_t> node_ids;      // the same number for the same node of the mesh
  std::vector<double> barycenters;         // of the corners
  std::vector<std::int32_t> elem_counter;  // type, how many
  std::vector<std::string> bc_names;
  std::vector<std::int32_t> bc_types;  // kind, curve, state, periodic

  [[nodiscard]] std::size_t elements() const { return elem_info.size() / k_elem_columns; }
  [[nodiscard]] std::size_t sides() const { return side_info.size() / k_side_columns; }
  [[nodiscard]] std::size_t nodes() const { return node_ids.size(); }
};

/// Elements stand in the order of a space-filling curve (hilbert_order.hpp) through the means of
/// their corners. Sides are those of CGNS with outward normals, as in shape.hpp; nodes are in
/// lattice order, i fastest, also for order 1; flip n: the n-th corner of the neighbour's side is
/// the first of mine.
/// Source: HOPR user guide, "HOPR HDF5 Curved Mesh Format".
/// The kind of a boundary condition is 0, to be set for the solver, or 100 where a patch lies
/// inside of the mesh. Boundary faces without a patch get the condition "boundary".
/// @throws FileError if orders differ, a face has more than two cells, a surface element is no face
///         of a cell, neighbours do not walk a common face against each other, or the numbers need
///         more than 32 bits
[[nodiscard]] Arrays make_arrays(const NamedMesh& named, const std::string& display);

}  // namespace camber::io::hopr
