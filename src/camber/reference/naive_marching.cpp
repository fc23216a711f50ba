#include <camber/basis/lagrange.hpp>
#include <camber/reference/naive_marching.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>

namespace camber::reference {
namespace {

/// Lattice nodes of a sub-simplex; the fourth is -1 in the plane.
using Simplex = std::array<int, 4>;

bool is_inside(Shape shape, int p, const LatticePoint& x) {
  const auto all = lattice(shape, p);
  return std::find(all.begin(), all.end(), x) != all.end();
}

LatticePoint plus(const LatticePoint& a, int i, int j, int k) {
  return {a[0] + i, a[1] + j, a[2] + k};
}

/// All sub-simplices, found from what is around every lattice point.
std::vector<Simplex> find_simplices(Shape shape, int p) {
  std::vector<Simplex> found;
  const auto add = [&](const std::vector<LatticePoint>& points) {
    Simplex s{-1, -1, -1, -1};
    Mat3 edges = Mat3::Identity();
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!is_inside(shape, p, points[i])) return;
      s[i] = lattice_index(shape, p, points[i]);
      for (std::size_t d = 0; i > 0 && d + 1 < points.size(); ++d) {
        edges(static_cast<Eigen::Index>(d), static_cast<Eigen::Index>(i) - 1) =
            points[i][d] - points[0][d];
      }
    }
    if (edges.determinant() < 0.0) std::swap(s[1], s[2]);
    found.push_back(s);
  };
  // The six directions of a triangular lattice, in a round.
  constexpr std::array<std::array<int, 2>, 7> round{
      {{1, 0}, {0, 1}, {-1, 1}, {-1, 0}, {0, -1}, {1, -1}, {1, 0}}};
  for (const LatticePoint& a : lattice(shape, p)) {
    if (shape == Shape::triangle) {
      add({a, plus(a, 1, 0, 0), plus(a, 0, 1, 0)});
      add({a, plus(a, 1, -1, 0), plus(a, 1, 0, 0)});
    }
    if (shape == Shape::prism) {
      for (std::size_t i = 0; i < 6; ++i) {
        for (int up : {-1, 1}) {
          add({a, plus(a, round[i][0], round[i][1], 0),
               plus(a, round[i + 1][0], round[i + 1][1], 0), plus(a, 0, 0, up)});
        }
      }
    }
    if (shape == Shape::tetrahedron) {
      add({a, plus(a, 1, 0, 0), plus(a, 0, 1, 0), plus(a, 0, 0, 1)});
      add({a, plus(a, -1, 0, 0), plus(a, 0, -1, 0), plus(a, 0, 0, -1)});
      // Around the diagonal (1, -1, 1) from a.
      const LatticePoint end = plus(a, 1, -1, 1);
      const std::array<LatticePoint, 5> ring{plus(a, 1, -1, 0), plus(a, 1, 0, 0), plus(a, 0, 0, 1),
                                             plus(a, 0, -1, 1), plus(a, 1, -1, 0)};
      for (std::size_t i = 0; i < 4; ++i) add({a, end, ring[i], ring[i + 1]});
    }
    for (int x : {-1, 1}) {
      for (int y : {-1, 1}) {
        const LatticePoint along_x = plus(a, x, 0, 0), along_y = plus(a, 0, y, 0);
        if (shape == Shape::quadrilateral) add({a, along_x, along_y});
        if (shape == Shape::hexahedron) {
          for (int z : {-1, 1}) add({a, along_x, along_y, plus(a, 0, 0, z)});
        }
        if (shape == Shape::pyramid) {
          add({a, along_x, along_y, plus(a, x < 0 ? -1 : 0, y < 0 ? -1 : 0, 1)});
          add({a, along_x, along_y, plus(a, x > 0 ? 1 : 0, y > 0 ? 1 : 0, -1)});
        }
      }
    }
    if (shape == Shape::pyramid) {
      add({a, plus(a, 1, 0, 0), plus(a, 0, -1, 1), plus(a, 0, 0, 1)});
      add({a, plus(a, 0, 1, 0), plus(a, -1, 0, 1), plus(a, 0, 0, 1)});
    }
  }
  return found;
}

struct Sensitive {
  double value = 0.0;
  std::array<Vec3, 4> slope{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
};

/// The element a sub-simplex belongs to.
struct Element {
  Shape shape;
  int p;
  Points x, X;
};

MatX edge_vectors(const Simplex& s, const Points& x) {
  const int d = s[3] < 0 ? 2 : 3;
  MatX A(3, d);
  for (int c = 0; c < d; ++c) A.col(c) = x[at(s[at(c) + 1])] - x[at(s[0])];
  return A;
}

/// Derivatives by the columns of the edge matrix become those by the corners.
void to_corners(const MatX& by_edges, Sensitive& f) {
  for (Eigen::Index c = 0; c < by_edges.cols(); ++c) {
    f.slope[static_cast<std::size_t>(c) + 1] = by_edges.col(c);
    f.slope[0] -= by_edges.col(c);
  }
}

/// tau of a point or sub-simplex from A and W (3 x d), and d tau / d A.
double ratio(const MatX& A, const MatX& W, MatX& slope) {
  slope.resize(3, A.cols());
  if (A.cols() == 3) {
    const Mat3 M = A, cofactor = M.determinant() * M.inverse().transpose();
    const double det_W = Mat3(W).determinant();
    slope = cofactor / det_W;
    return M.determinant() / det_W;
  }
  const Vec3 a = A.col(0), b = A.col(1), n = a.cross(b);
  const Vec3 N = Vec3(W.col(0)).cross(Vec3(W.col(1)));
  const double sign = n.dot(N) < 0.0 ? -1.0 : 1.0;
  const Vec3 unit = n.normalized();
  slope.col(0) = sign * b.cross(unit) / N.norm();
  slope.col(1) = sign * unit.cross(a) / N.norm();
  return sign * n.norm() / N.norm();
}

/// The normalised Jacobian of eq. (2).
Sensitive numerator(const Element& element, const Simplex& s, int level) {
  Sensitive result;
  MatX slope;
  if (level == 0) {
    result.value = ratio(edge_vectors(s, element.x), edge_vectors(s, element.X), slope);
    to_corners(slope, result);
    return result;
  }
  const int parts = 1 << level, corners = s[3] < 0 ? 3 : 4;
  std::vector<Sensitive> points;
  std::vector<Vec3> dN(element.x.size());
  for (int i = 0; i <= parts; ++i) {
    for (int j = 0; i + j <= parts; ++j) {
      for (int k = 0; i + j + k <= parts && (k == 0 || corners == 4); ++k) {
        const std::array<int, 4> weight{parts - i - j - k, i, j, k};
        Vec3 xi = Vec3::Zero();
        for (std::size_t c = 0; c < at(corners); ++c) {
          xi += weight[c] * lattice_xi(element.shape, element.p)[at(s[c])] / parts;
        }
        const MatX A = jacobian(element.shape, element.p, element.x, xi).leftCols(corners - 1);
        const MatX W = jacobian(element.shape, element.p, element.X, xi).leftCols(corners - 1);
        Sensitive point;
        point.value = ratio(A, W, slope);
        lagrange_gradients(element.shape, element.p, xi, dN);
        for (std::size_t c = 0; c < at(corners); ++c) {
          point.slope[c] = slope * dN[at(s[c])].head(corners - 1);
        }
        if (point.value > 1.0) point = Sensitive{1.0, Sensitive{}.slope};
        points.push_back(point);
      }
    }
  }
  const Sensitive lowest =
      *std::min_element(points.begin(), points.end(),
                        [](const Sensitive& a, const Sensitive& b) { return a.value < b.value; });
  if (lowest.value <= 0.0) return lowest;
  const double n = static_cast<double>(points.size());
  double mean = 0.0;
  for (const Sensitive& point : points) mean += point.value / n;
  result.value = lowest.value * (1.0 - lowest.value) + mean * lowest.value;
  for (std::size_t c = 0; c < 4; ++c) {
    Vec3 mean_slope = Vec3::Zero();
    for (const Sensitive& point : points) mean_slope += point.slope[c] / n;
    result.slope[c] =
        (1.0 - 2.0 * lowest.value + mean) * lowest.slope[c] + lowest.value * mean_slope;
  }
  return result;
}

/// Weighted condition number, eq. (4) and (6). In the plane |T^-1| = |T| / |det T|.
Sensitive denominator(const Element& element, const Simplex& s) {
  const MatX A = edge_vectors(s, element.x), W = edge_vectors(s, element.X);
  Sensitive result;
  MatX slope;
  if (A.cols() == 3) {
    const Mat3 W_inverse = Mat3(W).inverse(), T = A * W_inverse, K = T.inverse();
    result.value = T.norm() * K.norm() / 3.0;
    const Mat3 by_T =
        (T * K.norm() / T.norm() - T.norm() / K.norm() * K.transpose() * K * K.transpose()) / 3.0;
    slope = by_T * W_inverse.transpose();
  } else {
    const double tau = std::abs(ratio(A, W, slope));
    if (ratio(A, W, slope) < 0.0) slope = -slope;
    const Eigen::Matrix2d metric = (W.transpose() * W).inverse();
    const double a = (A * metric * A.transpose()).trace();  // |A W^-1|^2
    result.value = a / (2.0 * tau);
    slope = MatX(A * metric / tau - a / (2.0 * tau * tau) * slope);
  }
  to_corners(slope, result);
  return result;
}

Sensitive sub_cost(const Element& element, const Simplex& s, int level) {
  Sensitive tau = numerator(element, s, level);
  if (tau.value <= 0.0) return tau;
  if (tau.value > 1.0) tau = Sensitive{1.0, Sensitive{}.slope};
  const Sensitive wcn = denominator(element, s);
  Sensitive C;
  C.value = tau.value / wcn.value;
  for (std::size_t c = 0; c < 4; ++c) {
    C.slope[c] = (tau.slope[c] - C.value * wcn.slope[c]) / wcn.value;
  }
  return C;
}

double inscribed_radius(const Simplex& s, const Points& X) {
  const auto area = [&](std::size_t a, std::size_t b, std::size_t c) {
    return 0.5 * (X[at(s[b])] - X[at(s[a])]).cross(X[at(s[c])] - X[at(s[a])]).norm();
  };
  const auto length = [&](std::size_t a, std::size_t b) {
    return (X[at(s[a])] - X[at(s[b])]).norm();
  };
  if (s[3] < 0) return 2.0 * area(0, 1, 2) / (length(0, 1) + length(1, 2) + length(2, 0));
  const double volume = std::abs(Mat3(edge_vectors(s, X)).determinant()) / 6.0;
  return 3.0 * volume / (area(0, 1, 2) + area(0, 1, 3) + area(0, 2, 3) + area(1, 2, 3));
}

/// Displacement of one node from the elements around; `gather` gives element e as it is now.
Vec3 step(const NaiveMarching& options, std::size_t elements,
          const std::function<Element(std::size_t)>& gather, Vec3& node) {
  std::vector<Sensitive> around;  // slope[0]: by the node
  double radius = 1e300;
  for (std::size_t e = 0; e < elements; ++e) {
    const Element element = gather(e);
    const Vec3 place = node;
    node = place + Vec3::UnitX();
    const Element probe = gather(e);
    node = place;
    for (const Simplex& s : find_simplices(element.shape, element.p)) {
      std::array<double, 4> weight{};
      for (std::size_t c = 0; c < 4 && s[c] >= 0; ++c) {
        weight[c] = probe.x[at(s[c])].x() - element.x[at(s[c])].x();
        if (std::abs(weight[c]) < 1e-12) weight[c] = 0.0;  // round-off of the difference
      }
      if (weight == std::array<double, 4>{}) continue;
      const Sensitive C = sub_cost(element, s, options.level);
      Sensitive here;
      here.value = C.value;
      for (std::size_t c = 0; c < 4; ++c) here.slope[0] += weight[c] * C.slope[c];
      around.push_back(here);
      radius = std::min(radius, inscribed_radius(s, element.X));
    }
  }
  if (around.empty()) return Vec3::Zero();
  std::size_t lowest = 0;
  double mean = 0.0;
  Vec3 mean_slope = Vec3::Zero();
  for (std::size_t i = 0; i < around.size(); ++i) {
    if (around[i].value < around[lowest].value) lowest = i;
    mean += around[i].value / static_cast<double>(around.size());
    mean_slope += around[i].slope[0] / static_cast<double>(around.size());
  }
  const double C_min = around[lowest].value;
  const double cost = C_min < 0.0 ? C_min : C_min * (1.0 - C_min) + mean * C_min;
  const Vec3 slope = C_min < 0.0
                         ? around[lowest].slope[0]
                         : Vec3(around[lowest].slope[0] * (1.0 - C_min) + mean_slope * C_min);
  if (cost >= options.threshold) return Vec3::Zero();
  return options.relaxation * radius * std::min(1.0, std::abs(1.0 - cost)) * slope.normalized();
}

Points all_steps(CurvedMesh curved, const NaiveMarching& options, std::size_t elements,
                 const std::function<Element(const CurvedMesh&, std::size_t)>& gather) {
  Points steps;
  const auto bound = [&](std::size_t e) { return gather(curved, e); };
  const auto add = [&](std::span<Vec3> own, bool is_fixed) {
    for (Vec3& node : own) {
      steps.push_back(is_fixed ? Vec3::Zero() : step(options, elements, bound, node));
    }
  };
  for (Index e = 0; at(e) < curved.topology().edge_count(); ++e) {
    add(curved.edge_nodes(e), options.fixed_edge[at(e)] != 0);
  }
  for (Index f = 0; at(f) < curved.topology().face_count(); ++f) {
    add(curved.face_nodes(f), options.fixed_face[at(f)] != 0);
  }
  for (Index c = 0; at(c) < curved.linear().cell_count(); ++c) add(curved.cell_nodes(c), false);
  return steps;
}

}  // namespace

Points naive_volume_step(const CurvedMesh& curved, const NaiveMarching& options) {
  return all_steps(curved, options, curved.linear().cell_count(),
                   [](const CurvedMesh& mesh, std::size_t e) {
                     const Index c = static_cast<Index>(e);
                     Element element{mesh.linear().cell_shape[e], mesh.cell_order(c), {}, {}};
                     mesh.gather(c, element.p, element.x);
                     mesh.gather_straight(c, element.p, element.X);
                     return element;
                   });
}

Points naive_surface_step(const CurvedMesh& curved, const NaiveMarching& options,
                          const std::vector<Index>& faces) {
  return all_steps(curved, options, faces.size(), [&](const CurvedMesh& mesh, std::size_t e) {
    const Shape shape = mesh.topology().face_shape[at(faces[e])];
    Element element{shape, mesh.face_order(faces[e]), {}, {}};
    element.x.resize(at(node_count(shape, element.p)));
    mesh.face_lattice(faces[e], element.p, element.x);
    element.X = straight_face_nodes(mesh.linear(), mesh.topology(), faces[e], element.p);
    return element;
  });
}

}  // namespace camber::reference
