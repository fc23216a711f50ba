#include <camber/base/parallel.hpp>
#include <camber/base/sorted_set.hpp>
#include <camber/smooth/marching/march_problem.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>

namespace camber {
namespace {

constexpr std::size_t k_grain = 32;

std::size_t sz(int i) { return static_cast<std::size_t>(i); }

template <class Mesh>  // CurvedMesh, const or not
auto own_nodes(Mesh& curved, int dim, Index entity) {
  return dim == 1   ? curved.edge_nodes(entity)
         : dim == 2 ? curved.face_nodes(entity)
                    : curved.cell_nodes(entity);
}

/// Everything stored at the origin.
CurvedMesh emptied(CurvedMesh curved) {
  for (int dim = 1; dim <= 3; ++dim) {
    const std::size_t n = dim == 1   ? curved.topology().edge_count()
                          : dim == 2 ? curved.topology().face_count()
                                     : curved.linear().cell_count();
    for (Index i = 0; at(i) < n; ++i) {
      for (Vec3& x : own_nodes(curved, dim, i)) x.setZero();
    }
  }
  return curved;
}

/// Meshes that tell by their gather how an element depends on the nodes.
struct Probes {
  CurvedMesh without;   // nodes that may move at the origin, others in place
  CurvedMesh numbered;  // node i that may move at (i + 1, 0, 0), others at the origin
  CurvedMesh single;    // everything at the origin; one node at a time is moved
};

class Builder {
 public:
  Builder(const CurvedMesh& curved, const FixedEntities& fixed, int dimension,
          std::vector<Index> elements)
      : curved_(curved), topology_(curved.topology()), list_(std::move(elements)) {
    problem_.dimension = dimension;
    is_free_ = {fixed.edge, fixed.face};
    for (std::vector<std::uint8_t>& flags : is_free_) {
      for (std::uint8_t& flag : flags) flag = flag == 0;
    }
  }

  MarchProblem run() {
    number_nodes();
    Probes probes{curved_, emptied(curved_), emptied(curved_)};
    for (std::size_t i = 0; i < problem_.stored.size(); ++i) {
      const StoredNode& s = problem_.stored[i];
      own_nodes(probes.without, s.dim, s.entity)[at(s.place)].setZero();
      own_nodes(probes.numbered, s.dim, s.entity)[at(s.place)].x() = static_cast<double>(i + 1);
    }
    problem_.elements.resize(list_.size());
    parallel_for_with(
        list_.size(), k_grain, [&] { return std::make_unique<Probes>(probes); },
        [&](std::size_t begin, std::size_t end, std::unique_ptr<Probes>& own) {
          for (std::size_t i = begin; i < end; ++i) build(i, *own);
        });
    return std::move(problem_);
  }

 private:
  [[nodiscard]] std::span<const Index> faces_of(const Index& element) const {
    return problem_.dimension == 3 ? topology_.faces_of_cell(element) : std::span(&element, 1);
  }
  [[nodiscard]] std::span<const Index> edges_of(Index element) const {
    if (problem_.dimension == 3) return topology_.edges_of_cell(element);
    return {topology_.face2edge[at(element)].data(), sz(topology_.corners_of_face(element))};
  }
  [[nodiscard]] int order_of(Index element) const {
    return problem_.dimension == 3 ? curved_.cell_order(element) : curved_.face_order(element);
  }
  void gather(const CurvedMesh& mesh, Index element, Points& x) const {
    const int p = order_of(element);
    if (problem_.dimension == 3) return mesh.gather(element, p, x);
    x.resize(sz(node_count(topology_.face_shape[at(element)], p)));
    mesh.face_lattice(element, p, x);
  }

  /// Numbers the nodes of free entities of all elements: edges, then faces, then insides.
  void number_nodes() {
    first_[0].assign(topology_.edge_count(), k_none);
    first_[1].assign(topology_.face_count(), k_none);
    first_[2].assign(curved_.linear().cell_count(), k_none);
    std::array<std::vector<Index>, 3> entities;
    for (const Index& element : list_) {
      for (Index e : edges_of(element)) {
        if (is_free_[0][at(e)]) entities[0].push_back(e);
      }
      for (Index f : faces_of(element)) {
        if (is_free_[1][at(f)]) entities[1].push_back(f);
      }
      if (problem_.dimension == 3) entities[2].push_back(element);
    }
    for (int dim = 1; dim <= 3; ++dim) {
      make_sorted_set(entities[sz(dim - 1)]);
      for (Index entity : entities[sz(dim - 1)]) {
        first_[sz(dim - 1)][at(entity)] = static_cast<Index>(problem_.stored.size());
        const std::span<const Vec3> own = own_nodes(curved_, dim, entity);
        for (std::size_t k = 0; k < own.size(); ++k) {
          problem_.stored.push_back({dim, entity, static_cast<Index>(k)});
          problem_.x.push_back(own[k]);
        }
      }
    }
  }

  void build(std::size_t i, Probes& probes) {
    MarchElement& element = problem_.elements[i];
    element.entity = list_[i];
    element.order = order_of(element.entity);
    if (problem_.dimension == 3) {
      element.shape = curved_.linear().cell_shape[at(element.entity)];
      curved_.gather_straight(element.entity, element.order, element.X);
    } else {
      element.shape = topology_.face_shape[at(element.entity)];
      element.X = straight_face_nodes(curved_.linear(), topology_, element.entity, element.order);
    }
    gather(probes.without, element.entity, element.base);
    const std::span<const Index> edges = edges_of(element.entity), faces = faces_of(element.entity);
    const bool is_uniform =
        std::all_of(edges.begin(), edges.end(),
                    [&](Index e) { return curved_.edge_order(e) == element.order; }) &&
        std::all_of(faces.begin(), faces.end(),
                    [&](Index f) { return curved_.face_order(f) == element.order; });
    std::vector<std::vector<std::pair<Index, double>>> rows(element.base.size());
    if (is_uniform) {
      read_numbers(element, probes.numbered, rows);
    } else {
      probe(element, probes.single, rows);
    }
    pack(rows, element);
  }

  /// Every lattice node but the corners is stored somewhere.
  void read_numbers(const MarchElement& element, const CurvedMesh& numbered,
                    std::vector<std::vector<std::pair<Index, double>>>& rows) const {
    Points x;
    gather(numbered, element.entity, x);
    for (int corner : lattice_map(element.shape, element.order).corner) x[sz(corner)].setZero();
    for (std::size_t n = 0; n < x.size(); ++n) {
      const Index number = static_cast<Index>(std::lround(x[n].x()));
      if (number > 0) rows[n].emplace_back(number - 1, 1.0);
    }
  }

  /// Moves one node at a time: gather is linear.
  void probe(const MarchElement& element, CurvedMesh& single,
             std::vector<std::vector<std::pair<Index, double>>>& rows) const {
    Points rest, x;
    gather(single, element.entity, rest);
    // As far as the mesh reaches, so that the difference keeps its digits.
    double reach = 0.0;
    for (const Vec3& r : rest) reach = std::max(reach, std::abs(r.x()));
    reach = reach > 0.0 ? reach : 1.0;
    const auto probe_entity = [&](int dim, Index entity) {
      const Index first = first_[sz(dim - 1)][at(entity)];
      if (first == k_none) return;
      const std::span<Vec3> own = own_nodes(single, dim, entity);
      for (std::size_t k = 0; k < own.size(); ++k) {
        own[k].x() = reach;
        gather(single, element.entity, x);
        own[k].x() = 0.0;
        for (std::size_t n = 0; n < x.size(); ++n) {
          const double weight = (x[n].x() - rest[n].x()) / reach;
          if (std::abs(weight) > k_no_weight) {
            rows[n].emplace_back(first + static_cast<Index>(k), weight);
          }
        }
      }
    };
    for (Index e : edges_of(element.entity)) probe_entity(1, e);
    for (Index f : faces_of(element.entity)) probe_entity(2, f);
    if (problem_.dimension == 3) probe_entity(3, element.entity);
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

  /// Round-off of a difference of two places, relative to them: no weight of a gather is so small.
  static constexpr double k_no_weight = 1e-13;

  const CurvedMesh& curved_;
  const Topology& topology_;
  std::vector<Index> list_;
  std::array<std::vector<std::uint8_t>, 2> is_free_;  // edges, faces
  std::array<std::vector<Index>, 3> first_;           // number of the first node of an entity
  MarchProblem problem_;
};

}  // namespace

void MarchElement::gather(std::span<const Vec3> all, Points& x) const {
  x = base;
  for (std::size_t n = 0; n < x.size(); ++n) {
    for (int k = row[n]; k < row[n + 1]; ++k) {
      const auto& [place, weight] = weights[sz(k)];
      x[n] += weight * all[at(nodes[sz(place)])];
    }
  }
}

MarchProblem volume_problem(const CurvedMesh& curved, const FixedEntities& fixed,
                            std::span<const Index> cells) {
  std::vector<Index> elements(cells.begin(), cells.end());
  if (cells.empty()) {
    for (Index c = 0; at(c) < curved.linear().cell_count(); ++c) elements.push_back(c);
  }
  std::erase_if(elements, [&](Index c) { return curved.cell_order(c) < 2; });
  return Builder(curved, fixed, 3, std::move(elements)).run();
}

MarchProblem surface_problem(const CurvedMesh& curved, const FixedEntities& fixed,
                             std::span<const Index> faces) {
  std::vector<Index> elements(faces.begin(), faces.end());
  std::erase_if(elements, [&](Index f) { return curved.face_order(f) < 2; });
  return Builder(curved, fixed, 2, std::move(elements)).run();
}

void store(const MarchProblem& problem, CurvedMesh& curved) {
  for (std::size_t i = 0; i < problem.stored.size(); ++i) {
    const StoredNode& s = problem.stored[i];
    own_nodes(curved, s.dim, s.entity)[at(s.place)] = problem.x[i];
  }
}

}  // namespace camber
