#include <camber/base/error.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/basis/quadrature.hpp>
#include <camber/mesh/export_mesh.hpp>

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "../support/cube_mesh.hpp"
#include "../support/random_nodes.hpp"
#include "hybrid_mesh.hpp"

namespace camber {
namespace {

using testing::cube_mesh;
using testing::Filling;
using testing::nodes_of;
using testing::random_orders;
using testing::shake;

/// A shaken hybrid cube of random orders and what it stands on.
struct Case {
  LinearMesh mesh;
  Topology topology;
  CurvedMesh curved;

  Case(const MeshData& data, std::vector<std::uint8_t> orders, unsigned seed)
      : mesh(build_linear_mesh(data)),
        topology(build_topology(mesh)),
        curved(mesh, topology, minimum_rule(topology, std::move(orders))) {
    std::mt19937 random(seed);
    shake(curved, 0.02, random);
  }
  Case(const Case&) = delete;
  Case& operator=(const Case&) = delete;
};

std::vector<std::uint8_t> orders_for(const MeshData& data, int highest, unsigned seed) {
  std::size_t cells = 0;
  for (const ElementBlock& block : data.blocks)
    cells += dimension(block.shape) == 3 ? block.size() : 0;
  std::mt19937 random(seed);
  return random_orders(cells, highest, random);
}

/// Calls visit(block, element in block, cell, face) for all exported elements.
template <class Visit>
void for_each_element(const MeshData& data, const ExportMap& map, Visit visit) {
  std::size_t i = 0;
  for (const ElementBlock& block : data.blocks) {
    for (std::size_t e = 0; e < block.size(); ++e, ++i) visit(block, e, map.cell[i], map.face[i]);
  }
  ASSERT_EQ(i, map.cell.size());
}

TEST(ExportMesh, WritesEveryCellWithTheNodesItGathers) {
  for (unsigned seed = 1; seed <= 3; ++seed) {
    const MeshData data = cube_mesh(Filling::hybrid, 2, seed);
    const Case given(data, orders_for(data, 4, seed), seed);
    for (int uniform : {0, 4}) {
      ExportMap map;
      const MeshData out = export_mesh(given.curved, uniform, &map);

      std::set<Index> cells;
      for_each_element(out, map, [&](const ElementBlock& block, std::size_t e, Index c, Index) {
        if (dimension(block.shape) < 3) return;
        ASSERT_NE(c, k_none);
        cells.insert(c);
        EXPECT_EQ(block.shape, given.mesh.cell_shape[at(c)]);
        EXPECT_EQ(block.order, uniform > 0 ? uniform : given.curved.cell_order(c));
        EXPECT_EQ(block.tags[e], given.mesh.cell_tags[at(c)]);
        Points expected;
        given.curved.gather(c, block.order, expected);
        const Points nodes = nodes_of(out, block, e);
        for (std::size_t n = 0; n < nodes.size(); ++n)
          EXPECT_LT((nodes[n] - expected[n]).norm(), 1e-14);
      });
      EXPECT_EQ(cells.size(), given.mesh.cell_count());
    }
  }
}

TEST(ExportMesh, SharesNodesBetweenCellAndSurfaceElement) {
  const MeshData data = cube_mesh(Filling::hybrid, 2, 4);
  const Case given(data, orders_for(data, 4, 4), 4);
  for (int uniform : {0, 4}) {
    ExportMap map;
    const MeshData out = export_mesh(given.curved, uniform, &map);
    std::map<Index, std::set<Index>> nodes_of_cell;
    for_each_element(out, map, [&](const ElementBlock& block, std::size_t e, Index c, Index) {
      const std::size_t n = static_cast<std::size_t>(node_count(block.shape, block.order));
      if (c != k_none)
        nodes_of_cell[c].insert(block.nodes.begin() + static_cast<std::ptrdiff_t>(e * n),
                                block.nodes.begin() + static_cast<std::ptrdiff_t>((e + 1) * n));
    });

    std::size_t surface_elements = 0;
    for_each_element(out, map, [&](const ElementBlock& block, std::size_t e, Index, Index f) {
      if (dimension(block.shape) != 2) return;
      ++surface_elements;
      const std::set<Index>& cell = nodes_of_cell.at(given.topology.face2cell[at(f)][0]);
      const std::size_t n = static_cast<std::size_t>(node_count(block.shape, block.order));
      for (std::size_t k = 0; k < n; ++k) EXPECT_TRUE(cell.contains(block.nodes[e * n + k]));
      // The element is the face's polynomial in the walk of the file.
      const Points nodes = nodes_of(out, block, e);
      Points frame(n);
      given.curved.face_lattice(f, block.order, frame);
      for (const Vec3& x : nodes) {
        EXPECT_TRUE(std::any_of(frame.begin(), frame.end(),
                                [&](const Vec3& y) { return (x - y).norm() < 1e-14; }));
      }
    });
    EXPECT_EQ(surface_elements, given.mesh.patch_face_shape.size());
  }
}

TEST(ExportMesh, KeepsTheWalkOfSurfaceElementsAndTheirEntities) {
  const MeshData data = cube_mesh(Filling::hybrid, 2, 5);
  const Case given(data, std::vector<std::uint8_t>(orders_for(data, 4, 5).size(), 3), 5);
  ExportMap map;
  const MeshData out = export_mesh(given.curved, 0, &map);

  for_each_element(out, map, [&](const ElementBlock& block, std::size_t e, Index, Index f) {
    if (dimension(block.shape) != 2) return;
    const Index b = given.topology.face2patch_face[at(f)];
    EXPECT_EQ(block.entity, given.mesh.patch_face_entity[at(b)]);
    const LatticeMap& lattice = lattice_map(block.shape, 3);
    const Index* nodes =
        block.nodes.data() + e * static_cast<std::size_t>(node_count(block.shape, 3));
    for (std::size_t i = 0; i < lattice.corner.size(); ++i) {
      EXPECT_EQ(nodes[lattice.corner[i]], given.mesh.patch_face_vertices[at(b)][i]);
    }
    // Edge i lies between corners i and i+1 of the walk: its nodes are those of that edge, in
    // order.
    for (std::size_t i = 0; i < lattice.edge.size(); ++i) {
      const Index a = nodes[lattice.corner[i]],
                  c = nodes[lattice.corner[(i + 1) % lattice.corner.size()]];
      Points line(4);
      given.curved.edge_lattice(given.topology.find_edge(a, c), 3, line);
      if (a > c) std::reverse(line.begin(), line.end());
      for (std::size_t k = 0; k < 4; ++k)
        EXPECT_LT((out.points[at(nodes[lattice.edge[i][k]])] - line[k]).norm(), 1e-15);
    }
  });
}

TEST(ExportMesh, StoresEveryNodeOfAUniformMeshOnce) {
  const MeshData data = cube_mesh(Filling::hybrid, 2, 6);
  const Case given(data, orders_for(data, 4, 6), 6);

  const MeshData out = export_mesh(given.curved, 4);

  std::size_t expected = given.mesh.vertices.size() + 3 * given.topology.edge_count();
  for (Shape shape : given.topology.face_shape) expected += interior_nodes(shape, 4).size();
  for (Shape shape : given.mesh.cell_shape) expected += lattice_map(shape, 4).interior.size();
  EXPECT_EQ(out.points.size(), expected);
  std::set<GlobalId> tags(out.point_tags.begin(), out.point_tags.end());
  EXPECT_EQ(tags.size(), out.points.size());
  EXPECT_EQ(out.point_entity.size(), out.points.size());
}

TEST(ExportMesh, LeavesNoNodeUnused) {
  const MeshData data = cube_mesh(Filling::hybrid, 2, 7);
  const Case given(data, orders_for(data, 4, 7), 7);
  for (int uniform : {0, 4}) {
    const MeshData out = export_mesh(given.curved, uniform);
    std::vector<bool> is_used(out.points.size(), false);
    for (const ElementBlock& block : out.blocks) {
      for (Index n : block.nodes) is_used[at(n)] = true;
    }
    EXPECT_EQ(std::count(is_used.begin(), is_used.end(), false), 0);
  }
}

TEST(ExportMesh, PutsLinesOnTheEdgesOfTheirCurves) {
  const MeshData data = cube_mesh(Filling::hybrid, 2, 8);
  const Case given(data, orders_for(data, 4, 8), 8);
  const MeshData out = export_mesh(given.curved);

  std::size_t lines = 0;
  for (const ElementBlock& block : out.blocks) {
    if (block.shape != Shape::line) continue;
    for (std::size_t e = 0; e < block.size(); ++e, ++lines) {
      const std::size_t n = static_cast<std::size_t>(block.order) + 1;
      const Index a = block.nodes[e * n], b = block.nodes[(e + 1) * n - 1];
      const Index edge = given.topology.find_edge(a, b);
      ASSERT_NE(edge, k_none);
      EXPECT_EQ(block.order, given.curved.edge_order(edge));
      Points line(n);
      given.curved.edge_lattice(edge, block.order, line);
      if (a > b) std::reverse(line.begin(), line.end());
      for (std::size_t k = 0; k < n; ++k) {
        const Index node = block.nodes[e * n + k];
        EXPECT_EQ(out.points[at(node)], line[k]);
        if (k > 0 && k + 1 < n) {
          EXPECT_EQ(out.point_entity[at(node)], (EntityKey{1, block.entity}));
        }
      }
    }
  }
  EXPECT_EQ(lines, 24u);
}

TEST(ExportMesh, TagsRegionsOfSeveralOrdersWithoutAClash) {
  MeshData data = cube_mesh(Filling::hexes, 2, 9);
  // Region 1 holds orders 1 and 4, region 14 only order 2: 1 * 10 + 4 would be 14 as well.
  for (ElementBlock& block : data.blocks) {
    if (block.shape != Shape::hexahedron) continue;
    ElementBlock other{block.shape, 1, 14, {}, {}};
    other.nodes.assign(block.nodes.begin() + 4 * 8, block.nodes.end());
    other.tags.assign(block.tags.begin() + 4, block.tags.end());
    block.nodes.resize(4 * 8);
    block.tags.resize(4);
    data.blocks.push_back(std::move(other));
    break;
  }
  data.entities = {{{3, 1}, "inner", {1}, {}}, {{3, 14}, "outer", {2}, {}}};
  const Case given(data, {1, 4, 4, 1, 2, 2, 2, 2}, 9);

  ExportMap map;
  const MeshData out = export_mesh(given.curved, 0, &map);

  std::map<int, std::set<std::pair<int, int>>> content;  // entity -> (region, order)
  for_each_element(out, map, [&](const ElementBlock& block, std::size_t, Index c, Index) {
    if (c != k_none) content[block.entity].insert({given.mesh.cell_region[at(c)], block.order});
  });
  EXPECT_EQ(content.size(), 3u);
  for (const auto& [entity, held] : content) EXPECT_EQ(held.size(), 1u) << "entity " << entity;
  EXPECT_TRUE(content.contains(14));
  for (const EntityRecord& record : out.entities) {
    if (record.key.dim != 3) continue;
    ASSERT_TRUE(content.contains(record.key.tag));
    EXPECT_EQ(record.name, content[record.key.tag].begin()->first == 1 ? "inner" : "outer");
  }
}

TEST(ExportMesh, RefusesAUniformOrderBelowACell) {
  const MeshData data = cube_mesh(Filling::hexes, 1, 10);
  const Case given(data, {3}, 10);

  EXPECT_THROW(static_cast<void>(export_mesh(given.curved, 2)), OptionError);
  EXPECT_THROW(static_cast<void>(export_mesh(given.curved, 5)), OptionError);
  EXPECT_EQ(export_mesh(given.curved, 3).points.size(), 64u);
}

TEST(ExportMesh, OfALinearMeshIsThatMesh) {
  const MeshData data = cube_mesh(Filling::tets, 2, 11);
  const Case given(data, orders_for(data, 1, 11), 11);

  const MeshData out = export_mesh(given.curved);

  EXPECT_EQ(out.points.size(), given.mesh.vertices.size());
  std::size_t elements = 0;
  for (const ElementBlock& block : data.blocks) elements += block.size();
  EXPECT_EQ(out.element_count(), elements);
}

}  // namespace
}  // namespace camber
