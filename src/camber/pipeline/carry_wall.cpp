#include <camber/basis/lagrange.hpp>
#include <camber/elevate/apply_field.hpp>
#include <camber/pipeline/carry_wall.hpp>

#include <algorithm>

namespace camber {
namespace {

/// The polynomial of order r through the nodes at the lattice of order q: the same one for q >= r,
/// sampled for q < r.
Points at_order(Shape shape, int r, int q, std::span<const Vec3> nodes) {
  if (q == r) return {nodes.begin(), nodes.end()};
  const MatX& change = elevation_matrix(shape, r, q);
  Points result(static_cast<std::size_t>(change.rows()), Vec3::Zero());
  for (std::size_t n = 0; n < result.size(); ++n) {
    for (std::size_t m = 0; m < nodes.size(); ++m) {
      result[n] += change(static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(m)) * nodes[m];
    }
  }
  return result;
}

void set_edge(const CurvedMesh& curved, const Wall& wall, Index slot, Placement& placement) {
  const Index e = wall.edges[at(slot)];
  const int r = curved.edge_order(e);
  Points nodes(at(r) + 1);
  curved.edge_lattice(e, r, nodes);
  for (int q = 2; q <= placement.max_order(); ++q) {
    const Points all = at_order(Shape::line, r, q, nodes);
    placement.set_edge(slot, q, std::span(all).subspan(1, at(q) - 1));
  }
}

void set_face(const CurvedMesh& curved, const Wall& wall, Index slot, Placement& placement) {
  const Index f = wall.faces[at(slot)];
  const Shape shape = curved.topology().face_shape[at(f)];
  const int r = curved.face_order(f);
  Points nodes(at(node_count(shape, r))), own;
  curved.face_lattice(f, r, nodes);
  for (int q = 2; q <= placement.max_order(); ++q) {
    const Points all = at_order(shape, r, q, nodes);
    own.clear();
    for (int n : interior_nodes(shape, q)) own.push_back(all[at(n)]);
    placement.set_face(slot, q, own);
  }
}

/// Wall edges and faces that differ between two meshes of the same orders, as slots.
struct Changes {
  std::vector<Index> edges, faces;
};

Changes find_changes(const CurvedMesh& before, const CurvedMesh& after, const Wall& wall) {
  const Topology& topology = before.topology();
  Changes changes;
  std::vector<std::uint8_t> is_changed(wall.edge_count(), 0);
  for (std::size_t s = 0; s < wall.edge_count(); ++s) {
    const Index e = wall.edges[s];
    if (std::ranges::equal(before.edge_nodes(e), after.edge_nodes(e))) continue;
    is_changed[s] = 1;
    changes.edges.push_back(static_cast<Index>(s));
  }
  for (std::size_t s = 0; s < wall.face_count(); ++s) {
    const Index f = wall.faces[s];
    bool differs = !std::ranges::equal(before.face_nodes(f), after.face_nodes(f));
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      differs |= is_changed[at(wall.edge_slot[at(topology.face2edge[at(f)][at(i)])])] != 0;
    }
    if (differs) changes.faces.push_back(static_cast<Index>(s));
  }
  return changes;
}

/// `curved` with the field of its own wall.
CurvedMesh carried(const CurvedMesh& curved, const Changes& changes, const FieldSource& source) {
  Placement placement = source.placement;
  for (Index slot : changes.edges) set_edge(curved, source.wall, slot, placement);
  for (Index slot : changes.faces) set_face(curved, source.wall, slot, placement);
  CurvedMesh result = curved;
  apply_field(LayerField(curved.linear(), curved.topology(), source.association, source.wall,
                         placement, source.columns, source.options),
              result);
  return result;
}

}  // namespace

void carry_wall(const CurvedMesh& before, CurvedMesh& after, const FieldSource& source) {
  const Changes changes = find_changes(before, after, source.wall);
  if (changes.faces.empty()) return;
  const CurvedMesh low = carried(before, changes, source), high = carried(after, changes, source);
  const auto move = [](std::span<const Vec3> from, std::span<const Vec3> to, std::span<Vec3> x) {
    for (std::size_t k = 0; k < x.size(); ++k) x[k] += to[k] - from[k];
  };
  const Topology& topology = after.topology();
  for (Index e = 0; at(e) < topology.edge_count(); ++e) {
    if (source.wall.edge_slot[at(e)] == k_none) {
      move(low.edge_nodes(e), high.edge_nodes(e), after.edge_nodes(e));
    }
  }
  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    if (source.wall.face_slot[at(f)] == k_none) {
      move(low.face_nodes(f), high.face_nodes(f), after.face_nodes(f));
    }
  }
  for (Index c = 0; at(c) < after.linear().cell_count(); ++c) {
    move(low.cell_nodes(c), high.cell_nodes(c), after.cell_nodes(c));
  }
}

}  // namespace camber
