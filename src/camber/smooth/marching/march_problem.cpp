#include <camber/base/parallel.hpp>
#include <camber/base/sorted_set.hpp>
#include <camber/mesh/node_map.hpp>
#include <camber/smooth/marching/march_problem.hpp>

#include <algorithm>
#include <array>
#include <cmath>

namespace camber {
namespace {

constexpr std::size_t k_grain = 128;
/// What is left of a coefficient that is 0 but for round-off; no weight of a gather is so small.
constexpr double k_no_weight = 1e-13;

template <class Mesh>  // CurvedMesh, const or not
auto own_nodes(Mesh& curved, int dim, Index entity) {
  return dim == 1   ? curved.edge_nodes(entity)
         : dim == 2 ? curved.face_nodes(entity)
                    : curved.cell_nodes(entity);
}

/// An element as a part of a cell of its order: the whole cell, or one of its faces.
struct Part {
  Index entity = k_none, cell = k_none;
  const std::vector<int>* nodes = nullptr;  // of the cell's lattice; all if null
};

class Builder {
 public:
  Builder(const CurvedMesh& curved, const FixedEntities& fixed, int dimension,
          std::vector<Part> parts)
      : curved_(curved), topology_(curved.topology()), fixed_(fixed), parts_(std::move(parts)) {
    problem_.dimension = dimension;
  }

  MarchProblem run() {
    number_nodes();
    std::vector<Index> cells;
    for (const Part& part : parts_) cells.push_back(part.cell);
    const NodeMap map(curved_, std::move(cells));
    problem_.elements.resize(parts_.size());
    parallel_for(parts_.size(), k_grain, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) build(map, i, problem_.elements[i]);
    });
    return std::move(problem_);
  }

 private:
  [[nodiscard]] std::span<const Index> faces_of(const Part& part) const {
    if (problem_.dimension == 3) return topology_.faces_of_cell(part.entity);
    return {&part.entity, 1};
  }
  [[nodiscard]] std::span<const Index> edges_of(const Part& part) const {
    if (problem_.dimension == 3) return topology_.edges_of_cell(part.entity);
    return {topology_.face2edge[at(part.entity)].data(),
            at(topology_.corners_of_face(part.entity))};
  }

  /// Numbers the nodes of free entities of all elements: edges, then faces, then insides.
  void number_nodes() {
    std::array<std::vector<Index>, 3> entities;
    for (const Part& part : parts_) {
      for (Index e : edges_of(part)) {
        if (!fixed_.edge[at(e)]) entities[0].push_back(e);
      }
      for (Index f : faces_of(part)) {
        if (!fixed_.face[at(f)]) entities[1].push_back(f);
      }
      if (problem_.dimension == 3) entities[2].push_back(part.entity);
    }
    number_.assign(curved_.high_order_node_count(), k_none);
    for (int dim = 1; dim <= 3; ++dim) {
      make_sorted_set(entities[at(dim - 1)]);
      for (Index entity : entities[at(dim - 1)]) {
        const std::span<const Vec3> own = own_nodes(curved_, dim, entity);
        for (std::size_t k = 0; k < own.size(); ++k) {
          const std::ptrdiff_t place = &own[k] - curved_.high_order_nodes().data();
          number_[static_cast<std::size_t>(place)] = static_cast<Index>(problem_.stored.size());
          problem_.stored.push_back({dim, entity, static_cast<Index>(k)});
          problem_.x.push_back(own[k]);
        }
      }
    }
  }

  void build(const NodeMap& map, std::size_t i, MarchElement& element) const {
    const Part& part = parts_[i];
    element.entity = part.entity;
    element.order = curved_.cell_order(part.cell);
    element.shape = problem_.dimension == 3 ? curved_.linear().cell_shape[at(part.cell)]
                                            : topology_.face_shape[at(part.entity)];
    Points X;
    curved_.gather_straight(part.cell, element.order, X);
    const std::size_t count = part.nodes ? part.nodes->size() : X.size();
    const std::size_t vertices = curved_.linear().vertices.size();
    std::vector<std::vector<std::pair<Index, double>>> rows(count);
    for (std::size_t n = 0; n < count; ++n) {
      const std::size_t node = part.nodes ? at((*part.nodes)[n]) : n;
      element.X.push_back(X[node]);
      Vec3 base = Vec3::Zero();
      for (const NodeMap::Entry& entry : map.row(i, node)) {
        if (at(entry.column) < vertices) {
          base += entry.coefficient * curved_.vertex(entry.column);
          continue;
        }
        const std::size_t place = at(entry.column) - vertices;
        if (number_[place] == k_none) {
          base += entry.coefficient * curved_.high_order_nodes()[place];
        } else if (std::abs(entry.coefficient) > k_no_weight) {
          rows[n].emplace_back(number_[place], entry.coefficient);
        }
      }
      element.base.push_back(base);
    }
    pack(rows, element);
  }

  static void pack(const std::vector<std::vector<std::pair<Index, double>>>& rows,
                   MarchElement& element) {
    for (const auto& row : rows) {
      for (const auto& [node, weight] : row) element.nodes.push_back(node);
    }
    make_sorted_set(element.nodes);
    element.row.push_back(0);
    for (const auto& row : rows) {
      for (const auto& [node, weight] : row) {
        const auto place = std::lower_bound(element.nodes.begin(), element.nodes.end(), node);
        element.weights.emplace_back(static_cast<int>(place - element.nodes.begin()), weight);
      }
      element.row.push_back(static_cast<int>(element.weights.size()));
    }
  }

  const CurvedMesh& curved_;
  const Topology& topology_;
  const FixedEntities& fixed_;
  std::vector<Part> parts_;
  std::vector<Index> number_;  // stored node -> place in the problem, or -1
  MarchProblem problem_;
};

/// The face as a part of a cell of its own order: there is one by the minimum rule.
Part part_of(const CurvedMesh& curved, Index f) {
  const Topology& topology = curved.topology();
  const auto [a, b] = topology.face2cell[at(f)];
  const Index cell = curved.cell_order(a) == curved.face_order(f) ? a : b;
  const std::span<const Index> cell_faces = topology.faces_of_cell(cell);
  const std::size_t local = static_cast<std::size_t>(
      std::find(cell_faces.begin(), cell_faces.end(), f) - cell_faces.begin());
  const LatticeMap& map =
      lattice_map(curved.linear().cell_shape[at(cell)], curved.cell_order(cell));
  return {f, cell, &map.face[local]};
}

}  // namespace

void MarchElement::gather(std::span<const Vec3> all, Points& x) const {
  x = base;
  for (std::size_t n = 0; n < x.size(); ++n) {
    for (int k = row[n]; k < row[n + 1]; ++k) {
      const auto& [place, weight] = weights[at(k)];
      x[n] += weight * all[at(nodes[at(place)])];
    }
  }
}

MarchProblem volume_problem(const CurvedMesh& curved, const FixedEntities& fixed,
                            std::span<const Index> cells) {
  std::vector<Part> parts;
  const auto add = [&](Index c) {
    if (curved.cell_order(c) > 1) parts.push_back({c, c, nullptr});
  };
  for (Index c : cells) add(c);
  for (Index c = 0; cells.empty() && at(c) < curved.linear().cell_count(); ++c) add(c);
  return Builder(curved, fixed, 3, std::move(parts)).run();
}

MarchProblem surface_problem(const CurvedMesh& curved, const FixedEntities& fixed,
                             std::span<const Index> faces) {
  std::vector<Part> parts;
  for (Index f : faces) {
    if (curved.face_order(f) > 1) parts.push_back(part_of(curved, f));
  }
  return Builder(curved, fixed, 2, std::move(parts)).run();
}

void store(const MarchProblem& problem, CurvedMesh& curved) {
  for (std::size_t i = 0; i < problem.stored.size(); ++i) {
    const StoredNode& s = problem.stored[i];
    own_nodes(curved, s.dim, s.entity)[at(s.place)] = problem.x[i];
  }
}

}  // namespace camber
