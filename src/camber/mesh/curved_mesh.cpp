#include <camber/base/assert.hpp>
#include <camber/base/error.hpp>
#include <camber/base/parallel.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/mesh/curved_mesh.hpp>

#include <algorithm>
#include <limits>
#include <utility>

namespace camber {
namespace {

constexpr std::size_t k_grain = 2048;
/// Nodes of the largest face, order 6.
constexpr std::size_t k_face_capacity = 49;

void apply(const MatX& matrix, std::span<const Vec3> in, std::span<Vec3> out) {
  for (std::size_t r = 0; r < out.size(); ++r) {
    Vec3 sum = Vec3::Zero();
    for (std::size_t c = 0; c < in.size(); ++c) {
      sum += matrix(static_cast<Eigen::Index>(r), static_cast<Eigen::Index>(c)) * in[c];
    }
    out[r] = sum;
  }
}

std::size_t own_count(Shape shape, int q) {
  return q < 2 ? 0 : lattice_map(shape, q).interior.size();
}

/// The nodes of straight_nodes() strictly inside, the same bits.
void straight_inside(Shape shape, int q, std::span<const Vec3> corners, std::span<Vec3> nodes) {
  const MatX& E = elevation_matrix(shape, 1, q);
  const std::vector<int>&corner = lattice_map(shape, 1).corner,
        &inner = lattice_map(shape, q).interior;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    nodes[i] = Vec3::Zero();
    for (std::size_t c = 0; c < corners.size(); ++c) {
      nodes[i] += E(inner[i], corner[c]) * corners[c];
    }
  }
}

[[noreturn]] void refuse_size() {
  throw MeshError("the curved mesh has more than 2147483647 nodes above order 1", "",
                  "choose a lower order or a smaller mesh");
}

}  // namespace

OrderField minimum_rule(const Topology& topology, std::vector<std::uint8_t> cell_orders) {
  OrderField orders;
  orders.cell = std::move(cell_orders);
  orders.face.assign(topology.face_count(), 1);
  orders.edge.assign(topology.edge_count(), 1);
  for (std::size_t f = 0; f < topology.face_count(); ++f) {
    const std::array<Index, 2>& cells = topology.face2cell[f];
    orders.face[f] = orders.cell[at(cells[0])];
    if (cells[1] != k_none) orders.face[f] = std::min(orders.face[f], orders.cell[at(cells[1])]);
  }
  for (Index e = 0; at(e) < topology.edge_count(); ++e) {
    std::uint8_t lowest = 255;
    for (Index c : topology.cells_of_edge(e)) lowest = std::min(lowest, orders.cell[at(c)]);
    orders.edge[at(e)] = lowest;
  }
  return orders;
}

CurvedMesh::CurvedMesh(const LinearMesh& mesh, const Topology& topology, OrderField orders,
                       NodeStart start)
    : mesh_(&mesh), topology_(&topology), orders_(std::move(orders)) {
  allocate();
  if (start == NodeStart::straight) straighten();
}

void CurvedMesh::allocate() {
  std::size_t next = 0;
  const auto add = [&](std::vector<Index>& offset, std::size_t count, auto nodes_of) {
    offset.resize(count + 1);
    for (std::size_t i = 0; i < count; ++i) {
      offset[i] = static_cast<Index>(next);
      next += nodes_of(i);
      if (next > static_cast<std::size_t>(std::numeric_limits<Index>::max())) refuse_size();
    }
    offset[count] = static_cast<Index>(next);
  };
  add(edge_offset_, topology_->edge_count(),
      [&](std::size_t e) { return own_count(Shape::line, orders_.edge[e]); });
  add(face_offset_, topology_->face_count(),
      [&](std::size_t f) { return own_count(topology_->face_shape[f], orders_.face[f]); });
  add(cell_offset_, mesh_->cell_count(),
      [&](std::size_t c) { return own_count(mesh_->cell_shape[c], orders_.cell[c]); });
  nodes_.assign(next, Vec3::Zero());
}

void CurvedMesh::straighten() {
  const Topology& t = *topology_;
  parallel_for(t.edge_count(), k_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t e = begin; e < end; ++e) {
      const int q = orders_.edge[e];
      const Vec3 &a = vertex(t.edge2vertex[e][0]), &b = vertex(t.edge2vertex[e][1]);
      const std::span<Vec3> nodes = edge_nodes(static_cast<Index>(e));
      for (std::size_t i = 0; i < nodes.size(); ++i) {
        const double s = static_cast<double>(i + 1) / q;
        nodes[i] = (1.0 - s) * a + s * b;
      }
    }
  });
  parallel_for(t.face_count(), k_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      const std::span<Vec3> nodes = face_nodes(static_cast<Index>(f));
      if (nodes.empty()) continue;
      straight_inside_face(static_cast<Index>(f), nodes);
    }
  });
  parallel_for(mesh_->cell_count(), k_grain, [&](std::size_t begin, std::size_t end) {
    for (std::size_t c = begin; c < end; ++c) {
      const std::span<Vec3> nodes = cell_nodes(static_cast<Index>(c));
      if (!nodes.empty()) straight_inside_cell(static_cast<Index>(c), nodes);
    }
  });
}

void CurvedMesh::edge_lattice(Index e, int q, std::span<Vec3> points) const {
  const int r = edge_order(e);
  CAMBER_ASSERT(q >= r, "an edge can only be elevated");
  const std::array<Index, 2>& v = topology_->edge2vertex[at(e)];
  std::array<Vec3, 8> stored;
  const std::span<const Vec3> inner = edge_nodes(e);
  stored[0] = vertex(v[0]);
  std::copy(inner.begin(), inner.end(), stored.begin() + 1);
  stored[static_cast<std::size_t>(r)] = vertex(v[1]);
  if (q == r) {
    std::copy_n(stored.begin(), r + 1, points.begin());
    return;
  }
  apply(elevation_matrix(Shape::line, r, q),
        std::span(stored.data(), static_cast<std::size_t>(r) + 1),
        points.first(static_cast<std::size_t>(q) + 1));
  points[0] = stored[0];
  points[static_cast<std::size_t>(q)] = stored[static_cast<std::size_t>(r)];
}

void CurvedMesh::face_lattice(Index f, int q, std::span<Vec3> points) const {
  const Shape shape = topology_->face_shape[at(f)];
  const int r = face_order(f);
  CAMBER_ASSERT(q >= r, "a face can only be elevated");
  const std::size_t count = static_cast<std::size_t>(node_count(shape, r));
  std::array<Vec3, k_face_capacity> stored;
  const std::span<Vec3> full = q == r ? points.first(count) : std::span(stored.data(), count);
  const LatticeMap& map = lattice_map(shape, r);
  const int n = topology_->corners_of_face(f);
  std::array<Vec3, 8> line;
  for (int i = 0; i < n; ++i) {
    const std::size_t s = static_cast<std::size_t>(i);
    full[static_cast<std::size_t>(map.corner[s])] = vertex(topology_->face2vertex[at(f)][s]);
    const Index e = topology_->face2edge[at(f)][s];
    edge_lattice(e, r, line);
    const bool reversed = topology_->edge2vertex[at(e)][0] != topology_->face2vertex[at(f)][s];
    // Local edge i of a triangle or quadrilateral joins corners i and i+1.
    const std::vector<int>& slots = map.edge_interior[s];
    for (std::size_t k = 0; k < slots.size(); ++k) {
      full[static_cast<std::size_t>(slots[k])] =
          line[reversed ? static_cast<std::size_t>(r) - 1 - k : k + 1];
    }
  }
  const std::span<const Vec3> inner = face_nodes(f);
  for (std::size_t i = 0; i < inner.size(); ++i) {
    full[static_cast<std::size_t>(map.interior[i])] = inner[i];
  }
  if (q != r) {
    apply(elevation_matrix(shape, r, q), full,
          points.first(static_cast<std::size_t>(node_count(shape, q))));
  }
}

void CurvedMesh::gather(Index c, int q, Points& nodes) const {
  const Shape shape = mesh_->cell_shape[at(c)];
  const int p = cell_order(c);
  CAMBER_ASSERT(q >= p, "a cell can only be elevated");
  nodes.resize(static_cast<std::size_t>(node_count(shape, p)));
  const LatticeMap& map = lattice_map(shape, p);
  const std::span<const Index> v = mesh_->cell(c);
  for (std::size_t i = 0; i < v.size(); ++i) {
    nodes[static_cast<std::size_t>(map.corner[i])] = vertex(v[i]);
  }
  if (p > 1) {
    const Topology& t = *topology_;
    std::array<Vec3, 8> line;
    const std::span<const Index> cell_edges = t.edges_of_cell(c);
    for (std::size_t i = 0; i < cell_edges.size(); ++i) {
      const Index e = cell_edges[i];
      const bool reversed = t.cell2edge_reversed[at(t.cell2edge_offset[at(c)]) + i] != 0;
      const std::vector<int>& slots = map.edge_interior[i];
      std::span<const Vec3> inner = edge_nodes(e);
      if (edge_order(e) != p) {
        edge_lattice(e, p, line);
        inner = std::span<const Vec3>(line).subspan(1, slots.size());
      }
      for (std::size_t k = 0; k < slots.size(); ++k) {
        nodes[static_cast<std::size_t>(slots[k])] = inner[reversed ? slots.size() - 1 - k : k];
      }
    }
    std::array<Vec3, k_face_capacity> surface;
    const std::span<const Index> cell_faces = t.faces_of_cell(c);
    for (std::size_t i = 0; i < cell_faces.size(); ++i) {
      const Index f = cell_faces[i];
      if (map.face_interior[i].empty()) continue;
      const int view = t.cell2face_view[at(t.cell2face_offset[at(c)]) + i];
      if (face_order(f) == p) {
        const std::span<const Vec3> own = face_nodes(f);
        const std::span<const int> place = face_view_interior(t.face_shape[at(f)], view, p);
        const std::vector<int>& slots = map.face_interior[i];
        for (std::size_t k = 0; k < own.size(); ++k) {
          nodes[static_cast<std::size_t>(slots[k])] = own[static_cast<std::size_t>(place[k])];
        }
        continue;
      }
      face_lattice(f, p, surface);
      const std::span<const int> frame_node = face_view_nodes(t.face_shape[at(f)], view, p);
      for (int inside : interior_nodes(t.face_shape[at(f)], p)) {
        nodes[static_cast<std::size_t>(map.face[i][static_cast<std::size_t>(inside)])] =
            surface[static_cast<std::size_t>(frame_node[static_cast<std::size_t>(inside)])];
      }
    }
    const std::span<const Vec3> inner = cell_nodes(c);
    for (std::size_t i = 0; i < inner.size(); ++i) {
      nodes[static_cast<std::size_t>(map.interior[i])] = inner[i];
    }
  }
  if (q != p) {
    Points elevated(static_cast<std::size_t>(node_count(shape, q)));
    apply(elevation_matrix(shape, p, q), nodes, elevated);
    nodes = std::move(elevated);
  }
}

void CurvedMesh::straight_inside_face(Index f, std::span<Vec3> nodes) const {
  std::array<Vec3, 4> corner;
  const std::size_t n = static_cast<std::size_t>(topology_->corners_of_face(f));
  for (std::size_t i = 0; i < n; ++i) corner[i] = vertex(topology_->face2vertex[at(f)][i]);
  straight_inside(topology_->face_shape[at(f)], face_order(f), std::span(corner.data(), n), nodes);
}

void CurvedMesh::straight_inside_cell(Index c, std::span<Vec3> nodes) const {
  std::array<Vec3, 8> corner;
  const std::span<const Index> v = mesh_->cell(c);
  for (std::size_t i = 0; i < v.size(); ++i) corner[i] = vertex(v[i]);
  straight_inside(mesh_->cell_shape[at(c)], cell_order(c), std::span(corner.data(), v.size()),
                  nodes);
}

void CurvedMesh::gather_straight(Index c, int q, Points& nodes) const {
  std::array<Vec3, 8> corner;
  const std::span<const Index> v = mesh_->cell(c);
  for (std::size_t i = 0; i < v.size(); ++i) corner[i] = vertex(v[i]);
  nodes = straight_nodes(mesh_->cell_shape[at(c)], q, std::span(corner.data(), v.size()));
}

}  // namespace camber
