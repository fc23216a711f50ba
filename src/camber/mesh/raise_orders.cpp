#include <camber/base/assert.hpp>
#include <camber/base/parallel.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/mesh/raise_orders.hpp>

#include <algorithm>
#include <array>
#include <utility>

namespace camber {
namespace {

constexpr std::size_t k_raise_grain = 512;

}  // namespace

void limit_order_jumps(const Topology& topology, std::vector<std::uint8_t>& cell_orders) {
  // From the highest order down: a raise never touches a level that is already settled.
  const int highest =
      cell_orders.empty() ? 1 : *std::max_element(cell_orders.begin(), cell_orders.end());
  for (int q = highest; q > 2; --q) {
    for (const auto& [a, b] : topology.face2cell) {
      if (b == k_none) continue;
      const std::uint8_t least = static_cast<std::uint8_t>(q - 1);
      if (cell_orders[at(a)] == q) cell_orders[at(b)] = std::max(cell_orders[at(b)], least);
      if (cell_orders[at(b)] == q) cell_orders[at(a)] = std::max(cell_orders[at(a)], least);
    }
  }
}

CurvedMesh raise_orders(const CurvedMesh& curved, std::vector<std::uint8_t> cell_orders) {
  const Topology& topology = curved.topology();
  CurvedMesh raised(curved.linear(), topology, minimum_rule(topology, std::move(cell_orders)));
  parallel_for(topology.edge_count(), k_raise_grain, [&](std::size_t begin, std::size_t end) {
    std::array<Vec3, 8> all;
    for (std::size_t i = begin; i < end; ++i) {
      const Index e = static_cast<Index>(i);
      const std::span<Vec3> own = raised.edge_nodes(e);
      if (own.empty()) continue;
      curved.edge_lattice(e, raised.edge_order(e), all);
      std::copy_n(all.begin() + 1, own.size(), own.begin());
    }
  });
  parallel_for(topology.face_count(), k_raise_grain, [&](std::size_t begin, std::size_t end) {
    std::array<Vec3, 49> all;
    for (std::size_t i = begin; i < end; ++i) {
      const Index f = static_cast<Index>(i);
      const std::span<Vec3> own = raised.face_nodes(f);
      if (own.empty()) continue;
      const int q = raised.face_order(f);
      curved.face_lattice(f, q, all);
      const std::span<const int> inner = interior_nodes(topology.face_shape[i], q);
      for (std::size_t k = 0; k < own.size(); ++k) own[k] = all[at(inner[k])];
    }
  });
  parallel_for(
      curved.linear().cell_count(), k_raise_grain, [&](std::size_t begin, std::size_t end) {
        Points all;
        for (std::size_t i = begin; i < end; ++i) {
          const Index c = static_cast<Index>(i);
          const std::span<Vec3> own = raised.cell_nodes(c);
          CAMBER_ASSERT(raised.cell_order(c) >= curved.cell_order(c), "orders are only raised");
          if (own.empty()) continue;
          const int q = raised.cell_order(c);
          curved.gather(c, q, all);
          const std::vector<int>& inner = lattice_map(curved.linear().cell_shape[i], q).interior;
          for (std::size_t k = 0; k < own.size(); ++k) own[k] = all[at(inner[k])];
        }
      });
  return raised;
}

namespace {

/// Nodes of a face in its own frame, as the nodes of order q of a cell on it say.
void see_face(const CurvedMesh& curved, Index c, std::size_t local, int q, const Points& nodes,
              Points& seen) {
  const Topology& topology = curved.topology();
  const std::vector<int>& slots = lattice_map(curved.linear().cell_shape[at(c)], q).face[local];
  const std::size_t place = at(topology.cell2face_offset[at(c)]) + local;
  const Shape shape = topology.face_shape[at(topology.cell2face[place])];
  const std::span<const int> frame_node = face_view_nodes(shape, topology.cell2face_view[place], q);
  seen.resize(slots.size());
  for (std::size_t n = 0; n < slots.size(); ++n) seen[at(frame_node[n])] = nodes[at(slots[n])];
}

}  // namespace

double largest_gap(const CurvedMesh& curved) {
  const Topology& topology = curved.topology();
  const std::size_t cells = curved.linear().cell_count();
  std::vector<double> gap(cells, 0.0);  // on the faces that the cell is the first of
  // By cell, so that its nodes are gathered once for all its faces.
  parallel_for(cells, k_raise_grain, [&](std::size_t begin, std::size_t end) {
    Points own, other;
    std::array<Points, 2> seen;
    for (std::size_t i = begin; i < end; ++i) {
      const Index a = static_cast<Index>(i);
      const std::span<const Index> faces = topology.faces_of_cell(a);
      int gathered = 0;  // order of `own`
      for (std::size_t local = 0; local < faces.size(); ++local) {
        const auto [first, b] = topology.face2cell[at(faces[local])];
        if (first != a || b == k_none) continue;
        const int q = std::max(curved.cell_order(a), curved.cell_order(b));
        if (q < 2) continue;
        if (gathered != q) curved.gather(a, q, own);
        gathered = q;
        curved.gather(b, q, other);
        const std::span<const Index> others = topology.faces_of_cell(b);
        std::size_t there = 0;
        while (others[there] != faces[local]) ++there;
        see_face(curved, a, local, q, own, seen[0]);
        see_face(curved, b, there, q, other, seen[1]);
        for (std::size_t n = 0; n < seen[0].size(); ++n) {
          gap[i] = std::max(gap[i], (seen[0][n] - seen[1][n]).norm());
        }
      }
    }
  });
  return gap.empty() ? 0.0 : *std::max_element(gap.begin(), gap.end());
}

}  // namespace camber
