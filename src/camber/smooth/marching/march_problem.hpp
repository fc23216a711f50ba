#pragma once
// Which nodes may move, and how the Lagrange nodes of the elements around follow them.
#include <camber/mesh/curved_mesh.hpp>
#include <camber/smooth/patch.hpp>

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace camber {

/// A node that a curved mesh stores: of an edge (dim 1), face (2) or cell (3).
struct StoredNode {
  int dim = 0;
  Index entity = k_none;
  Index place = 0;  // among the entity's own nodes
};

/// An element of the stage: a cell, or a face of the boundary. Its own Lagrange nodes are
///   x_n = base_n + sum_i weight_ni x_i   over the nodes i that may move:
/// the gather of a mesh in which shapes belong to edges, faces and cells. Where everything that
/// touches the element has its order, each node is one of the x_i or fixed.
struct MarchElement {
  Shape shape = Shape::tetrahedron;
  int order = 2;
  Index entity = k_none;                        // cell or face
  Points X;                                     // nodes on the computational mesh
  Points base;                                  // what vertices and fixed nodes contribute
  std::vector<Index> nodes;                     // the x_i, into MarchProblem::x
  std::vector<int> row;                         // of node n: weights row[n] .. row[n + 1]
  std::vector<std::pair<int, double>> weights;  // place in `nodes`, weight

  void gather(std::span<const Vec3> all, Points& x) const;
};

struct MarchProblem {
  int dimension = 3;  // of the elements
  std::vector<StoredNode> stored;
  Points x;  // where the nodes that may move are, one per `stored`
  std::vector<MarchElement> elements;
};

/// All nodes of curved cells but those of fixed entities; vertices stay where they are, as
/// everywhere in Camber. Elements: `cells` (all of order 2 or more if empty).
[[nodiscard]] MarchProblem volume_problem(const CurvedMesh& curved, const FixedEntities& fixed,
                                          std::span<const Index> cells = {});

/// All nodes of the faces but those of fixed entities. Elements: the faces of order 2 or more.
[[nodiscard]] MarchProblem surface_problem(const CurvedMesh& curved, const FixedEntities& fixed,
                                           std::span<const Index> faces);

/// Puts the nodes where the problem has them.
void store(const MarchProblem& problem, CurvedMesh& curved);

}  // namespace camber
