#include <camber/base/sorted_set.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/mesh/raise_orders.hpp>
#include <camber/smooth/marching/elevation.hpp>

#include <algorithm>
#include <array>
#include <limits>

namespace camber {
namespace {

/// Edges and faces between cells of different order, and the cells on either side.
struct Interfaces {
  std::vector<Index> edges, faces;
  std::vector<Index> lower, higher;
};

Interfaces find_interfaces(const CurvedMesh& curved, const FixedEntities& fixed, int max_order) {
  const Topology& topology = curved.topology();
  Interfaces found;
  const auto sort_cells = [&](std::span<const Index> cells, int r) {
    bool is_interface = false;
    for (Index c : cells) is_interface |= c != k_none && curved.cell_order(c) > r;
    if (!is_interface || r >= max_order) return false;
    for (Index c : cells) {
      if (c != k_none) (curved.cell_order(c) > r ? found.higher : found.lower).push_back(c);
    }
    return true;
  };
  for (Index e = 0; at(e) < topology.edge_count(); ++e) {
    if (!fixed.edge[at(e)] && sort_cells(topology.cells_of_edge(e), curved.edge_order(e))) {
      found.edges.push_back(e);
    }
  }
  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    if (!fixed.face[at(f)] && sort_cells(topology.face2cell[at(f)], curved.face_order(f))) {
      found.faces.push_back(f);
    }
  }
  make_sorted_set(found.lower);
  make_sorted_set(found.higher);
  return found;
}

/// Everything fixed but the interfaces.
FixedEntities all_but(const Topology& topology, const Interfaces& interfaces) {
  FixedEntities fixed{std::vector<std::uint8_t>(topology.edge_count(), 1),
                      std::vector<std::uint8_t>(topology.face_count(), 1)};
  for (Index e : interfaces.edges) fixed.edge[at(e)] = 0;
  for (Index f : interfaces.faces) fixed.face[at(f)] = 0;
  return fixed;
}

double shortest_edge(const CurvedMesh& curved, Index c) {
  double shortest = std::numeric_limits<double>::infinity();
  for (Index e : curved.topology().edges_of_cell(c)) {
    const std::array<Index, 2>& v = curved.topology().edge2vertex[at(e)];
    shortest = std::min(shortest, (curved.vertex(v[0]) - curved.vertex(v[1])).norm());
  }
  return shortest;
}

}  // namespace

double distance_to_lower_order(Shape shape, int q, std::span<const Vec3> nodes) {
  const MatX lower = elevation_matrix(shape, q - 1, q) * elevation_matrix(shape, q, q - 1);
  double farthest = 0.0;
  for (std::size_t n = 0; n < nodes.size(); ++n) {
    Vec3 difference = nodes[n];
    for (std::size_t m = 0; m < nodes.size(); ++m) {
      difference -= lower(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(m)) * nodes[m];
    }
    farthest = std::max(farthest, difference.norm());
  }
  return farthest;
}

std::vector<Index> cells_to_raise(const CurvedMesh& curved, const FixedEntities& fixed,
                                  const ElevationOptions& options) {
  const Topology& topology = curved.topology();
  const Interfaces interfaces = find_interfaces(curved, fixed, options.max_order);
  if (interfaces.lower.empty()) return {};
  std::vector<std::uint8_t> orders = curved.orders().cell;
  for (Index c : interfaces.lower) ++orders[at(c)];
  CurvedMesh released = raise_orders(curved, std::move(orders));
  MarchProblem problem = volume_problem(released, all_but(topology, interfaces), interfaces.higher);
  Marcher<3> marcher(problem, options.marching);
  for (int sweep = 0; sweep < options.sweeps && marcher.state().active_nodes > 0; ++sweep) {
    marcher.sweep();
  }
  store(problem, released);

  std::vector<Index> marked;
  const auto mark = [&](std::span<const Index> cells, int r, double distance) {
    for (Index c : cells) {
      if (c == k_none || curved.cell_order(c) != r) continue;
      if (distance > options.volume_deviation * shortest_edge(curved, c)) marked.push_back(c);
    }
  };
  Points nodes;
  for (Index e : interfaces.edges) {
    const int r = curved.edge_order(e), q = released.edge_order(e);
    if (q == r) continue;
    nodes.resize(static_cast<std::size_t>(q) + 1);
    released.edge_lattice(e, q, nodes);
    mark(topology.cells_of_edge(e), r, distance_to_lower_order(Shape::line, q, nodes));
  }
  for (Index f : interfaces.faces) {
    const Shape shape = topology.face_shape[at(f)];
    const int r = curved.face_order(f), q = released.face_order(f);
    if (q == r) continue;
    nodes.resize(static_cast<std::size_t>(node_count(shape, q)));
    released.face_lattice(f, q, nodes);
    mark(topology.face2cell[at(f)], r, distance_to_lower_order(shape, q, nodes));
  }
  make_sorted_set(marked);
  return marked;
}

std::vector<std::uint8_t> raised_orders(const CurvedMesh& curved, const std::vector<Index>& cells) {
  std::vector<std::uint8_t> orders = curved.orders().cell;
  for (Index c : cells) ++orders[at(c)];
  limit_order_jumps(curved.topology(), orders);
  return orders;
}

}  // namespace camber
