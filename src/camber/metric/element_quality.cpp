#include <camber/basis/lagrange.hpp>
#include <camber/basis/quadrature.hpp>
#include <camber/metric/cost.hpp>
#include <camber/metric/element_quality.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>

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

double volume_cost(const Mat3& A, const Mat3& W) {
  if (!(W.determinant() > 0.0)) return 0.0;  // no ideal to compare with
  return cost<double, 3>(A, W.inverse());
}

double surface_cost(const Vec3& a1, const Vec3& a2, const Vec3& w1, const Vec3& w2) {
  const Vec3 n = a1.cross(a2), N = w1.cross(w2);
  if (!(N.norm() > 0.0)) return 0.0;
  const double tau = surface_normalized_jacobian<double>(n, N);
  if (tau <= 0.0) return tau;
  return cost(tau, weighted_condition_number<double, 2>(in_own_plane(a1, a2),
                                                        in_own_plane(w1, w2).inverse()));
}

}  // namespace

ElementCost element_cost(Shape shape, int p, std::span<const Vec3> nodes) {
  const SurveyTable& table = survey_table(shape, p);
  if (static_cast<Eigen::Index>(nodes.size()) != table.curved.cols()) {
    throw std::invalid_argument(std::string(name(shape)) + " of order " + std::to_string(p) +
                                " has " + std::to_string(table.curved.cols()) + " nodes, not " +
                                std::to_string(nodes.size()));
  }
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
    double c = 0.0;
    if (dimension(shape) == 3) {
      Mat3 A, W;
      for (Eigen::Index d = 0; d < 3; ++d) {
        A.col(d) = dx.row(d * points + q).transpose();
        W.col(d) = dX.row(d * points + q).transpose();
      }
      c = volume_cost(A, W);
    } else {
      c = surface_cost(dx.row(q).transpose(), dx.row(points + q).transpose(), dX.row(q).transpose(),
                       dX.row(points + q).transpose());
    }
    sum += c;
    result.minimum = std::min(result.minimum, c);
  }
  result.average = sum / static_cast<double>(points);
  return result;
}

}  // namespace camber
