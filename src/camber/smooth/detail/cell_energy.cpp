#include <camber/base/parallel.hpp>
#include <camber/base/processor.hpp>
#include <camber/base/sorted_set.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/smooth/detail/cell_energy.hpp>
#include <camber/smooth/distortion.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <unordered_map>

namespace camber::detail {
namespace {

constexpr std::size_t k_batches_per_task = 2;

/// Nodes nearer than this share of the spacing along a thin cell are tied across it.
constexpr double k_tied = 0.3;
/// A cell is thin where its smallest stretch is below this share of the middle one.
constexpr double k_thin = 0.3;

}  // namespace

CellEnergy::CellEnergy(const CurvedMesh& curved, const std::vector<Index>& cells,
                       const std::vector<std::uint8_t>& is_free)
    : mesh_(curved.linear()), map_(curved, cells), lanes_(widest_lanes()) {
  const Index vertex_total = static_cast<Index>(mesh_.vertices.size());
  std::vector<Index> used;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    order_.push_back(curved.cell_order(cells[i]));
    for (std::size_t n = 0; n < map_.node_total(i); ++n) {
      for (const NodeMap::Entry& e : map_.row(i, n)) used.push_back(e.column);
    }
  }
  make_sorted_set(used);
  columns_.resize(used.size());
  for (std::size_t k = 0; k < used.size(); ++k) {
    if (used[k] < vertex_total) {
      columns_[k].fixed = mesh_.vertices[at(used[k])];
      continue;
    }
    const Index node = used[k] - vertex_total;
    columns_[k].fixed = curved.high_order_nodes()[at(node)];
    if (!is_free[at(node)]) continue;
    columns_[k].unknown = static_cast<Index>(unknowns_.size());
    unknowns_.push_back(node);
  }

  row_offset_.push_back(0);
  std::vector<std::size_t> count(unknowns_.size() + 1, 0);
  for (std::size_t i = 0; i < cells.size(); ++i) {
    for (std::size_t n = 0; n < map_.node_total(i); ++n) {
      for (const NodeMap::Entry& e : map_.row(i, n)) {
        const Index column =
            static_cast<Index>(std::lower_bound(used.begin(), used.end(), e.column) - used.begin());
        column_of_.push_back(column);
        coefficient_.push_back(e.coefficient);
        if (columns_[at(column)].unknown != k_none) ++count[at(columns_[at(column)].unknown) + 1];
      }
      row_offset_.push_back(column_of_.size());
    }
  }
  unknown_offset_.resize(count.size());
  std::partial_sum(count.begin(), count.end(), unknown_offset_.begin());
  unknown_row_.resize(unknown_offset_.back());
  unknown_coefficient_.resize(unknown_offset_.back());
  std::vector<std::size_t> next = unknown_offset_;
  for (std::size_t row = 0; row + 1 < row_offset_.size(); ++row) {
    for (std::size_t k = row_offset_[row]; k < row_offset_[row + 1]; ++k) {
      const Index unknown = columns_[at(column_of_[k])].unknown;
      if (unknown == k_none) continue;
      unknown_row_[next[at(unknown)]] = row;
      unknown_coefficient_[next[at(unknown)]++] = coefficient_[k];
    }
  }

  std::map<std::pair<Shape, int>, std::vector<std::size_t>> by_kind;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    by_kind[{mesh_.cell_shape[at(cells[i])], order_[i]}].push_back(i);
  }
  for (const auto& [kind, members] : by_kind) {
    for (std::size_t first = 0; first < members.size(); first += at(lanes_)) {
      const std::size_t last = std::min(members.size(), first + at(lanes_));
      batches_.push_back({&energy_plan(kind.first, kind.second),
                          {members.begin() + static_cast<std::ptrdiff_t>(first),
                           members.begin() + static_cast<std::ptrdiff_t>(last)}});
    }
  }
  value_.resize(columns_.size());
  slope_.resize(map_.row_count());
  cell_energy_.assign(cells.size(), 0.0);
  cell_least_.assign(cells.size(), 0.0);
}

std::vector<Index> CellEnergy::unknowns_of(std::size_t i) const {
  std::vector<Index> own;
  const std::size_t first = map_.first_row(i), last = map_.first_row(i + 1);
  for (std::size_t k = row_offset_[first]; k < row_offset_[last]; ++k) {
    const Index unknown = columns_[at(column_of_[k])].unknown;
    if (unknown != k_none) own.push_back(unknown);
  }
  make_sorted_set(own);
  return own;
}

VecX CellEnergy::positions(const CurvedMesh& curved) const {
  VecX x(size());
  for (std::size_t k = 0; k < unknowns_.size(); ++k) {
    x.segment<3>(3 * static_cast<Eigen::Index>(k)) = curved.high_order_nodes()[at(unknowns_[k])];
  }
  return x;
}

void CellEnergy::store(const VecX& x, CurvedMesh& curved) const {
  for (std::size_t k = 0; k < unknowns_.size(); ++k) {
    curved.high_order_nodes()[at(unknowns_[k])] = x.segment<3>(3 * static_cast<Eigen::Index>(k));
  }
}

void CellEnergy::place_columns(const VecX& x, bool with_fixed) {
  for (std::size_t k = 0; k < columns_.size(); ++k) {
    const Index unknown = columns_[k].unknown;
    if (unknown != k_none) {
      value_[k] = x.segment<3>(3 * static_cast<Eigen::Index>(unknown));
    } else {
      value_[k] = with_fixed ? columns_[k].fixed : Vec3(Vec3::Zero());
    }
  }
}

Vec3 CellEnergy::node(std::size_t row) const {
  const std::size_t first = row_offset_[row], last = row_offset_[row + 1];
  if (last == first + 1 && coefficient_[first] == 1.0) return value_[at(column_of_[first])];
  Vec3 x = Vec3::Zero();
  for (std::size_t k = first; k < last; ++k) x += coefficient_[k] * value_[at(column_of_[k])];
  return x;
}

void CellEnergy::evaluate_batch(const Batch& batch, EnergyKind kind, double delta) {
  const EnergyPlan& plan = *batch.plan;
  const std::size_t lanes = batch.cells.size() == at(lanes_) ? at(lanes_) : 1;
  const std::size_t n = at(plan.nodes()), corners = plan.corner_nodes().size();
  thread_local std::vector<double> storage;
  // Room for nodes, slopes, corners and four results, on the boundary the widest vectors want.
  constexpr std::size_t k_line = 8;
  storage.resize((6 * n + 3 * corners + 3) * lanes + 2 * k_line);
  double* next = storage.data();
  while (reinterpret_cast<std::uintptr_t>(next) % (k_line * sizeof(double)) != 0) ++next;
  const auto take = [&](std::size_t size) {
    double* piece = next;
    next += size * lanes;
    return piece;
  };
  double *x = take(3 * n), *slope = take(3 * n), *X = take(3 * corners);
  double *deltas = take(1), *energy = take(1), *least = take(1);
  std::fill_n(deltas, lanes, delta);
  const EnergyKernel kernel = energy_kernel_of(static_cast<int>(lanes)).run;
  for (std::size_t start = 0; start < batch.cells.size(); start += lanes) {
    for (std::size_t l = 0; l < lanes; ++l) {
      const std::size_t i = batch.cells[start + l];
      const std::span<const Index> v = mesh_.cell(cells()[i]);
      const std::vector<int>& linear = lattice_map(plan.shape(), 1).corner;
      // From a corner of the cell, so that differences of close nodes keep their digits.
      const Vec3 origin = mesh_.vertices[at(v[0])];
      const Vec3 shift = kind == EnergyKind::metric ? Vec3(Vec3::Zero()) : origin;
      for (std::size_t c = 0; c < corners; ++c) {
        const Vec3 p = mesh_.vertices[at(v[c])] - origin;
        for (std::size_t d = 0; d < 3; ++d) {
          X[(d * corners + at(linear[c])) * lanes + l] = p[static_cast<Eigen::Index>(d)];
        }
      }
      for (std::size_t k = 0; k < n; ++k) {
        const Vec3 p = node(map_.first_row(i) + k) - shift;
        for (std::size_t d = 0; d < 3; ++d) {
          x[(d * n + k) * lanes + l] = p[static_cast<Eigen::Index>(d)];
        }
      }
    }
    kernel(kind, plan.view(), x, X, deltas, slope, energy, least);
    for (std::size_t l = 0; l < lanes; ++l) {
      const std::size_t i = batch.cells[start + l];
      cell_energy_[i] = energy[l];
      cell_least_[i] = least[l];
      for (std::size_t k = 0; k < n; ++k) {
        slope_[map_.first_row(i) + k] =
            Vec3(slope[k * lanes + l], slope[(n + k) * lanes + l], slope[(2 * n + k) * lanes + l]);
      }
    }
  }
}

void CellEnergy::add_sample(std::size_t i, const Vec3& xi) {
  const Shape shape = mesh_.cell_shape[at(cells()[i])];
  const std::size_t n = map_.node_total(i);
  std::vector<Vec3> dN(n), linear(at(corner_count(shape)));
  lagrange_gradients(shape, order_[i], xi, dN);
  lagrange_gradients(shape, 1, xi, linear);
  Extra extra{i, MatX(static_cast<Eigen::Index>(n), 3), Mat3::Zero()};
  for (std::size_t k = 0; k < n; ++k) extra.gradient.row(static_cast<Eigen::Index>(k)) = dN[k];
  Mat3 W = Mat3::Zero();
  const std::span<const Index> v = mesh_.cell(cells()[i]);
  for (std::size_t c = 0; c < v.size(); ++c) {
    W += mesh_.vertices[at(v[c])] * linear[at(lattice_map(shape, 1).corner[c])].transpose();
  }
  extra.W_inverse = W.inverse();
  extras_.push_back(std::move(extra));
}

double CellEnergy::evaluate_extra(const Extra& extra, double delta, double& least) {
  const std::size_t first = map_.first_row(extra.cell);
  Mat3 A = Mat3::Zero();
  for (Eigen::Index k = 0; k < extra.gradient.rows(); ++k) {
    A += node(first + static_cast<std::size_t>(k)) * extra.gradient.row(k);
  }
  const Mat3 T = A * extra.W_inverse;
  least = std::min(least, T.determinant());
  const Distortion d = distortion(T, delta);
  const Mat3 stress = d.gradient * extra.W_inverse.transpose();
  for (Eigen::Index k = 0; k < extra.gradient.rows(); ++k) {
    slope_[first + static_cast<std::size_t>(k)] += stress * extra.gradient.row(k).transpose();
  }
  return d.energy;
}

void CellEnergy::gather_gradient(VecX& gradient) const {
  gradient.resize(size());
  parallel_for(unknowns_.size(), 512, [&](std::size_t begin, std::size_t end) {
    for (std::size_t u = begin; u < end; ++u) {
      Vec3 sum = Vec3::Zero();
      for (std::size_t k = unknown_offset_[u]; k < unknown_offset_[u + 1]; ++k) {
        sum += unknown_coefficient_[k] * slope_[unknown_row_[k]];
      }
      gradient.segment<3>(3 * static_cast<Eigen::Index>(u)) = sum;
    }
  });
}

double CellEnergy::evaluate(EnergyKind kind, const VecX& x, double delta, VecX& gradient,
                            double* least) {
  place_columns(x, true);
  parallel_for(batches_.size(), k_batches_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) evaluate_batch(batches_[b], kind, delta);
  });
  double energy = 0.0, smallest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < cell_energy_.size(); ++i) {
    energy += cell_energy_[i];
    smallest = std::min(smallest, cell_least_[i]);
  }
  if (kind == EnergyKind::shape) {
    for (const Extra& extra : extras_) energy += evaluate_extra(extra, delta, smallest);
  }
  if (least) *least = smallest;
  gather_gradient(gradient);
  return std::isfinite(energy) ? energy : std::numeric_limits<double>::infinity();
}

void CellEnergy::apply_stiffness(const VecX& v, VecX& result) {
  place_columns(v, false);
  parallel_for(batches_.size(), k_batches_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      evaluate_batch(batches_[b], EnergyKind::metric, 0.0);
    }
  });
  gather_gradient(result);
  result *= 0.5;  // the slope of |T|^2 is twice its stiffness
}

VecX CellEnergy::load(const CurvedMesh& curved, const CurvedMesh& straight) {
  for (std::size_t k = 0; k < columns_.size(); ++k) value_[k].setZero();
  const Index vertex_total = static_cast<Index>(mesh_.vertices.size());
  // Columns are sorted by what is stored, vertices first: walk the map to find their numbers.
  std::vector<std::uint8_t> is_seen(columns_.size(), 0);
  std::size_t entry = 0;
  for (std::size_t i = 0; i < cells().size(); ++i) {
    for (std::size_t n = 0; n < map_.node_total(i); ++n) {
      for (const NodeMap::Entry& e : map_.row(i, n)) {
        const std::size_t k = at(column_of_[entry++]);
        if (is_seen[k] || columns_[k].unknown != k_none || e.column < vertex_total) continue;
        is_seen[k] = 1;
        const std::size_t node = at(e.column - vertex_total);
        value_[k] = curved.high_order_nodes()[node] - straight.high_order_nodes()[node];
      }
    }
  }
  parallel_for(batches_.size(), k_batches_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t b = begin; b < end; ++b) {
      evaluate_batch(batches_[b], EnergyKind::metric, 0.0);
    }
  });
  VecX result;
  gather_gradient(result);
  return -0.5 * result;
}

std::vector<std::vector<Index>> CellEnergy::thin_groups() const {
  std::vector<Index> parent(unknowns_.size());
  std::iota(parent.begin(), parent.end(), 0);
  const auto root = [&](Index i) {
    while (parent[at(i)] != i) i = parent[at(i)] = parent[at(parent[at(i)])];
    return i;
  };
  for (std::size_t i = 0; i < cells().size(); ++i) {
    const Shape shape = mesh_.cell_shape[at(cells()[i])];
    const std::span<const Index> v = mesh_.cell(cells()[i]);
    std::array<Vec3, 8> corner;
    for (std::size_t c = 0; c < v.size(); ++c) corner[c] = mesh_.vertices[at(v[c])];
    const std::span<const Vec3> corners(corner.data(), v.size());
    const Points straight = straight_nodes(shape, order_[i], corners);
    const Mat3 W = jacobian(shape, 1, straight_nodes(shape, 1, corners), reference_centroid(shape));
    const Vec3 stretch = Eigen::JacobiSVD<Mat3>(W).singularValues();
    if (stretch[2] > k_thin * stretch[1]) continue;
    const double near = k_tied * stretch[1] / order_[i];
    for (std::size_t a = 0; a < straight.size(); ++a) {
      const Index ua = sole_unknown(map_.first_row(i) + a);
      if (ua == k_none) continue;
      for (std::size_t b = 0; b < a; ++b) {
        if ((straight[a] - straight[b]).squaredNorm() > near * near) continue;
        const Index ub = sole_unknown(map_.first_row(i) + b);
        if (ub == k_none) continue;
        const Index ra = root(ua), rb = root(ub);
        parent[at(std::max(ra, rb))] = std::min(ra, rb);
      }
    }
  }
  std::vector<std::vector<Index>> groups;
  std::vector<Index> group_of(unknowns_.size(), k_none);
  for (Index u = 0; at(u) < unknowns_.size(); ++u) {
    const Index r = root(u);
    if (group_of[at(r)] == k_none) {
      group_of[at(r)] = static_cast<Index>(groups.size());
      groups.emplace_back();
    }
    groups[at(group_of[at(r)])].push_back(u);
  }
  return groups;
}

Index CellEnergy::sole_unknown(std::size_t row) const {
  if (row_offset_[row + 1] != row_offset_[row] + 1) return k_none;
  return columns_[at(column_of_[row_offset_[row]])].unknown;
}

std::vector<MatX> CellEnergy::diagonal_blocks(const std::vector<std::vector<Index>>& groups) {
  std::vector<Index> group_of(unknowns_.size()), place(unknowns_.size());
  std::vector<MatX> blocks;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const auto n = static_cast<Eigen::Index>(groups[g].size());
    blocks.push_back(MatX::Zero(n, n));
    for (std::size_t k = 0; k < groups[g].size(); ++k) {
      group_of[at(groups[g][k])] = static_cast<Index>(g);
      place[at(groups[g][k])] = static_cast<Index>(k);
    }
  }
  struct Part {  // of one cell
    Index row, column;
    int pair;  // of its batch
    double value;
  };
  std::vector<std::vector<Part>> parts(cells().size());
  struct Room {
    std::vector<double> values;
    std::vector<int> number, pairs;  // [a][b] -> number of the pair, and back
  };
  const auto add_lanes = [&](const EnergyPlan& plan, std::span<const std::size_t> own, Room& room) {
    const EnergyView view = plan.view();
    const std::size_t n = at(view.nodes), lanes = own.size(), corners = at(view.corners);
    room.number.assign(n * n, -1);
    room.pairs.clear();
    struct Entry {
      Index unknown;
      std::size_t node;
      double coefficient;
    };
    std::vector<Entry> entries;
    for (std::size_t i : own) {
      entries.clear();
      for (std::size_t k = 0; k < n; ++k) {
        const std::size_t row = map_.first_row(i) + k;
        for (std::size_t e = row_offset_[row]; e < row_offset_[row + 1]; ++e) {
          const Index unknown = columns_[at(column_of_[e])].unknown;
          if (unknown != k_none) entries.push_back({unknown, k, coefficient_[e]});
        }
      }
      for (std::size_t a = 0; a < entries.size(); ++a) {
        for (std::size_t b = 0; b <= a; ++b) {
          if (group_of[at(entries[a].unknown)] != group_of[at(entries[b].unknown)]) continue;
          int& number = room.number[entries[a].node * n + entries[b].node];
          if (number < 0) {
            number = static_cast<int>(room.pairs.size() / 2);
            room.pairs.push_back(static_cast<int>(entries[a].node));
            room.pairs.push_back(static_cast<int>(entries[b].node));
          }
          parts[i].push_back(
              {entries[a].unknown, entries[b].unknown, number,
               (a == b ? 0.5 : 1.0) * entries[a].coefficient * entries[b].coefficient});
        }
      }
    }
    // On the boundary the widest vectors want.
    constexpr std::size_t k_line = 8;
    const std::size_t pair_count = room.pairs.size() / 2;
    room.values.resize((3 * corners + 3 * n + pair_count) * lanes + k_line);
    double* corner = room.values.data();
    while (reinterpret_cast<std::uintptr_t>(corner) % (k_line * sizeof(double)) != 0) ++corner;
    double *const slopes = corner + 3 * corners * lanes, *const sums = slopes + 3 * n * lanes;
    for (std::size_t l = 0; l < lanes; ++l) {
      const std::span<const Index> v = mesh_.cell(cells()[own[l]]);
      for (std::size_t c = 0; c < corners; ++c) {
        const Vec3 x = mesh_.vertices[at(v[c])] - mesh_.vertices[at(v[0])];
        for (std::size_t d = 0; d < 3; ++d) {
          corner[(d * corners + c) * lanes + l] = x[static_cast<Eigen::Index>(d)];
        }
      }
    }
    energy_kernel_of(static_cast<int>(lanes))
        .stiffness(view, corner, lattice_map(plan.shape(), 1).corner.data(), room.pairs.data(),
                   static_cast<int>(pair_count), slopes, sums);
    for (std::size_t l = 0; l < lanes; ++l) {
      for (Part& part : parts[own[l]]) part.value *= sums[at(part.pair) * lanes + l];
    }
  };
  parallel_for(batches_.size(), k_batches_per_task, [&](std::size_t begin, std::size_t end) {
    Room room;
    for (std::size_t b = begin; b < end; ++b) {
      const std::span<const std::size_t> all = batches_[b].cells;
      const std::size_t lanes = all.size() == at(lanes_) ? all.size() : 1;
      for (std::size_t i = 0; i < all.size(); i += lanes) {
        add_lanes(*batches_[b].plan, all.subspan(i, lanes), room);
      }
    }
  });
  // Cells one after the other, so that the sums have one order.
  for (const std::vector<Part>& cell : parts) {
    for (const Part& part : cell) {
      MatX& block = blocks[at(group_of[at(part.row)])];
      block(place[at(part.row)], place[at(part.column)]) += part.value;
      block(place[at(part.column)], place[at(part.row)]) += part.value;
    }
  }
  return blocks;
}

}  // namespace camber::detail
