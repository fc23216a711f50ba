// Shape conformity, eq. (1), under uniform refinement.
#include <camber/geom/analytic_model.hpp>

#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "layer_meshes.hpp"

namespace camber {
namespace {

using namespace testing;

/// SC of the whole wall at orders 1..4.
std::array<double, 5> conformity(const Case& c) {
  std::array<double, 5> result{};
  for (int q = 1; q <= 4; ++q) {
    double integral = 0.0, area = 0.0;
    for (Index slot = 0; at(slot) < c.wall.face_count(); ++slot) {
      const Deviation& d = c.placement->face_deviation(slot, q);
      integral += d.integral;
      area += d.area;
    }
    result[static_cast<std::size_t>(q)] = integral / area;
  }
  return result;
}

/// Three uniform refinements; each order must gain at least p + 0.9 between the last two meshes.
void expect_convergence(const std::function<SurfaceMesh(int)>& surface,
                        const std::function<Vec3(const Vec3&)>& direction,
                        const std::function<std::unique_ptr<GeometryModel>()>& model) {
  std::array<double, 5> before{}, slope{};
  for (int level = 0; level <= 3; ++level) {
    const SurfaceMesh mesh = surface(level);
    const double thin = 1e-3 * mean_edge(mesh);
    const auto c = make_case(layers_on(mesh, {0.0, thin}, direction), model());
    const std::array<double, 5> now = conformity(*c);
    for (std::size_t q = 1; q <= 4; ++q) {
      slope[q] = std::log2(before[q] / now[q]);
      if (level > 0) {
        EXPECT_LT(now[q], before[q]) << "order " << q << ", level " << level;
      }
    }
    before = now;
  }
  for (int q = 1; q <= 4; ++q) {
    EXPECT_GE(slope[static_cast<std::size_t>(q)], q + 0.9) << "order " << q;
    ::testing::Test::RecordProperty("slope_" + std::to_string(q),
                                    std::to_string(slope[static_cast<std::size_t>(q)]));
  }
}

Vec3 outwards(const Vec3& x) { return x.normalized(); }

const Vec3 k_axes(1.5, 1.0, 0.8);

Vec3 off_ellipsoid(const Vec3& x) {
  return x.cwiseQuotient(k_axes.cwiseProduct(k_axes)).normalized();
}

Vec3 off_torus(const Vec3& x) {
  return (x - 2.0 * Vec3(x.x(), x.y(), 0.0).normalized()).normalized();
}

std::unique_ptr<GeometryModel> sphere() { return make_sphere(Vec3::Zero(), 1.0); }
std::unique_ptr<GeometryModel> ellipsoid() { return make_ellipsoid(Vec3::Zero(), k_axes); }
std::unique_ptr<GeometryModel> torus() { return make_torus(Vec3::Zero(), Vec3::UnitZ(), 2.0, 1.0); }

TEST(Conformity, ConvergesOnTheSphereWithTriangles) {
  expect_convergence([](int level) { return icosphere(level); }, outwards, sphere);
}
TEST(Conformity, ConvergesOnTheSphereWithQuadrilaterals) {
  expect_convergence([](int level) { return cubed_sphere(2 << level); }, outwards, sphere);
}
TEST(Conformity, ConvergesOnTheEllipsoidWithTriangles) {
  expect_convergence([](int level) { return stretched(icosphere(level), k_axes); }, off_ellipsoid,
                     ellipsoid);
}
TEST(Conformity, ConvergesOnTheEllipsoidWithQuadrilaterals) {
  expect_convergence([](int level) { return stretched(cubed_sphere(2 << level), k_axes); },
                     off_ellipsoid, ellipsoid);
}
TEST(Conformity, ConvergesOnTheTorusWithTriangles) {
  expect_convergence([](int level) { return torus_grid(2.0, 1.0, 6 << level, 4 << level, true); },
                     off_torus, torus);
}
TEST(Conformity, ConvergesOnTheTorusWithQuadrilaterals) {
  expect_convergence([](int level) { return torus_grid(2.0, 1.0, 6 << level, 4 << level, false); },
                     off_torus, torus);
}

TEST(Conformity, OfOneFlatTriangleUnderASphereMatchesTheIntegralByHand) {
  // A face of the icosahedron at order 1: distance 1 - |x|. Compared with a midpoint rule on 400^2
  // points.
  const auto c = make_case(layers_on(icosphere(0), {0.0, 0.1}, outwards), sphere());
  const SurfaceMesh surface = icosphere(0);
  const auto& [a, b, d, unused] = surface.faces[0];
  double sum = 0.0;
  constexpr int n = 400;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j + i < n; ++j) {
      for (double third : {1.0, 2.0}) {
        if (third == 2.0 && i + j + 1 >= n) continue;
        const double u = (i + third / 3.0) / n, v = (j + third / 3.0) / n;
        sum += 1.0 - (u * surface.points[at(a)] + v * surface.points[at(b)] +
                      (1.0 - u - v) * surface.points[at(d)])
                         .norm();
      }
    }
  }
  const Deviation& deviation = c->placement->face_deviation(0, 1);

  EXPECT_NEAR(deviation.integral / deviation.area, sum / (n * n), 1e-5);
  const double edge = mean_edge(surface);
  EXPECT_NEAR(deviation.area, std::sqrt(3.0) / 4.0 * edge * edge, 1e-14);
  EXPECT_LT(deviation.maximum, 1.0 - std::sqrt(1.0 - edge * edge / 3.0) + 1e-15);
}

}  // namespace
}  // namespace camber
