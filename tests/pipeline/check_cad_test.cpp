// The surface error against the bundled ball, whose exact surface is the unit sphere.
#include <camber/associate/cad_scale.hpp>
#include <camber/base/error.hpp>
#include <camber/basis/lagrange.hpp>
#include <camber/basis/quadrature.hpp>
#include <camber/geom_occ/cad_file.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/mesh/elevate_data.hpp>
#include <camber/pipeline/check.hpp>

#include <algorithm>
#include <cmath>
#include <string>

#include <gtest/gtest.h>

namespace camber {
namespace {

const std::string k_ball = std::string(CAMBER_SOURCE_DIR) + "/cases/ball/";
constexpr int k_wall = 1;  // the ball's only CAD face

struct SphereError {
  double integral = 0.0, area = 0.0, maximum = 0.0;
};

/// | |x| - 1 | at the sixth-order Gauss points of all wall elements.
SphereError distance_to_sphere(const MeshData& mesh) {
  SphereError error;
  for (const ElementBlock& block : mesh.blocks) {
    if (dimension(block.shape) != 2 || block.entity != k_wall) continue;
    const Quadrature& rule = sixth_order(block.shape);
    const auto stride = static_cast<std::size_t>(node_count(block.shape, block.order));
    for (std::size_t i = 0; i < block.size(); ++i) {
      Points nodes;
      for (std::size_t k = 0; k < stride; ++k) {
        nodes.push_back(mesh.points[at(block.nodes[i * stride + k])]);
      }
      for (std::size_t g = 0; g < rule.points.size(); ++g) {
        const Vec3 x = evaluate(block.shape, block.order, nodes, rule.points[g]);
        const Mat3 J = jacobian(block.shape, block.order, nodes, rule.points[g]);
        const double area = rule.weights[g] * J.col(0).cross(J.col(1)).norm();
        const double distance = std::abs(x.norm() - 1.0);
        error.integral += distance * area;
        error.area += area;
        error.maximum = std::max(error.maximum, distance);
      }
    }
  }
  return error;
}

/// The ball's mesh at order p with the wall's nodes pulled onto the unit sphere.
MeshData ball_on_sphere(int p) {
  MeshData mesh = at_order(io::read_mesh(k_ball + "linear.msh"), p);
  for (const ElementBlock& block : mesh.blocks) {
    if (dimension(block.shape) != 2 || block.entity != k_wall) continue;
    for (Index node : block.nodes) mesh.points[at(node)].normalize();
  }
  return mesh;
}

TEST(CheckWithCad, MeasuresTheLinearBallAsTheSphereDoes) {
  const MeshData mesh = io::read_mesh(k_ball + "linear.msh");
  const auto geometry = read_cad(k_ball + "body.step");
  EXPECT_EQ(fit_cad_scale(mesh, *geometry), 1.0);

  const Report report = check(mesh, geometry.get());

  const SphereError expected = distance_to_sphere(mesh);
  EXPECT_NEAR(report.surface.maximum, expected.maximum, 1e-9);
  EXPECT_NEAR(report.surface.average, expected.integral / expected.area, 1e-9);
  ASSERT_EQ(report.surface.by_group.size(), 1u);
  EXPECT_EQ(report.surface.by_group[0].name, "ball");
  EXPECT_EQ(report.surface.by_group[0].cad, std::vector<std::string>{"face_1"});
  EXPECT_NEAR(report.surface.by_group[0].area, expected.area, 1e-9);
  EXPECT_EQ(report.surface.faces, 112u);
  EXPECT_EQ(report.surface.linear_maximum, report.surface.maximum);
  EXPECT_EQ(report.surface.patches_without_cad, std::vector<std::string>{"far"});
}

TEST(CheckWithCad, MeasuresCurvedFacesBesideTheirStraightCopies) {
  const auto geometry = read_cad(k_ball + "body.step");
  const double linear = distance_to_sphere(io::read_mesh(k_ball + "linear.msh")).maximum;
  for (int p = 2; p <= k_max_order; ++p) {
    const MeshData mesh = ball_on_sphere(p);

    const Report report = check(mesh, geometry.get(), {.with_quality = false});

    EXPECT_NEAR(report.surface.maximum, distance_to_sphere(mesh).maximum, 1e-9) << p;
    EXPECT_LT(report.surface.maximum, 0.05 * linear) << p;
    EXPECT_NEAR(report.surface.linear_maximum, linear, 1e-9) << p;
    ASSERT_EQ(report.surface.by_order.size(), 1u);
    EXPECT_EQ(report.surface.by_order[0].order, p);
  }
}

TEST(CheckWithCad, StrictFailsOnFacesOverTheDeviation) {
  const MeshData mesh = io::read_mesh(k_ball + "linear.msh");
  const auto geometry = read_cad(k_ball + "body.step");

  const Report plain = check(mesh, geometry.get(), {.with_quality = false});
  const Report strict = check(mesh, geometry.get(), {.with_quality = false, .strict = true});

  EXPECT_GT(plain.surface.faces_over_deviation, 0u);
  EXPECT_EQ(plain.exit_code, 0);
  EXPECT_EQ(strict.status, "over_deviation");
  EXPECT_EQ(strict.exit_code, 3);
}

TEST(FitCadScale, FindsTheUnitsInUse) {
  const auto geometry = read_cad(k_ball + "body.step");
  for (double factor : {1.0, 1e-3, 25.4, 1.0 / 25.4}) {
    MeshData mesh = io::read_mesh(k_ball + "linear.msh");
    for (Vec3& x : mesh.points) x *= factor;
    geometry->set_scale(1.0);

    EXPECT_DOUBLE_EQ(fit_cad_scale(mesh, *geometry), factor);
    EXPECT_DOUBLE_EQ(geometry->scale(), factor);
  }
}

TEST(FitCadScale, RefusesACadOfAnotherSize) {
  MeshData mesh = io::read_mesh(k_ball + "linear.msh");
  for (Vec3& x : mesh.points) x *= 1.7;
  const auto geometry = read_cad(k_ball + "body.step");

  EXPECT_THROW(static_cast<void>(fit_cad_scale(mesh, *geometry)), GeometryError);
  EXPECT_EQ(fit_cad_scale(mesh, *geometry, 1.7), 1.7);
}

TEST(FitCadScale, FitsAPartOfATorusWhoseBoxIsLoose) {
  const std::string elbow = std::string(CAMBER_SOURCE_DIR) + "/cases/elbow/";
  const auto geometry = read_cad(elbow + "body.step");

  EXPECT_EQ(fit_cad_scale(io::read_mesh(elbow + "linear.msh"), *geometry), 1.0);
}

TEST(FitCadScale, RefusesAMeshWithoutAnyTagOfTheCad) {
  MeshData mesh = io::read_mesh(k_ball + "linear.msh");
  for (ElementBlock& block : mesh.blocks) {
    if (dimension(block.shape) == 2) block.entity += 100;
  }
  const auto geometry = read_cad(k_ball + "body.step");

  EXPECT_THROW(static_cast<void>(fit_cad_scale(mesh, *geometry)), GeometryError);
}

}  // namespace
}  // namespace camber
