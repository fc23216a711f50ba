#include <camber/base/parallel.hpp>
#include <camber/base/sorted_set.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/basis/quadrature.hpp>
#include <camber/smooth/distortion.hpp>
#include <camber/smooth/lbfgs.hpp>
#include <camber/smooth/patch.hpp>
#include <camber/validity/element_validity.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <optional>
#include <unordered_map>

namespace camber {
namespace {

std::size_t sz(Eigen::Index i) { return static_cast<std::size_t>(i); }

/// Weight of all lattice samples of a cell together, beside 1 for its Gauss points.
constexpr double k_lattice_weight = 0.1;
/// A repaired cell should keep at least this share of its straight Jacobian at every sample before
/// the group is tested.
constexpr double k_wanted_ratio = 0.05;

/// Regularisation of barely inverted groups, and its factor from round to round.
constexpr double k_least_delta = 0.03;
constexpr double k_delta_shrink = 0.6;

/// Longest step of the optimiser: strain of the whole group, summed in squares.
constexpr double k_longest_step = 0.5;

/// Rounds without progress before a group is given up.
constexpr int k_patience = 3;
constexpr std::size_t k_cells_per_task = 16;

/// The free nodes of a group and how the cells around depend on them.
class Patch {
 public:
  Patch(CurvedMesh& curved, const std::vector<Index>& core, const FixedEntities& fixed)
      : curved_(curved) {
    const Topology& topology = curved.topology();
    for (Index c : core) {
      for (Index e : topology.edges_of_cell(c)) {
        if (!fixed.edge[at(e)] && !curved.edge_nodes(e).empty()) edges_.push_back(e);
      }
      for (Index f : topology.faces_of_cell(c)) {
        if (!fixed.face[at(f)] && !curved.face_nodes(f).empty()) faces_.push_back(f);
      }
      if (!curved.cell_nodes(c).empty()) insides_.push_back(c);
    }
    make_sorted_set(edges_);
    make_sorted_set(faces_);
    make_sorted_set(insides_);
    for (Index e : edges_) {
      for (Index c : topology.cells_of_edge(e)) cells_.push_back(c);
    }
    for (Index f : faces_) {
      for (Index c : topology.face2cell[at(f)]) {
        if (c != k_none) cells_.push_back(c);
      }
    }
    cells_.insert(cells_.end(), insides_.begin(), insides_.end());
    make_sorted_set(cells_);
    for_each_entity([&](std::span<Vec3> nodes) { free_count_ += nodes.size(); });
  }

  [[nodiscard]] const std::vector<Index>& cells() const { return cells_; }
  [[nodiscard]] std::size_t free_count() const { return free_count_; }

  [[nodiscard]] VecX positions() {
    VecX x(static_cast<Eigen::Index>(3 * free_count_));
    Eigen::Index k = 0;
    for_each_entity([&](std::span<Vec3> nodes) {
      for (const Vec3& node : nodes) {
        x.segment<3>(k) = node;
        k += 3;
      }
    });
    return x;
  }
  void set_positions(const VecX& x) {
    Eigen::Index k = 0;
    for_each_entity([&](std::span<Vec3> nodes) {
      for (Vec3& node : nodes) {
        node = x.segment<3>(k);
        k += 3;
      }
    });
  }

  /// Finds, by moving one node at a time, which nodes of which cell depend on it and how: gather is
  /// linear.
  void build() {
    std::vector<std::vector<std::pair<Index, VecX>>> columns(cells_.size());
    const VecX x = positions();
    set_positions(VecX::Zero(x.size()));
    std::vector<Points> base(cells_.size());
    for (std::size_t i = 0; i < cells_.size(); ++i)
      curved_.gather(cells_[i], curved_.cell_order(cells_[i]), base[i]);
    Index number = 0;
    Points nodes;
    const auto probe = [&](std::span<Vec3> own, const std::vector<Index>& touching) {
      for (Vec3& node : own) {
        node.x() = 1.0;
        for (Index c : touching) {
          const std::size_t i = static_cast<std::size_t>(
              std::lower_bound(cells_.begin(), cells_.end(), c) - cells_.begin());
          curved_.gather(c, curved_.cell_order(c), nodes);
          VecX column(static_cast<Eigen::Index>(nodes.size()));
          for (std::size_t n = 0; n < nodes.size(); ++n) {
            column[static_cast<Eigen::Index>(n)] = nodes[n].x() - base[i][n].x();
          }
          columns[i].emplace_back(number, std::move(column));
        }
        node.x() = 0.0;
        ++number;
      }
    };
    const Topology& topology = curved_.topology();
    for (Index e : edges_) {
      const std::span<const Index> c = topology.cells_of_edge(e);
      probe(curved_.edge_nodes(e), {c.begin(), c.end()});
    }
    for (Index f : faces_) {
      std::vector<Index> c;
      for (Index side : topology.face2cell[at(f)]) {
        if (side != k_none) c.push_back(side);
      }
      probe(curved_.face_nodes(f), c);
    }
    for (Index c : insides_) probe(curved_.cell_nodes(c), {c});
    for (std::size_t i = 0; i < cells_.size(); ++i) add_cell(cells_[i], base[i], columns[i]);
    set_positions(x);
  }

  /// Another sample where a certificate failed.
  void add_sample(std::size_t i, const Vec3& xi) {
    add_samples(data_[i], std::span(&xi, 1), std::array{1.0});
  }

  [[nodiscard]] double evaluate(const VecX& x, double delta, VecX& gradient) {
    parallel_for(data_.size(), k_cells_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) evaluate_cell(data_[i], x, delta);
    });
    // Summed in cell order: same bits for any number of threads.
    gradient.setZero(x.size());
    double energy = 0.0;
    for (const CellData& cell : data_) {
      if (!std::isfinite(cell.energy)) return std::numeric_limits<double>::infinity();
      energy += cell.energy;
      for (Eigen::Index k = 0; k < cell.slope.rows(); ++k) {
        gradient.segment<3>(3 * cell.free[sz(k)]) += cell.slope.row(k).transpose();
      }
    }
    return energy;
  }

  [[nodiscard]] double least_ratio(const VecX& x) const {
    double least = std::numeric_limits<double>::infinity();
    for (const CellData& cell : data_) {
      const MatX J = jacobians(cell, x);
      for (Eigen::Index s = 0; s < J.rows() / 3; ++s) {
        const Mat3 T = J.middleRows<3>(3 * s).transpose() * cell.W_inverse[sz(s)];
        least = std::min(least, T.determinant());
      }
    }
    return least;
  }

  /// Inverse of the diagonal of sum w |W^-T grad N_i|^2: the energy's stiffness at rest.
  [[nodiscard]] VecX inverse_diagonal() const {
    VecX diagonal = VecX::Zero(static_cast<Eigen::Index>(3 * free_count_));
    for (const CellData& cell : data_) {
      for (Eigen::Index s = 0; s < cell.basis.rows() / 3; ++s) {
        const MatX g = cell.W_inverse[sz(s)].transpose() * cell.basis.middleRows<3>(3 * s);
        for (Eigen::Index k = 0; k < g.cols(); ++k) {
          diagonal.segment<3>(3 * cell.free[sz(k)]).array() +=
              cell.weight[sz(s)] * g.col(k).squaredNorm();
        }
      }
    }
    return diagonal.cwiseMax(1e-300).cwiseInverse();
  }

 private:
  struct CellData {
    Shape shape = Shape::tetrahedron;
    int order = 1;
    Points base, straight;
    std::vector<Index> free;
    MatX dependence;  // nodes x free
    // Per sample s: rows 3s..3s+2 hold d/dxi of the free nodes' functions (basis) and of the fixed
    // part of x (offset); W_inverse of the straight element; weight.
    MatX basis, offset;
    std::vector<Mat3> W_inverse;
    std::vector<double> weight;
    double energy = 0.0;  // at the last evaluation
    MatX slope;           // and its derivative by the free nodes
  };

  static void evaluate_cell(CellData& cell, const VecX& x, double delta) {
    const MatX J = jacobians(cell, x);
    MatX stress(J.rows(), 3);
    cell.energy = 0.0;
    for (Eigen::Index s = 0; s < J.rows() / 3; ++s) {
      const Mat3& W_inverse = cell.W_inverse[sz(s)];
      const Mat3 T = J.middleRows<3>(3 * s).transpose() * W_inverse;
      const Distortion d = distortion(T, delta);
      cell.energy += cell.weight[sz(s)] * d.energy;
      stress.middleRows<3>(3 * s) = cell.weight[sz(s)] * W_inverse * d.gradient.transpose();
    }
    cell.slope.noalias() = cell.basis.transpose() * stress;
  }

  /// Transposed Jacobians of all samples, one below the other.
  [[nodiscard]] static MatX jacobians(const CellData& cell, const VecX& x) {
    const Eigen::Index n = static_cast<Eigen::Index>(cell.free.size());
    MatX local(n, 3);
    for (Eigen::Index k = 0; k < n; ++k)
      local.row(k) = x.segment<3>(3 * cell.free[sz(k)]).transpose();
    MatX J = cell.offset;
    J.noalias() += cell.basis * local;
    return J;
  }

  template <class Visit>
  void for_each_entity(Visit visit) {
    for (Index e : edges_) visit(curved_.edge_nodes(e));
    for (Index f : faces_) visit(curved_.face_nodes(f));
    for (Index c : insides_) visit(curved_.cell_nodes(c));
  }

  void add_cell(Index c, const Points& base, const std::vector<std::pair<Index, VecX>>& columns) {
    CellData cell;
    cell.shape = curved_.linear().cell_shape[at(c)];
    cell.order = curved_.cell_order(c);
    cell.base = base;
    curved_.gather_straight(c, cell.order, cell.straight);
    cell.dependence.resize(static_cast<Eigen::Index>(base.size()),
                           static_cast<Eigen::Index>(columns.size()));
    for (std::size_t k = 0; k < columns.size(); ++k) {
      cell.free.push_back(columns[k].first);
      cell.dependence.col(static_cast<Eigen::Index>(k)) = columns[k].second;
    }
    const Quadrature& rule = gauss(cell.shape, 2 * cell.order - 1);
    std::vector<double> weight = rule.weights;
    for (double& w : weight) w /= reference_measure(cell.shape);
    add_samples(cell, rule.points, weight);
    const std::span<const Vec3> points = lattice_xi(cell.shape, cell.order);
    weight.assign(points.size(), k_lattice_weight / static_cast<double>(points.size()));
    add_samples(cell, points, weight);
    data_.push_back(std::move(cell));
  }

  static void add_samples(CellData& cell, std::span<const Vec3> points,
                          std::span<const double> weights) {
    std::vector<Vec3> dN(cell.base.size());
    const Eigen::Index before = cell.offset.rows(), n = cell.dependence.cols();
    cell.basis.conservativeResize(before + 3 * static_cast<Eigen::Index>(points.size()), n);
    cell.offset.conservativeResize(cell.basis.rows(), 3);
    for (std::size_t i = 0; i < points.size(); ++i) {
      // The pyramid's map is singular in shape at the apex: sample just below it.
      Vec3 xi = points[i];
      if (cell.shape == Shape::pyramid && xi.z() > 1.0 - 1e-3) xi = Vec3(5e-4, 5e-4, 1.0 - 1e-3);
      lagrange_gradients(cell.shape, cell.order, xi, dN);
      const Eigen::Index row = before + 3 * static_cast<Eigen::Index>(i);
      Mat3 W = Mat3::Zero(), A = Mat3::Zero();
      cell.basis.middleRows<3>(row).setZero();
      for (std::size_t k = 0; k < dN.size(); ++k) {
        A += cell.base[k] * dN[k].transpose();
        W += cell.straight[k] * dN[k].transpose();
        cell.basis.middleRows<3>(row) += dN[k] * cell.dependence.row(static_cast<Eigen::Index>(k));
      }
      cell.offset.middleRows<3>(row) = A.transpose();
      cell.W_inverse.push_back(W.inverse());
      cell.weight.push_back(weights[i]);
    }
  }

  CurvedMesh& curved_;
  std::vector<Index> edges_, faces_, insides_, cells_;
  std::size_t free_count_ = 0;
  std::vector<CellData> data_;
};

/// Cells of the patch that are not certified, with where.
std::vector<std::pair<std::size_t, Vec3>> failing_cells(const CurvedMesh& curved,
                                                        const std::vector<Index>& cells) {
  std::vector<std::pair<std::size_t, Vec3>> failing;
  Points nodes;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    const Shape shape = curved.linear().cell_shape[at(cells[i])];
    const int p = curved.cell_order(cells[i]);
    curved.gather(cells[i], p, nodes);
    if (quick_verdict(shape, p, nodes) == Verdict::valid) continue;
    failing.emplace_back(i, certify(shape, p, nodes).worst_xi);
  }
  return failing;
}

/// Optimises from the nodes as they are; true if all cells came out certified, else the nodes are
/// put back.
/// @param allowance  evaluations of one cell that may still be spent; reduced by those made
bool repair(CurvedMesh& curved, Patch& patch, const UntangleOptions& options,
            std::size_t& allowance) {
  const VecX start = patch.positions();
  VecX x = start;
  const VecX scale = patch.inverse_diagonal();
  LbfgsOptions lbfgs;
  lbfgs.max_iterations = options.iterations_per_round;
  lbfgs.longest_step = k_longest_step;
  double least = patch.least_ratio(x), best = least;
  int since_best = 0;
  for (int round = 0; round < options.max_rounds && since_best < k_patience && allowance > 0;
       ++round) {
    // Wide at first, so that inverted samples see a slope; narrower each round, to push them
    // through zero.
    const double delta = least > 0.0 ? 0.0
                                     : std::max(k_least_delta, 0.3 * std::abs(least)) *
                                           std::pow(k_delta_shrink, round);
    const auto energy = [&](const VecX& y, VecX& g) {
      allowance -= std::min(allowance, patch.cells().size());
      return patch.evaluate(y, delta, g);
    };
    minimise_lbfgs(energy, x, scale, lbfgs, [&](const VecX&) { return allowance == 0; });
    least = patch.least_ratio(x);
    since_best = least > best + 0.05 * std::abs(best) ? 0 : since_best + 1;
    best = std::max(best, least);
    if (least <= 0.0 || (least < k_wanted_ratio && round == 0)) continue;
    patch.set_positions(x);
    const auto failing = failing_cells(curved, patch.cells());
    if (failing.empty()) return true;
    for (const auto& [i, xi] : failing) patch.add_sample(i, xi);
  }
  patch.set_positions(start);
  return false;
}

std::vector<Index> neighbours(const Topology& topology, const std::vector<Index>& cells) {
  std::vector<Index> grown = cells;
  for (Index c : cells) {
    for (Index e : topology.edges_of_cell(c)) {
      for (Index other : topology.cells_of_edge(e)) grown.push_back(other);
    }
  }
  make_sorted_set(grown);
  return grown;
}

/// Takes the displacement off the free entities of some cells.
void straighten(CurvedMesh& curved, const CurvedMesh& straight, const std::vector<Index>& cells,
                const FixedEntities& fixed) {
  const auto copy = [](std::span<const Vec3> from, std::span<Vec3> to) {
    std::copy(from.begin(), from.end(), to.begin());
  };
  for (Index c : cells) {
    for (Index e : curved.topology().edges_of_cell(c)) {
      if (!fixed.edge[at(e)]) copy(straight.edge_nodes(e), curved.edge_nodes(e));
    }
    for (Index f : curved.topology().faces_of_cell(c)) {
      if (!fixed.face[at(f)]) copy(straight.face_nodes(f), curved.face_nodes(f));
    }
    copy(straight.cell_nodes(c), curved.cell_nodes(c));
  }
}

/// Groups of cells connected through shared edges, by their lowest cell.
std::vector<std::vector<Index>> connected_groups(const Topology& topology,
                                                 const std::vector<Index>& cells) {
  std::vector<Index> parent(cells.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](Index i) {
    while (parent[at(i)] != i) i = parent[at(i)] = parent[at(parent[at(i)])];
    return i;
  };
  std::unordered_map<Index, Index> first_on_edge;
  for (Index i = 0; at(i) < cells.size(); ++i) {
    for (Index e : topology.edges_of_cell(cells[at(i)])) {
      const Index a = root(first_on_edge.emplace(e, i).first->second), b = root(i);
      parent[at(std::max(a, b))] = std::min(a, b);
    }
  }
  std::map<Index, std::vector<Index>> by_root;
  for (Index i = 0; at(i) < cells.size(); ++i) by_root[root(i)].push_back(cells[at(i)]);
  std::vector<std::vector<Index>> groups;
  for (auto& [first, group] : by_root) groups.push_back(std::move(group));
  return groups;
}

}  // namespace

FixedEntities boundary_entities(const Topology& topology) {
  FixedEntities fixed;
  fixed.edge.assign(topology.edge_count(), 0);
  fixed.face.assign(topology.face_count(), 0);
  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    if (!topology.is_boundary(f) && topology.face2patch_face[at(f)] == k_none) continue;
    fixed.face[at(f)] = 1;
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      fixed.edge[at(topology.face2edge[at(f)][static_cast<std::size_t>(i)])] = 1;
    }
  }
  return fixed;
}

std::vector<std::uint8_t> free_nodes(const CurvedMesh& curved) {
  const FixedEntities fixed = boundary_entities(curved.topology());
  std::vector<std::uint8_t> is_free(curved.high_order_node_count(), 1);
  const auto fix = [&](Index first, std::size_t count) {
    std::fill_n(is_free.begin() + first, count, std::uint8_t{0});
  };
  for (Index e = 0; at(e) < fixed.edge.size(); ++e) {
    if (fixed.edge[at(e)]) fix(curved.first_edge_node(e), curved.edge_nodes(e).size());
  }
  for (Index f = 0; at(f) < fixed.face.size(); ++f) {
    if (fixed.face[at(f)]) fix(curved.first_face_node(f), curved.face_nodes(f).size());
  }
  return is_free;
}

UntangleResult untangle(CurvedMesh& curved, const std::vector<Index>& uncertified,
                        const FixedEntities& fixed, const UntangleOptions& options) {
  UntangleResult result;
  std::optional<CurvedMesh> straight;
  for (const std::vector<Index>& group : connected_groups(curved.topology(), uncertified)) {
    ++result.patches;
    bool is_repaired = false;
    std::vector<Index> core = group;
    const std::size_t granted =
        std::min(options.evaluations_per_group,
                 options.evaluations - std::min(options.evaluations, result.evaluations));
    std::size_t allowance = granted;
    for (int ring = 0; ring < options.rings && !is_repaired && allowance > 0; ++ring) {
      core = neighbours(curved.topology(), core);
      Patch patch(curved, core, fixed);
      if (patch.free_count() == 0 || patch.cells().size() > options.max_cells) break;
      patch.build();
      is_repaired = repair(curved, patch, options, allowance);
      if (is_repaired) break;
      // A second start: the bad cells themselves straight. Flat cells tolerate little else.
      const VecX carried = patch.positions();
      if (!straight) straight.emplace(curved.linear(), curved.topology(), curved.orders());
      straighten(curved, *straight, group, fixed);
      is_repaired = repair(curved, patch, options, allowance);
      if (!is_repaired) patch.set_positions(carried);
    }
    result.evaluations += granted - allowance;
    if (is_repaired) {
      ++result.repaired;
    } else {
      result.still_bad.insert(result.still_bad.end(), group.begin(), group.end());
    }
  }
  std::sort(result.still_bad.begin(), result.still_bad.end());
  return result;
}

}  // namespace camber
