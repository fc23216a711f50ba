#pragma once
// Which order each cell gets: deviation of the wall, deviation inside the volume, order jump.
#include <camber/elevate/layer_field.hpp>

#include <cstdint>
#include <vector>

namespace camber {

enum class DeviationLength {
  face,  // shortest surface edge of the wall face
  cell,  // shortest edge of the cell on it (the paper, 2.2.1)
  given  // OrderOptions::length
};

struct OrderOptions {
  int max_order = 4;
  int min_order = 1;
  double deviation = 0.01;  // threshold as a share of the length (paper: 0.01 to 0.05)
  DeviationLength deviation_length = DeviationLength::face;
  double length = 0.0;
  /// A neighbour of lower order may miss the field that a cell carries by this share of the
  /// shortest edge of any cell on what they share.
  double volume_deviation = 0.05;
  /// The same for cells that stand on the wall: keeps the first-cell height within 1 %.
  double wall_cell_deviation = 0.01;
};

/// Orders asked by single entities, before any rule joins them.
struct OrderRequests {
  std::vector<std::uint8_t> edge, face;       // by topology entity; 1 = nothing asked
  std::size_t by_surface = 0, by_volume = 0;  // entities that ask more than 1
};

/// Shortest linear edge of every cell.
[[nodiscard]] std::vector<double> shortest_edges(const LinearMesh& mesh, const Topology& topology);

/// Length that the deviation of a wall face is measured against.
[[nodiscard]] double deviation_length(const LinearMesh& mesh, const Topology& topology, Index face,
                                      const std::vector<double>& shortest_edge,
                                      const OrderOptions& options);

/// Surface test (paper 2.2.1): for each wall face the lowest order q whose deviation at the Gauss
/// points is at most deviation * length (else max_order), and the same for wall edges on their CAD
/// curve; a face asks for its edges too. Volume test (paper 2.2.3, on edges and faces): where a
/// cell of order p meets one of lower order q, both carry I_q u on what they share. It must not
/// differ from I_p u, which the higher one would have, by more than volume_deviation * (shortest
/// edge of the cells that touch it); else the lower cell is raised to the lowest order that does,
/// and so on outwards. Nothing is asked where no wall is.
[[nodiscard]] OrderRequests request_orders(const LinearMesh& mesh, const Topology& topology,
                                           const Wall& wall, const Placement& placement,
                                           const LayerField& field, const OrderOptions& options);

/// A cell takes the largest order asked by any edge or face it contains; then face neighbours may
/// differ by at most one (the lower is raised) until nothing changes; entities follow by the
/// minimum rule.
[[nodiscard]] OrderField settle_orders(const LinearMesh& mesh, const Topology& topology,
                                       const OrderRequests& requests, const OrderOptions& options);

/// Largest difference of order between face neighbours.
[[nodiscard]] int largest_order_jump(const Topology& topology, const OrderField& orders);

}  // namespace camber
