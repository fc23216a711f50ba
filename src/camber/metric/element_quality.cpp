#include <camber/base/parallel.hpp>
#include <camber/base/processor.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/basis/quadrature.hpp>
#include <camber/metric/cost.hpp>
#include <camber/metric/detail/cost_view.hpp>
#include <camber/metric/element_quality.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <vector>

namespace camber {

namespace {

// Highest order with a cached table.
constexpr int k_highest_order = 16;

// Gradients of the curved and of the straight basis at the survey points, stacked by direction.
struct SurveyTable {
  MatX curved;                   // (dim * points) x nodes
  MatX straight;                 // (dim * points) x corners of (shape, 1)
  std::vector<int> corner_node;  // node of order p at node n of order 1
  Eigen::Index points = 0;
  // The same by point, direction and node, for the kernels of volume elements.
  std::vector<double> by_point, straight_by_point;

  [[nodiscard]] detail::CostView view() const {
    return {static_cast<int>(curved.cols()), static_cast<int>(straight.cols()),
            static_cast<int>(points), by_point.data(), straight_by_point.data()};
  }
};

MatX stacked_gradients(Shape shape, int p, std::span<const Vec3> xi) {
  const Tabulation table = tabulate(shape, p, xi);
  const auto points = static_cast<Eigen::Index>(xi.size());
  MatX G(dimension(shape) * points, table.values.cols());
  for (int d = 0; d < dimension(shape); ++d) {
    G.middleRows(d * points, points) = table.gradient[static_cast<std::size_t>(d)];
  }
  return G;
}

std::vector<double> by_point(const MatX& stacked, Eigen::Index points) {
  std::vector<double> values;
  values.reserve(static_cast<std::size_t>(stacked.size()));
  for (Eigen::Index q = 0; q < points; ++q) {
    for (Eigen::Index d = 0; d * points < stacked.rows(); ++d) {
      for (Eigen::Index n = 0; n < stacked.cols(); ++n) {
        values.push_back(stacked(d * points + q, n));
      }
    }
  }
  return values;
}

SurveyTable make_table(Shape shape, int p) {
  const std::vector<Vec3>& xi = gauss(shape, 2 * p + 1).points;
  SurveyTable table;
  table.points = static_cast<Eigen::Index>(xi.size());
  table.curved = stacked_gradients(shape, p, xi);
  table.straight = stacked_gradients(shape, 1, xi);
  const std::vector<int>& corner = lattice_map(shape, p).corner;
  const std::vector<int>& linear_corner = lattice_map(shape, 1).corner;
  table.corner_node.resize(corner.size());
  for (std::size_t c = 0; c < corner.size(); ++c) {
    table.corner_node[static_cast<std::size_t>(linear_corner[c])] = corner[c];
  }
  if (dimension(shape) == 3) {
    table.by_point = by_point(table.curved, table.points);
    table.straight_by_point = by_point(table.straight, table.points);
  }
  return table;
}

const SurveyTable& survey_table(Shape shape, int p) {
  struct Slot {
    std::once_flag once;
    std::unique_ptr<const SurveyTable> table;
  };
  static std::array<std::array<Slot, k_highest_order + 1>, k_shape_count> slots;
  if (p < 1 || p > k_highest_order || dimension(shape) < 2) {
    throw std::invalid_argument("no cost of a " + std::string(name(shape)) + " of order " +
                                std::to_string(p));
  }
  Slot& slot = slots[static_cast<std::size_t>(shape)][static_cast<std::size_t>(p)];
  std::call_once(slot.once,
                 [&] { slot.table = std::make_unique<const SurveyTable>(make_table(shape, p)); });
  return *slot.table;
}

// Columns of dx/dxi in the plane they span: [|a|  a.b/|a| ; 0  |a x b|/|a|].
Mat<double, 2> in_own_plane(const Vec3& a, const Vec3& b) {
  const double length = a.norm();
  Mat<double, 2> M;
  M << length, a.dot(b) / length, 0.0, a.cross(b).norm() / length;
  return M;
}

double surface_cost(const Vec3& a1, const Vec3& a2, const Vec3& w1, const Vec3& w2) {
  const Vec3 n = a1.cross(a2), N = w1.cross(w2);
  if (!(N.norm() > 0.0)) return 0.0;
  const double tau = surface_normalized_jacobian<double>(n, N);
  if (tau <= 0.0) return tau;
  return cost(tau, weighted_condition_number<double, 2>(in_own_plane(a1, a2),
                                                        in_own_plane(w1, w2).inverse()));
}

void require_nodes(Shape shape, int p, const SurveyTable& table, std::size_t elements,
                   std::size_t nodes) {
  const auto each = static_cast<std::size_t>(table.curved.cols());
  if (nodes == elements * each) return;
  throw std::invalid_argument(std::string(name(shape)) + " of order " + std::to_string(p) +
                              " has " + std::to_string(each) + " nodes, not " +
                              std::to_string(nodes) + " for " + std::to_string(elements));
}

ElementCost face_cost(const SurveyTable& table, std::span<const Vec3> nodes) {
  // From a local origin, so that differences of close nodes keep their digits.
  Eigen::Matrix<double, Eigen::Dynamic, 3> x(table.curved.cols(), 3), X(table.straight.cols(), 3);
  for (Eigen::Index n = 0; n < x.rows(); ++n) {
    x.row(n) = (nodes[static_cast<std::size_t>(n)] - nodes[0]).transpose();
  }
  for (Eigen::Index n = 0; n < X.rows(); ++n) {
    X.row(n) = x.row(table.corner_node[static_cast<std::size_t>(n)]);
  }
  const Eigen::Matrix<double, Eigen::Dynamic, 3> dx = table.curved * x, dX = table.straight * X;

  ElementCost result;
  result.minimum = std::numeric_limits<double>::infinity();
  double sum = 0.0;
  const Eigen::Index points = table.points;
  for (Eigen::Index q = 0; q < points; ++q) {
    const double c = surface_cost(dx.row(q).transpose(), dx.row(points + q).transpose(),
                                  dX.row(q).transpose(), dX.row(points + q).transpose());
    sum += c;
    result.minimum = std::min(result.minimum, c);
  }
  result.average = sum / static_cast<double>(points);
  return result;
}

/// Costs of as many elements as the kernel has lanes.
void run_lanes(const SurveyTable& table, const detail::CostKernelChoice& kernel,
               std::span<const Vec3> nodes, std::span<ElementCost> costs) {
  const detail::CostView view = table.view();
  const auto lanes = static_cast<std::size_t>(kernel.lanes);
  const auto n = static_cast<std::size_t>(view.nodes), m = static_cast<std::size_t>(view.corners);
  // On the boundary that the widest vectors want.
  constexpr std::size_t k_line = 8;
  thread_local std::vector<double> storage;
  storage.resize((3 * n + 3 * m + 2) * lanes + k_line);
  double* x = storage.data();
  while (reinterpret_cast<std::uintptr_t>(x) % (k_line * sizeof(double)) != 0) ++x;
  double *corners = x + 3 * n * lanes, *minimum = corners + 3 * m * lanes, *sum = minimum + lanes;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const std::span<const Vec3> own = nodes.subspan(lane * n, n);
    // From a local origin, so that differences of close nodes keep their digits.
    for (std::size_t k = 0; k < n; ++k) {
      const Vec3 place = own[k] - own[0];
      for (std::size_t d = 0; d < 3; ++d) {
        x[(d * n + k) * lanes + lane] = place[static_cast<Eigen::Index>(d)];
      }
    }
    for (std::size_t k = 0; k < m; ++k) {
      const auto node = static_cast<std::size_t>(table.corner_node[k]);
      for (std::size_t d = 0; d < 3; ++d) {
        corners[(d * m + k) * lanes + lane] = x[(d * n + node) * lanes + lane];
      }
    }
  }
  kernel.run(view, x, corners, minimum, sum);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    costs[lane] = {minimum[lane], sum[lane] / static_cast<double>(view.points)};
  }
}

}  // namespace

ElementCost element_cost(Shape shape, int p, std::span<const Vec3> nodes) {
  const SurveyTable& table = survey_table(shape, p);
  require_nodes(shape, p, table, 1, nodes.size());
  if (dimension(shape) == 2) return face_cost(table, nodes);
  ElementCost result;
  run_lanes(table, detail::cost_kernel_of(1), nodes, {&result, 1});
  return result;
}

void element_costs(Shape shape, int p, std::span<const Vec3> nodes, std::span<ElementCost> costs) {
  const SurveyTable& table = survey_table(shape, p);
  require_nodes(shape, p, table, costs.size(), nodes.size());
  if (dimension(shape) != 3) {
    throw std::invalid_argument(std::string(name(shape)) + " is no volume element");
  }
  static const detail::CostKernelChoice widest = detail::cost_kernel_of(widest_lanes());
  const auto each = static_cast<std::size_t>(table.curved.cols());
  for (std::size_t i = 0; i < costs.size();) {
    const bool fills = i + static_cast<std::size_t>(widest.lanes) <= costs.size();
    const detail::CostKernelChoice kernel = fills ? widest : detail::cost_kernel_of(1);
    const auto lanes = static_cast<std::size_t>(kernel.lanes);
    run_lanes(table, kernel, nodes.subspan(i * each, lanes * each), costs.subspan(i, lanes));
    i += lanes;
  }
}

std::vector<double> lowest_costs(std::size_t n, const GatherElement& gather) {
  std::vector<double> lowest(n, 1.0);
  // Elements gathered before they are sorted into lanes.
  constexpr std::size_t k_chunk = 128;
  struct Bin {
    std::vector<std::size_t> elements;
    Points nodes;
  };
  parallel_for(n, k_chunk, [&](std::size_t begin, std::size_t end) {
    std::map<std::pair<Shape, int>, Bin> bins;
    Points one;
    for (std::size_t i = begin; i < end; ++i) {
      const std::pair<Shape, int> kind = gather(i, one);
      if (kind.second == 1) continue;
      Bin& bin = bins[kind];
      bin.elements.push_back(i);
      bin.nodes.insert(bin.nodes.end(), one.begin(), one.end());
    }
    std::vector<ElementCost> costs;
    for (const auto& [kind, bin] : bins) {
      costs.resize(bin.elements.size());
      element_costs(kind.first, kind.second, bin.nodes, costs);
      for (std::size_t k = 0; k < costs.size(); ++k) lowest[bin.elements[k]] = costs[k].minimum;
    }
  });
  return lowest;
}

}  // namespace camber
