#include <camber/elevate/order_rules.hpp>

#include <algorithm>
#include <array>
#include <limits>

#include <camber/base/parallel.hpp>
#include <camber/basis/lagrange.hpp>

namespace camber {
namespace {

std::size_t sz(int i) { return static_cast<std::size_t>(i); }

constexpr std::size_t k_grain = 1024;

/// max |E a - b| over rows: distance between the elevated low-order shape and the reference.
double largest_difference(const MatX& elevate, std::span<const Vec3> low, std::span<const Vec3> high) {
  double largest = 0.0;
  for (std::size_t r = 0; r < high.size(); ++r) {
    Vec3 sum = -high[r];
    for (std::size_t c = 0; c < low.size(); ++c) {
      sum += elevate(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) * low[c];
    }
    largest = std::max(largest, sum.squaredNorm());
  }
  return std::sqrt(largest);
}

/// Full displacement lattice of a face at order q, from the field on its edges and inside.
void face_lattice(const Topology& topology, const LayerField& field, Index f, int q, std::span<Vec3> u) {
  const Shape shape = topology.face_shape[at(f)];
  const LatticeMap& map = lattice_map(shape, q);
  std::fill(u.begin(), u.end(), Vec3::Zero());
  std::array<Vec3, 36> own;
  for (int i = 0; i < topology.corners_of_face(f); ++i) {
    const Index e = topology.face2edge[at(f)][sz(i)];
    const std::span<Vec3> line(own.data(), sz(q - 1));
    field.edge(e, q, line);
    const bool reversed = topology.edge2vertex[at(e)][0] != topology.face2vertex[at(f)][sz(i)];
    const std::vector<int>& slots = map.edge_interior[sz(i)];
    for (std::size_t k = 0; k < slots.size(); ++k) {
      u[sz(slots[k])] = line[reversed ? line.size() - 1 - k : k];
    }
  }
  const std::span<const int> inner = interior_nodes(shape, q);
  field.face(f, q, std::span(own.data(), inner.size()));
  for (std::size_t k = 0; k < inner.size(); ++k) u[sz(inner[k])] = own[k];
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
    while (q < options.max_order &&
           placement.face_deviation(static_cast<Index>(s), q).maximum > options.deviation * length) {
      ++q;
    }
    raise(requests.face[at(f)], q);
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      const Index e = topology.face2edge[at(f)][sz(i)];
      raise(requests.edge[at(e)], q);
      double& shortest = edge_length[at(wall.edge_slot[at(e)])];
      shortest = std::min(shortest, length);
    }
  }
  for (std::size_t s = 0; s < wall.edge_count(); ++s) {
    int q = 1;
    while (q < options.max_order &&
           placement.edge_deviation(static_cast<Index>(s), q) > options.deviation * edge_length[s]) {
      ++q;
    }
    raise(requests.edge[at(wall.edges[s])], q);
  }
}

void request_in_volume(const Topology& topology, const LayerField& field,
                       const std::vector<double>& shortest_edge, const OrderOptions& options,
                       OrderRequests& requests) {
  const int top = options.max_order;
  parallel_for(topology.edge_count(), k_grain, [&](std::size_t begin, std::size_t end) {
    std::array<Vec3, 8> high, low;
    for (std::size_t e = begin; e < end; ++e) {
      double allowed = std::numeric_limits<double>::infinity();
      for (Index c : topology.cells_of_edge(static_cast<Index>(e))) {
        allowed = std::min(allowed, options.volume_deviation * shortest_edge[at(c)]);
      }
      const std::span<Vec3> reference(high.data(), sz(top + 1));
      reference.front() = reference.back() = Vec3::Zero();
      field.edge(static_cast<Index>(e), top, reference.subspan(1, sz(top - 1)));
      int q = 1;
      for (; q < top; ++q) {
        const std::span<Vec3> shape(low.data(), sz(q + 1));
        shape.front() = shape.back() = Vec3::Zero();
        if (q > 1) field.edge(static_cast<Index>(e), q, shape.subspan(1, sz(q - 1)));
        if (largest_difference(elevation_matrix(Shape::line, q, top), shape, reference) <= allowed) break;
      }
      requests.edge[e] = std::max(requests.edge[e], static_cast<std::uint8_t>(q));
    }
  });
  parallel_for(topology.face_count(), k_grain, [&](std::size_t begin, std::size_t end) {
    std::array<Vec3, 49> high, low;
    for (std::size_t f = begin; f < end; ++f) {
      const Shape shape = topology.face_shape[f];
      double allowed = std::numeric_limits<double>::infinity();
      for (Index c : topology.face2cell[f]) {
        if (c != k_none) allowed = std::min(allowed, options.volume_deviation * shortest_edge[at(c)]);
      }
      const std::span<Vec3> reference(high.data(), sz(node_count(shape, top)));
      face_lattice(topology, field, static_cast<Index>(f), top, reference);
      int q = 1;
      for (; q < top; ++q) {
        const std::span<Vec3> lower(low.data(), sz(node_count(shape, q)));
        if (q == 1) {
          std::fill(lower.begin(), lower.end(), Vec3::Zero());
        } else {
          face_lattice(topology, field, static_cast<Index>(f), q, lower);
        }
        if (largest_difference(elevation_matrix(shape, q, top), lower, reference) <= allowed) break;
      }
      requests.face[f] = std::max(requests.face[f], static_cast<std::uint8_t>(q));
    }
  });
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
    case DeviationLength::given: return options.length;
    case DeviationLength::cell:
      for (Index c : topology.face2cell[at(face)]) {
        if (c != k_none) length = std::min(length, shortest_edge[at(c)]);
      }
      return length;
    case DeviationLength::face:
      for (int i = 0; i < topology.corners_of_face(face); ++i) {
        const std::array<Index, 2>& v = topology.edge2vertex[at(topology.face2edge[at(face)][sz(i)])];
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
  if (options.max_order > 1) request_in_volume(topology, field, shortest_edge, options, requests);
  requests.by_volume = asking() - requests.by_surface;
  return requests;
}

OrderField settle_orders(const LinearMesh& mesh, const Topology& topology, const OrderRequests& requests,
                         const OrderOptions& options) {
  std::vector<std::uint8_t> orders(mesh.cell_count(), static_cast<std::uint8_t>(options.min_order));
  for (Index c = 0; at(c) < mesh.cell_count(); ++c) {
    for (Index e : topology.edges_of_cell(c)) orders[at(c)] = std::max(orders[at(c)], requests.edge[at(e)]);
    for (Index f : topology.faces_of_cell(c)) orders[at(c)] = std::max(orders[at(c)], requests.face[at(f)]);
  }
  // From the highest order down: a raise never touches a level that is already settled.
  for (int q = options.max_order; q > 2; --q) {
    for (std::size_t f = 0; f < topology.face_count(); ++f) {
      const auto [a, b] = topology.face2cell[f];
      if (b == k_none) continue;
      const std::uint8_t least = static_cast<std::uint8_t>(q - 1);
      if (orders[at(a)] == q) orders[at(b)] = std::max(orders[at(b)], least);
      if (orders[at(b)] == q) orders[at(a)] = std::max(orders[at(a)], least);
    }
  }
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
