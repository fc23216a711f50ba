#include <camber/basis/quadrature.hpp>
#include <camber/smooth/detail/surface_distance.hpp>

#include <cmath>
#include <numeric>

namespace camber::detail {
SurfaceDistance::SurfaceDistance(const SurfacePatch& patch, const NearestPoints& nearest)
    : patch_(patch),
      nearest_(nearest),
      triangle_(tabulate(Shape::triangle, patch.order, sixth_order(Shape::triangle).points).values),
      quadrilateral_(
          tabulate(Shape::quadrilateral, patch.order, sixth_order(Shape::quadrilateral).points)
              .values),
      face_weight_(patch.faces.size(), 1.0),
      face_area_(patch.faces.size(), 0.0) {
  for (std::size_t f = 0; f < patch.faces.size(); ++f) {
    const SurfaceFace& face = patch.faces[f];
    const Quadrature& rule = sixth_order(face.shape);
    for (std::size_t g = 0; g < rule.points.size(); ++g) {
      const Mat3 J = jacobian(face.shape, patch.order, face.straight, rule.points[g]);
      point2face_.push_back(static_cast<Index>(f));
      point_area_.push_back(rule.weights[g] * J.col(0).cross(J.col(1)).norm());
      face_area_[f] += point_area_.back();
    }
  }
  points_.resize(point2face_.size());
  feet_.resize(point2face_.size());
}

const MatX& SurfaceDistance::values(const SurfaceFace& face) const {
  return face.shape == Shape::triangle ? triangle_ : quadrilateral_;
}

std::vector<double> SurfaceDistance::find_feet(const Points& x) {
  std::size_t k = 0;
  for (const SurfaceFace& face : patch_.faces) {
    const MatX& N = values(face);
    for (Eigen::Index g = 0; g < N.rows(); ++g, ++k) {
      points_[k].setZero();
      for (std::size_t i = 0; i < face.nodes.size(); ++i) {
        points_[k] += N(g, static_cast<Eigen::Index>(i)) * x[at(face.nodes[i])];
      }
    }
  }
  nearest_(point2face_, points_, feet_);
  std::vector<double> squares(patch_.faces.size(), 0.0);
  for (std::size_t i = 0; i < points_.size(); ++i) {
    squares[at(point2face_[i])] += point_area_[i] * (points_[i] - feet_[i]).squaredNorm();
  }
  return squares;
}

void SurfaceDistance::weigh_by_start() {
  const std::vector<double> squares = find_feet(patch_.nodes);
  for (std::size_t f = 0; f < squares.size(); ++f) {
    const double good = patch_.faces[f].good_enough;
    const double scale = squares[f] + good * good * face_area_[f];
    face_weight_[f] = scale > 0.0 ? 1.0 / scale : 0.0;
  }
}

double SurfaceDistance::evaluate(const Points& x, Points& slope) {
  const std::vector<double> squares = find_feet(x);
  std::size_t k = 0;
  for (std::size_t f = 0; f < patch_.faces.size(); ++f) {
    const SurfaceFace& face = patch_.faces[f];
    const MatX& N = values(face);
    for (Eigen::Index g = 0; g < N.rows(); ++g, ++k) {
      const Vec3 pull = 2.0 * face_weight_[f] * point_area_[k] * (points_[k] - feet_[k]);
      for (std::size_t i = 0; i < face.nodes.size(); ++i) {
        slope[at(face.nodes[i])] += N(g, static_cast<Eigen::Index>(i)) * pull;
      }
    }
  }
  return std::inner_product(squares.begin(), squares.end(), face_weight_.begin(), 0.0);
}

double SurfaceDistance::root_mean_square(const Points& x) {
  const std::vector<double> squares = find_feet(x);
  return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) /
                   std::accumulate(face_area_.begin(), face_area_.end(), 0.0));
}

}  // namespace camber::detail
