#include <camber/base/parallel.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/elevate/order_rules.hpp>
#include <camber/mesh/raise_orders.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>

namespace camber {
namespace {

constexpr std::size_t k_grain = 1024;

/// An entity that moves by less than this share of what may be missed can stay straight.
constexpr double k_still = 0.1;

bool is_still(std::span<const Vec3> u, double allowed) {
  return std::all_of(u.begin(), u.end(),
                     [&](const Vec3& d) { return d.norm() <= k_still * allowed; });
}

/// By order p: the lowest order that may stand in for p.
using StandIn = std::array<std::uint8_t, static_cast<std::size_t>(k_max_order) + 1>;

/// Displacement polynomials of one entity at orders 1..top, all as points on the lattice of order
/// top.
class Shapes {
 public:
  Shapes(Shape shape, int top) : shape_(shape), top_(top), n_(at(node_count(shape, top))) {
    points_.assign(n_ * at(top), Vec3::Zero());
  }
  /// u: displacements on the lattice of order q. Order 1 is zero: vertices do not move.
  void set(int q, std::span<const Vec3> u) {
    const MatX& elevate = elevation_matrix(shape_, q, top_);
    for (std::size_t r = 0; r < n_; ++r) {
      Vec3 sum = Vec3::Zero();
      for (std::size_t c = 0; c < u.size(); ++c) {
        sum += elevate(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) * u[c];
      }
      points_[at(q - 1) * n_ + r] = sum;
    }
  }
  /// For every order p the lowest q whose points are within `allowed` of those of p.
  [[nodiscard]] StandIn stand_in(double allowed) const {
    StandIn lowest{};
    for (int p = 1; p <= top_; ++p) {
      int q = 1;
      while (q < p && distance(q, p) > allowed) ++q;
      lowest[at(p)] = static_cast<std::uint8_t>(q);
    }
    return lowest;
  }

 private:
  [[nodiscard]] double distance(int a, int b) const {
    double largest = 0.0;
    for (std::size_t i = 0; i < n_; ++i) {
      largest =
          std::max(largest, (points_[at(a - 1) * n_ + i] - points_[at(b - 1) * n_ + i]).norm());
    }
    return largest;
  }

  Shape shape_;
  int top_;
  std::size_t n_;
  Points points_;
};

/// Displacements of the insides of edges at the orders 2..top, each asked of the field once: about
/// five faces share an edge. Edges that do not move, mostly far ones, take no room.
class EdgeMoves {
 public:
  EdgeMoves(std::size_t edge_count, int top)
      : top_(top),
        place_(edge_count, k_none),
        lowest_(edge_count, static_cast<std::uint8_t>(top)),
        chunks_((edge_count + k_grain - 1) / k_grain),
        zero_(at(top), Vec3::Zero()) {}

  /// Keeps what is known of an edge: the orders lowest..top in a list that starts with the highest.
  /// Edges of one chunk of k_grain by one thread, in order.
  void keep(Index e, int lowest, std::span<const Vec3> moves) {
    lowest_[at(e)] = static_cast<std::uint8_t>(lowest);
    if (std::all_of(moves.begin(), moves.end(), [](const Vec3& u) { return u.isZero(0.0); })) {
      return;
    }
    Points& chunk = chunks_[at(e) / k_grain];
    place_[at(e)] = static_cast<Index>(chunk.size());
    chunk.insert(chunk.end(), moves.begin(), moves.end());
  }
  /// What was kept, or what the field says where the edge was found still before.
  [[nodiscard]] std::span<const Vec3> at_order(const LayerField& field, Index e, int q,
                                               std::span<Vec3> room) const {
    if (q < lowest_[at(e)]) {
      field.edge(e, q, room.first(at(q - 1)));
      return room.first(at(q - 1));
    }
    if (place_[at(e)] == k_none) return {zero_.data(), at(q - 1)};
    return {chunks_[at(e) / k_grain].data() + place_[at(e)] + first(q), at(q - 1)};
  }
  /// Place of order q in the list of an edge.
  [[nodiscard]] std::ptrdiff_t first(int q) const { return (top_ * (top_ - 1) - q * (q - 1)) / 2; }

 private:
  int top_;
  std::vector<Index> place_;  // in its chunk, -1: all zero
  std::vector<std::uint8_t> lowest_;
  std::vector<Points> chunks_;
  Points zero_;
};

/// Full displacement lattice of a face at order q, from the field on its edges and inside.
void face_lattice(const Topology& topology, const LayerField& field, const EdgeMoves& edges,
                  Index f, int q, std::span<Vec3> u) {
  const Shape shape = topology.face_shape[at(f)];
  const LatticeMap& map = lattice_map(shape, q);
  std::fill(u.begin(), u.end(), Vec3::Zero());
  std::array<Vec3, 36> own;
  for (int i = 0; i < topology.corners_of_face(f); ++i) {
    const Index e = topology.face2edge[at(f)][at(i)];
    const std::span<const Vec3> line = edges.at_order(field, e, q, own);
    const bool reversed = topology.edge2vertex[at(e)][0] != topology.face2vertex[at(f)][at(i)];
    const std::vector<int>& slots = map.edge_interior[at(i)];
    for (std::size_t k = 0; k < slots.size(); ++k) {
      u[at(slots[k])] = line[reversed ? line.size() - 1 - k : k];
    }
  }
  const std::span<const int> inner = interior_nodes(shape, q);
  field.face(f, q, std::span(own.data(), inner.size()));
  for (std::size_t k = 0; k < inner.size(); ++k) u[at(inner[k])] = own[k];
}

void request_on_surface(const LinearMesh& mesh, const Topology& topology, const Wall& wall,
                        const Placement& placement, const std::vector<double>& shortest_edge,
                        const OrderOptions& options, OrderRequests& requests) {
  std::vector<double> edge_length(wall.edge_count(), std::numeric_limits<double>::infinity());
  const auto raise = [](std::uint8_t& value, int q) {
    value = std::max(value, static_cast<std::uint8_t>(q));
  };
  for (std::size_t s = 0; s < wall.face_count(); ++s) {
    const Index f = wall.faces[s];
    const double length = deviation_length(mesh, topology, f, shortest_edge, options);
    int q = 1;
    while (q < options.max_order && placement.face_deviation(static_cast<Index>(s), q).maximum >
                                        options.deviation * length) {
      ++q;
    }
    raise(requests.face[at(f)], q);
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      const Index e = topology.face2edge[at(f)][at(i)];
      raise(requests.edge[at(e)], q);
      double& shortest = edge_length[at(wall.edge_slot[at(e)])];
      shortest = std::min(shortest, length);
    }
  }
  for (std::size_t s = 0; s < wall.edge_count(); ++s) {
    int q = 1;
    while (q < options.max_order && placement.edge_deviation(static_cast<Index>(s), q) >
                                        options.deviation * edge_length[s]) {
      ++q;
    }
    raise(requests.edge[at(wall.edges[s])], q);
  }
}

struct StandIns {
  std::vector<StandIn> edge, face;
};

/// How far a lower order may stand off inside each cell [length]. Less in the first cells on the
/// wall: their height is what the user spaced.
std::vector<double> drop_tolerances(const Topology& topology, const Wall& wall,
                                    const std::vector<double>& shortest_edge,
                                    const OrderOptions& options) {
  std::vector<double> tolerance(shortest_edge.size());
  for (std::size_t c = 0; c < tolerance.size(); ++c)
    tolerance[c] = options.volume_deviation * shortest_edge[c];
  for (Index f : wall.faces) {
    for (Index c : topology.face2cell[at(f)]) {
      if (c == k_none) continue;
      tolerance[at(c)] =
          std::min(tolerance[at(c)], options.wall_cell_deviation * shortest_edge[at(c)]);
    }
  }
  return tolerance;
}

StandIns find_stand_ins(const Topology& topology, const LayerField& field,
                        const std::vector<double>& tolerance, const OrderOptions& options) {
  const int top = options.max_order;
  const auto allowed = [&](std::span<const Index> cells) {
    double least = std::numeric_limits<double>::infinity();
    for (Index c : cells) {
      if (c != k_none) least = std::min(least, tolerance[at(c)]);
    }
    return least;
  };
  StandIns result{std::vector<StandIn>(topology.edge_count()),
                  std::vector<StandIn>(topology.face_count())};
  EdgeMoves moves(topology.edge_count(), top);
  parallel_for(topology.edge_count(), k_grain, [&](std::size_t begin, std::size_t end) {
    Shapes shapes(Shape::line, top);
    std::array<Vec3, 8> u;
    std::array<Vec3, 36> all;
    for (std::size_t i = begin; i < end; ++i) {
      const Index e = static_cast<Index>(i);
      const double most = allowed(topology.cells_of_edge(e));
      result.edge[i].fill(1);
      int lowest = top;
      for (int q = top; q >= 2; --q) {
        const std::span<Vec3> line(u.data(), at(q + 1));
        line.front() = line.back() = Vec3::Zero();
        const std::span<Vec3> inside(all.data() + moves.first(q), at(q - 1));
        field.edge(e, q, inside);
        lowest = q;
        std::copy(inside.begin(), inside.end(), line.begin() + 1);
        if (q == top && is_still(line, most)) break;
        shapes.set(q, line);
        if (q == 2) result.edge[i] = shapes.stand_in(most);
      }
      moves.keep(e, lowest, {all.data(), static_cast<std::size_t>(moves.first(lowest - 1))});
    }
  });
  parallel_for(topology.face_count(), k_grain, [&](std::size_t begin, std::size_t end) {
    Shapes triangle(Shape::triangle, top), quadrilateral(Shape::quadrilateral, top);
    std::array<Vec3, 49> u;
    for (std::size_t f = begin; f < end; ++f) {
      const Shape shape = topology.face_shape[f];
      Shapes& shapes = shape == Shape::triangle ? triangle : quadrilateral;
      const double most = allowed(topology.face2cell[f]);
      result.face[f].fill(1);
      for (int q = top; q >= 2; --q) {
        const std::span<Vec3> lattice(u.data(), at(node_count(shape, q)));
        face_lattice(topology, field, moves, static_cast<Index>(f), q, lattice);
        if (q == top && is_still(lattice, most)) break;
        shapes.set(q, lattice);
        if (q == 2) result.face[f] = shapes.stand_in(most);
      }
    }
  });
  return result;
}

/// Spreads orders from cell to cell, highest first: an entity of a cell of order p that no lower
/// order may stand in for asks p of all cells that touch it; face neighbours get p - 1 at least.
void request_in_volume(const Topology& topology, const StandIns& stand_ins,
                       const OrderOptions& options, OrderRequests& requests,
                       std::vector<std::uint8_t> cell_order) {
  std::vector<Index> work;
  const auto raise = [&](Index c, int q, int p) {
    if (c == k_none || cell_order[at(c)] >= q) return;
    cell_order[at(c)] = static_cast<std::uint8_t>(q);
    if (q == p) work.push_back(c);
  };
  for (int p = options.max_order; p > 1; --p) {
    for (std::size_t c = 0; c < cell_order.size(); ++c) {
      if (cell_order[c] == p) work.push_back(static_cast<Index>(c));
    }
    while (!work.empty()) {
      const Index c = work.back();
      work.pop_back();
      for (Index e : topology.edges_of_cell(c)) {
        const std::uint8_t q = stand_ins.edge[at(e)][at(p)];
        if (requests.edge[at(e)] >= q) continue;
        requests.edge[at(e)] = q;
        for (Index other : topology.cells_of_edge(e)) raise(other, q, p);
      }
      for (Index f : topology.faces_of_cell(c)) {
        const std::uint8_t q = std::max(stand_ins.face[at(f)][at(p)], requests.face[at(f)]);
        requests.face[at(f)] = q;
        for (Index other : topology.face2cell[at(f)]) raise(other, std::max<int>(q, p - 1), p);
      }
    }
  }
}

/// A cell takes the largest order asked by any edge or face it contains.
std::vector<std::uint8_t> cell_orders(const Topology& topology, const OrderRequests& requests,
                                      std::size_t cell_count, int least) {
  std::vector<std::uint8_t> orders(cell_count, static_cast<std::uint8_t>(least));
  for (Index c = 0; at(c) < cell_count; ++c) {
    for (Index e : topology.edges_of_cell(c))
      orders[at(c)] = std::max(orders[at(c)], requests.edge[at(e)]);
    for (Index f : topology.faces_of_cell(c))
      orders[at(c)] = std::max(orders[at(c)], requests.face[at(f)]);
  }
  return orders;
}

}  // namespace

std::vector<double> shortest_edges(const LinearMesh& mesh, const Topology& topology) {
  std::vector<double> shortest(mesh.cell_count(), 0.0);
  for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
    double length = std::numeric_limits<double>::infinity();
    for (Index e : topology.edges_of_cell(c)) {
      const std::array<Index, 2>& v = topology.edge2vertex[at(e)];
      length = std::min(length, (mesh.vertices[at(v[0])] - mesh.vertices[at(v[1])]).norm());
    }
    shortest[at(c)] = length;
  }
  return shortest;
}

double deviation_length(const LinearMesh& mesh, const Topology& topology, Index face,
                        const std::vector<double>& shortest_edge, const OrderOptions& options) {
  double length = std::numeric_limits<double>::infinity();
  switch (options.deviation_length) {
    case DeviationLength::given:
      return options.length;
    case DeviationLength::cell:
      for (Index c : topology.face2cell[at(face)]) {
        if (c != k_none) length = std::min(length, shortest_edge[at(c)]);
      }
      return length;
    case DeviationLength::face:
      for (int i = 0; i < topology.corners_of_face(face); ++i) {
        const std::array<Index, 2>& v =
            topology.edge2vertex[at(topology.face2edge[at(face)][at(i)])];
        length = std::min(length, (mesh.vertices[at(v[0])] - mesh.vertices[at(v[1])]).norm());
      }
      return length;
  }
  return length;
}

OrderRequests request_orders(const LinearMesh& mesh, const Topology& topology, const Wall& wall,
                             const Placement& placement, const LayerField& field,
                             const OrderOptions& options) {
  OrderRequests requests;
  requests.edge.assign(topology.edge_count(), 1);
  requests.face.assign(topology.face_count(), 1);
  const std::vector<double> shortest_edge = shortest_edges(mesh, topology);
  request_on_surface(mesh, topology, wall, placement, shortest_edge, options, requests);
  const auto asking = [&] {
    std::size_t n = 0;
    for (std::uint8_t q : requests.edge) n += q > 1;
    for (std::uint8_t q : requests.face) n += q > 1;
    return n;
  };
  requests.by_surface = asking();
  if (options.max_order > 1) {
    request_in_volume(
        topology,
        find_stand_ins(topology, field, drop_tolerances(topology, wall, shortest_edge, options),
                       options),
        options, requests, cell_orders(topology, requests, mesh.cell_count(), options.min_order));
  }
  requests.by_volume = asking() - requests.by_surface;
  return requests;
}

OrderField settle_orders(const LinearMesh& mesh, const Topology& topology,
                         const OrderRequests& requests, const OrderOptions& options) {
  std::vector<std::uint8_t> orders =
      cell_orders(topology, requests, mesh.cell_count(), options.min_order);
  limit_order_jumps(topology, orders);
  return minimum_rule(topology, std::move(orders));
}

int largest_order_jump(const Topology& topology, const OrderField& orders) {
  int largest = 0;
  for (const std::array<Index, 2>& cells : topology.face2cell) {
    if (cells[1] == k_none) continue;
    largest = std::max(largest, std::abs(static_cast<int>(orders.cell[at(cells[0])]) -
                                         static_cast<int>(orders.cell[at(cells[1])])));
  }
  return largest;
}

}  // namespace camber
