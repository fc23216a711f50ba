#include <camber/basis/lagrange.hpp>
#include <camber/basis/quadrature.hpp>
#include <camber/metric/weight_matrix.hpp>
#include <camber/smooth/detail/surface_energy.hpp>
#include <camber/smooth/distortion.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace camber::detail {
namespace {

using Mat32 = Eigen::Matrix<double, 3, 2>;
using Mat2 = Eigen::Matrix2d;

/// Weight of all lattice samples of a face together, beside 1 for its Gauss points.
constexpr double k_lattice_weight = 0.1;

/// The straight Jacobian in an orthonormal frame of its own plane: a 2 x 2 matrix with the same
/// lengths, angles.
Mat2 in_own_plane(const Mat32& W) {
  const Vec3 e1 = W.col(0).normalized();
  const Vec3 e2 = (W.col(1) - W.col(1).dot(e1) * e1).normalized();
  Mat2 flat;
  flat << W.col(0).dot(e1), W.col(1).dot(e1), 0.0, W.col(1).dot(e2);
  return flat;
}

/// Length of the curved edge from corner i to the next one, as the chain of its nodes.
double edge_length(const SurfacePatch& patch, const SurfaceFace& face, std::size_t i) {
  const std::vector<int>& edge = lattice_map(face.shape, patch.order).edge[i];
  double length = 0.0;
  for (std::size_t k = 0; k + 1 < edge.size(); ++k) {
    length += (patch.nodes[at(face.nodes[static_cast<std::size_t>(edge[k + 1])])] -
               patch.nodes[at(face.nodes[static_cast<std::size_t>(edge[k])])])
                  .norm();
  }
  return length;
}

}  // namespace

SurfaceEnergy::SurfaceEnergy(const SurfacePatch& patch) {
  for (const SurfaceFace& face : patch.faces) faces_.push_back(sample(patch, face));
}

SurfaceEnergy::Face SurfaceEnergy::sample(const SurfacePatch& patch, const SurfaceFace& face) {
  const int order = patch.order;
  Face result{face.nodes, {}};
  const Quadrature& rule = gauss(face.shape, 2 * order);
  std::vector<Vec3> points = rule.points;
  std::vector<double> weights = rule.weights;
  for (double& w : weights) w /= reference_measure(face.shape);
  for (const Vec3& xi : lattice_xi(face.shape, 2 * order)) {
    points.push_back(xi);
    weights.push_back(k_lattice_weight / node_count(face.shape, 2 * order));
  }
  const bool is_triangle = face.shape == Shape::triangle;
  const std::size_t corner_total = is_triangle ? 3 : 4;
  Mat2 unrolled = Mat2::Zero();
  if (is_triangle) {
    unrolled = triangle_weight_matrix<double>(
        {edge_length(patch, face, 0), edge_length(patch, face, 2), edge_length(patch, face, 1)});
  }
  const bool is_unrolled = unrolled.determinant() > 0.0;
  std::vector<Vec3> dN(face.nodes.size());
  std::array<double, 4> N{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    lagrange_gradients(face.shape, order, points[i], dN);
    Sample s;
    Mat32 W = Mat32::Zero();
    s.gradient.resize(static_cast<Eigen::Index>(dN.size()), 2);
    for (std::size_t n = 0; n < dN.size(); ++n) {
      s.gradient.row(static_cast<Eigen::Index>(n)) = dN[n].head<2>().transpose();
      W += face.straight[n] * dN[n].head<2>().transpose();
    }
    s.W_inverse = (is_unrolled ? unrolled : in_own_plane(W)).inverse();
    s.weight = weights[i];
    lagrange_values(face.shape, 1, points[i], std::span(N.data(), corner_total));
    s.normal.setZero();
    for (std::size_t c = 0; c < corner_total; ++c) {
      s.normal +=
          N[static_cast<std::size_t>(lattice_map(face.shape, 1).corner[c])] * face.corner_normal[c];
    }
    s.normal.normalize();
    result.samples.push_back(std::move(s));
  }
  return result;
}

double SurfaceEnergy::evaluate(const Points& x, double delta, Points& slope, double* least) const {
  double energy = 0.0;
  if (least) *least = std::numeric_limits<double>::infinity();
  for (const Face& face : faces_) {
    const Eigen::Index n = static_cast<Eigen::Index>(face.nodes.size());
    MatX own(n, 3);
    for (Eigen::Index i = 0; i < n; ++i) {
      own.row(i) = x[at(face.nodes[static_cast<std::size_t>(i)])].transpose();
    }
    MatX own_slope = MatX::Zero(n, 3);
    for (const Sample& s : face.samples) {
      const Mat32 T = own.transpose() * s.gradient * s.W_inverse;
      const Vec3 t1 = T.col(0), t2 = T.col(1);
      const double tau = t1.cross(t2).dot(s.normal);
      if (least) *least = std::min(*least, tau);
      const double h = regularised_determinant(tau, delta);
      if (!(h > 0.0)) return std::numeric_limits<double>::infinity();
      const double h_slope = h / std::sqrt(tau * tau + 4.0 * delta * delta);
      const double a = T.squaredNorm();
      energy += s.weight * a / (2.0 * h);
      Mat32 area_slope;
      area_slope << t2.cross(s.normal), s.normal.cross(t1);
      const Mat32 dT = s.weight * (T / h - a * h_slope / (2.0 * h * h) * area_slope);
      own_slope.noalias() += s.gradient * (dT * s.W_inverse.transpose()).transpose();
    }
    for (Eigen::Index i = 0; i < n; ++i) {
      slope[at(face.nodes[static_cast<std::size_t>(i)])] += own_slope.row(i).transpose();
    }
  }
  return energy;
}

void SurfaceEnergy::add_stiffness(std::vector<double>& stiffness) const {
  for (const Face& face : faces_) {
    for (const Sample& s : face.samples) {
      const MatX g = s.gradient * s.W_inverse;
      for (Eigen::Index i = 0; i < g.rows(); ++i) {
        stiffness[at(face.nodes[static_cast<std::size_t>(i)])] += s.weight * g.row(i).squaredNorm();
      }
    }
  }
}

double SurfaceEnergy::least_tau(const Points& x) const {
  Points slope(x.size(), Vec3::Zero());
  double least = 0.0;
  evaluate(x, 1.0, slope, &least);
  return least;
}

}  // namespace camber::detail
