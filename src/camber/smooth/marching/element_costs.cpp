#include <camber/basis/lagrange.hpp>
#include <camber/smooth/marching/element_costs.hpp>
#include <camber/smooth/marching/sub_simplices.hpp>

#include <memory>
#include <mutex>
#include <type_traits>

namespace camber {
namespace {

template <int d>
SimplexCorners<double, d> corners_of(const SubSimplex& s, std::span<const Vec3> nodes) {
  SimplexCorners<double, d> x;
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = nodes[at(s[k])];
  return x;
}

/// A variable for every coordinate of every corner: number 3 k + r for coordinate r of corner k.
template <int d>
using CornerDual = Dual<3 * (d + 1)>;

template <int d>
SimplexCorners<CornerDual<d>, d> variables(const SimplexCorners<double, d>& x) {
  SimplexCorners<CornerDual<d>, d> v;
  for (int k = 0; k <= d; ++k) {
    for (int r = 0; r < 3; ++r) {
      v[at(k)](r) = CornerDual<d>::variable(x[at(k)](r), 3 * k + r);
    }
  }
  return v;
}

/// Where the polynomial is looked at: the lattice of order 2^L p, which holds the lattices of order
/// 2^L of all sub-simplices.
struct Survey {
  Tabulation curved, straight;               // gradients of order p, and of order 1 (corners)
  std::vector<int> corner_node;              // node of order p at node n of order 1
  std::vector<std::vector<int>> of_simplex;  // points of each sub-simplex
};

Survey make_survey(Shape shape, int p, int level) {
  const int parts = 1 << level, q = p * parts;
  Survey survey;
  survey.curved = tabulate(shape, p, lattice_xi(shape, q));
  survey.straight = tabulate(shape, 1, lattice_xi(shape, q));
  const std::vector<int>&corner = lattice_map(shape, p).corner,
        &linear = lattice_map(shape, 1).corner;
  survey.corner_node.resize(corner.size());
  for (std::size_t c = 0; c < corner.size(); ++c) survey.corner_node[at(linear[c])] = corner[c];
  const std::span<const LatticePoint> nodes = lattice(shape, p);
  const Shape simplex = dimension(shape) == 3 ? Shape::tetrahedron : Shape::triangle;
  for (const SubSimplex& s : sub_simplices(shape, p)) {
    std::vector<int> points;
    for (const LatticePoint& a : lattice(simplex, parts)) {
      const std::array<int, 4> weight{parts - a[0] - a[1] - a[2], a[0], a[1], a[2]};
      LatticePoint point{0, 0, 0};
      for (std::size_t k = 0; k < 4 && s[k] >= 0; ++k) {
        for (std::size_t r = 0; r < 3; ++r) point[r] += weight[k] * nodes[at(s[k])][r];
      }
      points.push_back(lattice_index(shape, q, point));
    }
    survey.of_simplex.push_back(std::move(points));
  }
  return survey;
}

const Survey& survey_of(Shape shape, int p, int level) {
  struct Slot {
    std::once_flag once;
    std::unique_ptr<const Survey> survey;
  };
  static std::array<std::array<std::array<Slot, k_max_level + 1>, k_max_tested_order + 1>,
                    k_shape_count>
      slots;
  Slot& slot = slots[static_cast<std::size_t>(shape)][at(p)][at(level)];
  std::call_once(slot.once, [&] {
    slot.survey = std::make_unique<const Survey>(make_survey(shape, p, level));
  });
  return *slot.survey;
}

/// dx/dxi, eq. (3), at every survey point: column c along reference direction c.
template <int d>
using Jacobian = Eigen::Matrix<double, 3, d>;

template <int d>
std::vector<Jacobian<d>> jacobians(const Tabulation& table, std::span<const Vec3> nodes,
                                   const std::vector<int>* choice = nullptr) {
  const Eigen::Index count = table.values.cols();
  Eigen::Matrix<double, Eigen::Dynamic, 3> x(count, 3);
  for (Eigen::Index n = 0; n < count; ++n) {
    const std::size_t node =
        choice ? at((*choice)[static_cast<std::size_t>(n)]) : static_cast<std::size_t>(n);
    x.row(n) = (nodes[node] - nodes[0]).transpose();  // close nodes keep their digits
  }
  std::vector<Jacobian<d>> J(static_cast<std::size_t>(table.values.rows()));
  for (int c = 0; c < d; ++c) {
    const Eigen::Matrix<double, Eigen::Dynamic, 3> column = table.gradient[at(c)] * x;
    for (std::size_t q = 0; q < J.size(); ++q) {
      J[q].col(c) = column.row(static_cast<Eigen::Index>(q)).transpose();
    }
  }
  return J;
}

/// Normalised Jacobian at a survey point, and its derivatives by the entries of dx/dxi: the same
/// for all sub-simplices that share the point.
template <int d>
struct PointRatio {
  double tau = 1.0;
  Jacobian<d> slope = Jacobian<d>::Zero();
};

template <int d>
using EntryDual = Dual<3 * d>;  // number 3 c + r for row r of column c

EntryDual<3> ratio(const Eigen::Matrix<EntryDual<3>, 3, 3>& A, const Jacobian<3>& W) {
  return normalized_jacobian<EntryDual<3>, 3>(A, W.inverse());
}
EntryDual<2> ratio(const Eigen::Matrix<EntryDual<2>, 3, 2>& A, const Jacobian<2>& W) {
  return surface_normalized_jacobian<EntryDual<2>>(cross_product<EntryDual<2>>(A.col(0), A.col(1)),
                                                   W.col(0).cross(W.col(1)));
}

template <int d>
PointRatio<d> point_ratio(const Jacobian<d>& J, const Jacobian<d>& W) {
  Eigen::Matrix<EntryDual<d>, 3, d> A;
  for (int c = 0; c < d; ++c) {
    for (int r = 0; r < 3; ++r) A(r, c) = EntryDual<d>::variable(J(r, c), 3 * c + r);
  }
  const EntryDual<d> tau = ratio(A, W);
  PointRatio<d> result;
  result.tau = tau.v;
  for (int c = 0; c < d; ++c) {
    for (int r = 0; r < 3; ++r) result.slope(r, c) = tau.d[at(3 * c + r)];
  }
  return result;
}

/// The same as a function of the corners of a sub-simplex: dx/dxi = sum_k x_k (dN_k/dxi)^T + rest.
template <int d>
CornerDual<d> by_corners(const PointRatio<d>& point, const Survey& survey, int row,
                         const SubSimplex& s) {
  CornerDual<d> tau(point.tau);
  for (int k = 0; k <= d; ++k) {
    Vec3 slope = Vec3::Zero();
    for (int c = 0; c < d; ++c) {
      slope += survey.curved.gradient[at(c)](row, s[at(k)]) * point.slope.col(c);
    }
    for (int r = 0; r < 3; ++r) tau.d[at(3 * k + r)] = slope(r);
  }
  return tau;
}

/// Costs of one sub-triangle: derivatives by its corners all the way.
class Triangle {
 public:
  Triangle(const SimplexCorners<double, 2>& x, const SimplexCorners<double, 2>& X)
      : ideal_(ideal_simplex(X)), v_(variables<2>(x)) {}

  /// Level 0.
  [[nodiscard]] CornerDual<2> cost() const { return cost(sub_normalized_jacobian(v_, ideal_)); }
  [[nodiscard]] CornerDual<2> cost(const CornerDual<2>& tau) const {
    return tau.v <= 0.0 ? tau : camber::cost(tau, sub_condition_number(v_, ideal_));
  }

 private:
  IdealSimplex<2> ideal_;
  SimplexCorners<CornerDual<2>, 2> v_;
};

/// Costs of one sub-tetrahedron: they depend on its corners through S = A W^-1 alone, so the nine
/// entries of S are the variables, and the (linear) rest of the chain is applied to the result.
class Tetrahedron {
 public:
  Tetrahedron(const SimplexCorners<double, 3>& x, const SimplexCorners<double, 3>& X)
      : ideal_(ideal_simplex(X)) {
    const Mat3 S = sub_map(x, ideal_);
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) S_(r, c) = Dual<9>::variable(S(r, c), 3 * c + r);
    }
  }

  /// Level 0.
  [[nodiscard]] CornerDual<3> cost() const {
    const Dual<9> tau = S_.determinant();
    return by_corners(tau.v <= 0.0 ? tau : camber::cost(tau, condition_number<Dual<9>, 3>(S_)));
  }
  [[nodiscard]] CornerDual<3> cost(const CornerDual<3>& tau) const {
    if (tau.v <= 0.0) return tau;
    return camber::cost(tau, by_corners(condition_number<Dual<9>, 3>(S_)));
  }

 private:
  /// S = A W^-1, A = [x1 - x0, x2 - x0, x3 - x0].
  [[nodiscard]] CornerDual<3> by_corners(const Dual<9>& f) const {
    const Mat3 by_S = Eigen::Map<const Mat3>(f.d.data());
    const Mat3 by_A = by_S * ideal_.W_inverse.transpose();
    CornerDual<3> result(f.v);
    for (int r = 0; r < 3; ++r) {
      for (int c = 0; c < 3; ++c) {
        result.d[at(3 * (c + 1) + r)] = by_A(r, c);
        result.d[at(r)] -= by_A(r, c);
      }
    }
    return result;
  }

  IdealSimplex<3> ideal_;
  Mat<Dual<9>, 3> S_;
};

template <int d>
SubCost<d> unpacked(const CornerDual<d>& cost) {
  SubCost<d> result;
  result.cost = cost.v;
  for (int k = 0; k <= d; ++k) {
    result.slope[at(k)] = Vec3(cost.d[at(3 * k)], cost.d[at(3 * k + 1)], cost.d[at(3 * k + 2)]);
  }
  return result;
}

}  // namespace

template <int d>
void element_costs(Shape shape, int p, std::span<const Vec3> x, std::span<const Vec3> X, int level,
                   std::vector<SubCost<d>>& costs) {
  const std::span<const SubSimplex> simplices = sub_simplices(shape, p);
  costs.resize(simplices.size());
  std::vector<PointRatio<d>> ratios;
  const Survey* survey = nullptr;
  if (level > 0) {
    survey = &survey_of(shape, p, level);
    const std::vector<Jacobian<d>> A = jacobians<d>(survey->curved, x);
    const std::vector<Jacobian<d>> W = jacobians<d>(survey->straight, X, &survey->corner_node);
    for (std::size_t q = 0; q < A.size(); ++q) ratios.push_back(point_ratio<d>(A[q], W[q]));
  }
  std::vector<CornerDual<d>> at_points;
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    const SubSimplex& s = simplices[i];
    const std::conditional_t<d == 2, Triangle, Tetrahedron> simplex(corners_of<d>(s, x),
                                                                    corners_of<d>(s, X));
    if (level == 0) {
      costs[i] = unpacked<d>(simplex.cost());
      continue;
    }
    at_points.clear();
    for (int point : survey->of_simplex[i]) {
      at_points.push_back(by_corners<d>(ratios[at(point)], *survey, point, s));
    }
    costs[i] = unpacked<d>(simplex.cost(biased_jacobian<CornerDual<d>>(at_points)));
  }
}

template <int d>
void inscribed_radii(Shape shape, int p, std::span<const Vec3> X, std::vector<double>& radii) {
  const std::span<const SubSimplex> simplices = sub_simplices(shape, p);
  radii.resize(simplices.size());
  for (std::size_t i = 0; i < simplices.size(); ++i) {
    radii[i] = ideal_simplex(corners_of<d>(simplices[i], X)).inscribed_radius;
  }
}

template void element_costs<2>(Shape, int, std::span<const Vec3>, std::span<const Vec3>, int,
                               std::vector<SubCost<2>>&);
template void element_costs<3>(Shape, int, std::span<const Vec3>, std::span<const Vec3>, int,
                               std::vector<SubCost<3>>&);
template void inscribed_radii<2>(Shape, int, std::span<const Vec3>, std::vector<double>&);
template void inscribed_radii<3>(Shape, int, std::span<const Vec3>, std::vector<double>&);

}  // namespace camber
