#include <camber/basis/lagrange.hpp>
#include <camber/basis/quadrature.hpp>
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

constexpr int k_rounds = 12;
constexpr int k_iterations = 30;
/// tau that every sample must reach for the patch to count as repaired.
constexpr double k_clear = 0.05;
constexpr double k_least_delta = 0.05;
constexpr double k_delta_shrink = 0.7;
constexpr double k_longest_step = 0.5;

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

FaceSamples sample_face(const SurfaceFace& face, int order) {
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
  const std::size_t corner_total = face.shape == Shape::triangle ? 3 : 4;
  for (std::size_t i = 0; i < points.size(); ++i) {
    lagrange_gradients(face.shape, order, points[i], dN);
    Sample s;
    Mat32 W = Mat32::Zero();
    s.gradient.resize(static_cast<Eigen::Index>(dN.size()), 2);
    for (std::size_t n = 0; n < dN.size(); ++n) {
      s.gradient.row(static_cast<Eigen::Index>(n)) = dN[n].head<2>().transpose();
      W += face.straight[n] * dN[n].head<2>().transpose();
    }
    s.W_inverse = in_own_plane(W).inverse();
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

/// Energy and least tau of the patch for tangential moves of its free nodes.
class SurfaceEnergy {
 public:
  SurfaceEnergy(const SurfacePatch& patch, std::vector<Vec3> normals) : patch_(patch) {
    free_number_.assign(patch.nodes.size(), k_none);
    for (std::size_t i = 0; i < patch.nodes.size(); ++i) {
      if (!patch.is_free[i]) continue;
      free_number_[i] = static_cast<Index>(frames_.size());
      free_nodes_.push_back(static_cast<Index>(i));
      const Vec3& n = normals[i];
      const Vec3 a = n.unitOrthogonal();
      Mat32 frame;
      frame << a, n.cross(a);
      frames_.push_back(frame);
    }
    for (const SurfaceFace& face : patch.faces) faces_.push_back(sample_face(face, patch.order));
  }

  [[nodiscard]] Eigen::Index size() const { return 2 * static_cast<Eigen::Index>(frames_.size()); }
  [[nodiscard]] const std::vector<Index>& free_nodes() const { return free_nodes_; }

  [[nodiscard]] Vec3 position(Index node, const VecX& t) const {
    const Index k = free_number_[at(node)];
    if (k == k_none) return patch_.nodes[at(node)];
    return patch_.nodes[at(node)] + frames_[at(k)] * t.segment<2>(2 * k);
  }

  double evaluate(const VecX& t, double delta, VecX& gradient, double* least = nullptr) const {
    gradient.setZero(t.size());
    double energy = 0.0;
    if (least) *least = std::numeric_limits<double>::infinity();
    for (const FaceSamples& fs : faces_) {
      const Eigen::Index n = static_cast<Eigen::Index>(fs.face->nodes.size());
      MatX x(n, 3);
      for (Eigen::Index i = 0; i < n; ++i) {
        x.row(i) = position(fs.face->nodes[static_cast<std::size_t>(i)], t).transpose();
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
        const Index k = free_number_[at(fs.face->nodes[static_cast<std::size_t>(i)])];
        if (k != k_none)
          gradient.segment<2>(2 * k) += frames_[at(k)].transpose() * slope.row(i).transpose();
      }
    }
    return energy;
  }

  [[nodiscard]] double least_tau(const VecX& t) const {
    VecX gradient(t.size());
    double least = 0.0;
    evaluate(t, 1.0, gradient, &least);
    return least;
  }

  [[nodiscard]] VecX inverse_diagonal() const {
    VecX diagonal = VecX::Zero(size());
    for (const FaceSamples& fs : faces_) {
      for (const Sample& s : fs.samples) {
        const MatX g = s.gradient * s.W_inverse;
        for (Eigen::Index i = 0; i < g.rows(); ++i) {
          const Index k = free_number_[at(fs.face->nodes[static_cast<std::size_t>(i)])];
          if (k != k_none) diagonal.segment<2>(2 * k).array() += s.weight * g.row(i).squaredNorm();
        }
      }
    }
    return diagonal.cwiseMax(1e-300).cwiseInverse();
  }

 private:
  const SurfacePatch& patch_;
  std::vector<Index> free_number_, free_nodes_;
  std::vector<Mat32> frames_;
  std::vector<FaceSamples> faces_;
};

}  // namespace

bool smooth_surface(SurfacePatch& patch, const OntoSurface& onto) {
  const Points start = patch.nodes;
  std::vector<Vec3> normals(patch.nodes.size(), Vec3::UnitZ());
  for (std::size_t i = 0; i < patch.nodes.size(); ++i) {
    if (patch.is_free[i]) normals[i] = onto(static_cast<Index>(i), patch.nodes[i]).normal;
  }
  for (int round = 0; round < k_rounds; ++round) {
    const SurfaceEnergy energy(patch, normals);
    if (energy.size() == 0) break;
    VecX t = VecX::Zero(energy.size());
    const double least = energy.least_tau(t);
    if (round > 0 && least > k_clear) return true;
    const double delta = least > 0.0 ? 0.0
                                     : std::max(k_least_delta, 0.3 * std::abs(least)) *
                                           std::pow(k_delta_shrink, round);
    LbfgsOptions options;
    options.max_iterations = k_iterations;
    options.longest_step = k_longest_step;
    minimise_lbfgs([&](const VecX& y, VecX& g) { return energy.evaluate(y, delta, g); }, t,
                   energy.inverse_diagonal(), options);
    std::vector<std::pair<Index, SurfaceFoot>> feet;
    for (Index node : energy.free_nodes())
      feet.emplace_back(node, onto(node, energy.position(node, t)));
    for (const auto& [node, foot] : feet) {
      patch.nodes[at(node)] = foot.point;
      normals[at(node)] = foot.normal;
    }
  }
  const SurfaceEnergy energy(patch, normals);
  if (energy.size() > 0 && energy.least_tau(VecX::Zero(energy.size())) > k_clear) return true;
  patch.nodes = start;
  return false;
}

}  // namespace camber
