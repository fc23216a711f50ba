#include <camber/basis/lagrange.hpp>
#include <camber/basis/quadrature.hpp>
#include <camber/metric/weight_matrix.hpp>
#include <camber/smooth/distortion.hpp>
#include <camber/smooth/lbfgs.hpp>
#include <camber/smooth/surface_patch.hpp>

#include <algorithm>
#include <cmath>
#include <limits>

namespace camber {
namespace {

using Mat32 = Eigen::Matrix<double, 3, 2>;
using Mat2 = Eigen::Matrix2d;

constexpr int k_rounds = 16;
constexpr int k_iterations = 40;
/// tau that every sample must reach for the patch to count as repaired.
constexpr double k_clear = 0.02;
constexpr double k_least_delta = 0.05;
constexpr double k_delta_shrink = 0.7;
constexpr double k_longest_step = 0.5;

/// Where the two directions of a surface are closer to parallel than this (a pole) a node stays.
constexpr double k_least_rcond = 1e-8;

struct Sample {
  Mat2 W_inverse;
  double weight = 0.0;
  Vec3 normal;
  MatX gradient;  // nodes x 2
};

struct FaceSamples {
  const SurfaceFace* face;
  std::vector<Sample> samples;
};

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

FaceSamples sample_face(const SurfacePatch& patch, const SurfaceFace& face) {
  const int order = patch.order;
  FaceSamples result{&face, {}};
  const Quadrature& rule = gauss(face.shape, 2 * order);
  std::vector<Vec3> points = rule.points;
  std::vector<double> weights = rule.weights;
  for (double& w : weights) w /= reference_measure(face.shape);
  for (const Vec3& xi : lattice_xi(face.shape, 2 * order)) {
    points.push_back(xi);
    weights.push_back(0.1 / node_count(face.shape, 2 * order));
  }
  std::vector<Vec3> dN(face.nodes.size());
  std::array<double, 4> N{};
  const bool is_triangle = face.shape == Shape::triangle;
  const std::size_t corner_total = is_triangle ? 3 : 4;
  Mat2 unrolled = Mat2::Zero();
  if (is_triangle) {
    unrolled = triangle_weight_matrix<double>(
        {edge_length(patch, face, 0), edge_length(patch, face, 2), edge_length(patch, face, 1)});
  }
  const bool is_unrolled = unrolled.determinant() > 0.0;
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

/// Energy and least tau of the patch as functions of where its free nodes are on their surfaces.
class SurfaceEnergy {
 public:
  SurfaceEnergy(const SurfacePatch& patch, const OnSurface& on_surface)
      : patch_(patch), on_surface_(on_surface), x_(patch.nodes), slope_(patch.nodes.size()) {
    for (std::size_t i = 0; i < patch.nodes.size(); ++i) {
      if (!patch.is_free[i]) continue;
      const SurfaceSample start = on_surface(static_cast<Index>(i), patch.uv[i]);
      Mat32 tangents;
      tangents << start.du, start.dv;
      // uv = uv0 + M t with orthonormal columns of dx/dt at the start.
      const Eigen::LLT<Mat2> metric(tangents.transpose() * tangents);
      if (metric.info() != Eigen::Success || !(metric.rcond() > k_least_rcond)) continue;
      free_nodes_.push_back(static_cast<Index>(i));
      scale_.push_back(metric.matrixU().solve(Mat2::Identity()));
    }
    free_tangents_.resize(free_nodes_.size());
    for (const SurfaceFace& face : patch.faces) faces_.push_back(sample_face(patch, face));
  }

  [[nodiscard]] Eigen::Index size() const {
    return 2 * static_cast<Eigen::Index>(free_nodes_.size());
  }

  [[nodiscard]] Vec2 parameters(std::size_t k, const VecX& t) const {
    return patch_.uv[at(free_nodes_[k])] +
           scale_[k] * t.segment<2>(2 * static_cast<Eigen::Index>(k));
  }

  double evaluate(const VecX& t, double delta, VecX& gradient, double* least = nullptr) {
    for (std::size_t k = 0; k < free_nodes_.size(); ++k) {
      const SurfaceSample s = on_surface_(free_nodes_[k], parameters(k, t));
      x_[at(free_nodes_[k])] = s.point;
      free_tangents_[k] << s.du, s.dv;
    }
    std::fill(slope_.begin(), slope_.end(), Vec3::Zero());
    double energy = 0.0;
    if (least) *least = std::numeric_limits<double>::infinity();
    for (const FaceSamples& fs : faces_) {
      const Eigen::Index n = static_cast<Eigen::Index>(fs.face->nodes.size());
      MatX x(n, 3);
      for (Eigen::Index i = 0; i < n; ++i) {
        x.row(i) = x_[at(fs.face->nodes[static_cast<std::size_t>(i)])].transpose();
      }
      MatX slope = MatX::Zero(n, 3);
      for (const Sample& s : fs.samples) {
        const Mat32 T = x.transpose() * s.gradient * s.W_inverse;
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
        slope.noalias() += s.gradient * (dT * s.W_inverse.transpose()).transpose();
      }
      for (Eigen::Index i = 0; i < n; ++i) {
        slope_[at(fs.face->nodes[static_cast<std::size_t>(i)])] += slope.row(i).transpose();
      }
    }
    gradient.resize(t.size());
    for (std::size_t k = 0; k < free_nodes_.size(); ++k) {
      gradient.segment<2>(2 * static_cast<Eigen::Index>(k)) =
          (free_tangents_[k] * scale_[k]).transpose() * slope_[at(free_nodes_[k])];
    }
    return energy;
  }

  [[nodiscard]] double least_tau(const VecX& t) {
    VecX gradient(t.size());
    double least = 0.0;
    evaluate(t, 1.0, gradient, &least);
    return least;
  }

  [[nodiscard]] VecX inverse_diagonal() const {
    std::vector<double> stiffness(patch_.nodes.size(), 0.0);
    for (const FaceSamples& fs : faces_) {
      for (const Sample& s : fs.samples) {
        const MatX g = s.gradient * s.W_inverse;
        for (Eigen::Index i = 0; i < g.rows(); ++i) {
          stiffness[at(fs.face->nodes[static_cast<std::size_t>(i)])] +=
              s.weight * g.row(i).squaredNorm();
        }
      }
    }
    VecX inverse(size());
    for (std::size_t k = 0; k < free_nodes_.size(); ++k) {
      inverse.segment<2>(2 * static_cast<Eigen::Index>(k))
          .setConstant(1.0 / std::max(stiffness[at(free_nodes_[k])], 1e-300));
    }
    return inverse;
  }

  /// Puts the free nodes of the patch to where t says.
  void store(const VecX& t, SurfacePatch& patch) const {
    for (std::size_t k = 0; k < free_nodes_.size(); ++k) {
      const std::size_t node = at(free_nodes_[k]);
      patch.uv[node] = parameters(k, t);
      patch.nodes[node] = on_surface_(free_nodes_[k], patch.uv[node]).point;
    }
  }

 private:
  const SurfacePatch& patch_;
  const OnSurface& on_surface_;
  std::vector<Index> free_nodes_;
  std::vector<Mat2> scale_;
  std::vector<FaceSamples> faces_;
  // Work space of evaluate().
  Points x_, slope_;
  std::vector<Mat32> free_tangents_;
};

}  // namespace

bool smooth_surface(SurfacePatch& patch, const OnSurface& on_surface) {
  SurfaceEnergy energy(patch, on_surface);
  if (energy.size() == 0) return false;
  VecX t = VecX::Zero(energy.size());
  const VecX inverse_diagonal = energy.inverse_diagonal();
  LbfgsOptions options;
  options.max_iterations = k_iterations;
  options.longest_step = k_longest_step;
  double least = energy.least_tau(t);
  for (int round = 0; round < k_rounds; ++round) {
    const double delta = least > 0.0 ? 0.0
                                     : std::max(k_least_delta, 0.3 * std::abs(least)) *
                                           std::pow(k_delta_shrink, round);
    minimise_lbfgs([&](const VecX& y, VecX& g) { return energy.evaluate(y, delta, g); }, t,
                   inverse_diagonal, options);
    least = energy.least_tau(t);
    if (least > k_clear) {
      energy.store(t, patch);
      return true;
    }
  }
  return false;
}

}  // namespace camber
