// curve() on the bundled cases: what is promised, and what it reaches on each.
#include "curve_cases.hpp"

#include <camber/base/parallel.hpp>
#include <camber/pipeline/check.hpp>

#include <cmath>
#include <filesystem>
#include <numeric>

#include <gtest/gtest.h>

namespace camber {
namespace {

using testing::curve_case;
using testing::expect_promises;
using testing::order;

std::size_t total(const std::map<int, std::size_t>& by_order) {
  return std::accumulate(by_order.begin(), by_order.end(), std::size_t{0},
                         [](std::size_t sum, const auto& entry) { return sum + entry.second; });
}

/// Wall faces over the deviation that have not the highest order of shape they may have.
std::size_t faces_left_behind(const CurveResult& result, const OrderOptions& options) {
  const std::vector<double> shortest = shortest_edges(*result.linear, *result.topology);
  std::size_t left = 0;
  for (Index f = 0; at(f) < result.topology->face_count(); ++f) {
    const double deviation = result.face_deviation[at(f)];
    if (std::isnan(deviation) || result.curved->face_order(f) == options.max_order) continue;
    const double allowed = options.deviation *
                           deviation_length(*result.linear, *result.topology, f, shortest, options);
    left += deviation > allowed ? 1u : 0u;
  }
  return left;
}

void expect_wall_spacing_kept(const Report& report) {
  EXPECT_GT(report.wall_spacing.wall_nodes, 0u);
  EXPECT_LE(static_cast<double>(report.wall_spacing.first_cell_changed_over_1_percent),
            1e-3 * static_cast<double>(report.wall_spacing.wall_nodes));
}

TEST(CurveBall, KeepsItsPromisesAtEveryOrder) {
  double last = 1.0;
  for (int p = 2; p <= 4; ++p) {
    SCOPED_TRACE(p);
    const CurveOptions options = order(p);

    const CurveResult result = curve_case("ball", options);

    expect_promises(result);
    expect_wall_spacing_kept(result.report);
    EXPECT_EQ(result.report.status, "ok");
    EXPECT_EQ(result.report.exit_code, 0);
    EXPECT_EQ(result.report.rescue.scaled_back, 0u);
    EXPECT_EQ(faces_left_behind(result, options.orders), 0u);
    EXPECT_EQ(total(result.report.output.cells_by_order), result.linear->cell_count());
    EXPECT_LE(result.report.surface.maximum, last);
    last = result.report.surface.maximum;
  }
}

TEST(CurveBall, ReachesTheSphereFarBetterThanTheLinearMesh) {
  CurveOptions options = order(4);
  options.orders.deviation = 1e-6;

  const Report report = curve_case("ball", options).report;

  EXPECT_LT(report.surface.maximum, 2e-3 * report.surface.linear_maximum);
  EXPECT_LT(report.surface.average, 1e-3 * report.surface.linear_average);
}

TEST(CurveElbow, KeepsItsPromisesAtEveryOrder) {
  for (int p = 2; p <= 4; ++p) {
    SCOPED_TRACE(p);
    const CurveOptions options = order(p);

    const CurveResult result = curve_case("elbow", options);

    expect_promises(result);
    expect_wall_spacing_kept(result.report);
    EXPECT_EQ(result.report.status, "ok");
    EXPECT_EQ(result.report.rescue.scaled_back, 0u);
    EXPECT_EQ(faces_left_behind(result, options.orders), 0u);
  }
}

TEST(CurveElbow, KeepsInletAndOutletInTheirPlanes) {
  const CurveResult result = curve_case("elbow", order(4));

  std::size_t checked = 0;
  for (Index f = 0; at(f) < result.topology->face_count(); ++f) {
    const Patch* patch = result.association.patch_of(f);
    if (!patch || patch->kind != PatchKind::plane) continue;
    Points nodes(static_cast<std::size_t>(node_count(result.topology->face_shape[at(f)], 4)));
    result.curved->face_lattice(f, 4, nodes);
    for (const Vec3& x : nodes) {
      EXPECT_NEAR((x - patch->origin).dot(patch->normal), 0.0, 1e-13 * result.linear->size());
    }
    ++checked;
  }
  EXPECT_GT(checked, 100u);
}

TEST(CurveElbow, OfMillimetresInMetresIsTheSameMesh) {
  MeshData small = testing::case_mesh("elbow");
  for (Vec3& x : small.points) x *= 1e-3;
  const std::unique_ptr<GeometryModel> geometry = testing::case_geometry("elbow");

  const CurveResult scaled = curve(small, *geometry, order(2));
  const CurveResult whole = curve_case("elbow", order(2));

  expect_promises(scaled);
  EXPECT_EQ(scaled.curved->orders().cell, whole.curved->orders().cell);
  EXPECT_NEAR(scaled.report.surface.maximum / whole.report.surface.maximum, 1e-3, 1e-8);
}

TEST(CurveWing, KeepsItsPromisesAtOrderTwoAndThree) {
  for (int p : {2, 3}) {
    SCOPED_TRACE(p);
    const CurveOptions options = order(p);

    const CurveResult result = curve_case("wing", options);

    expect_promises(result);
    expect_wall_spacing_kept(result.report);
    EXPECT_EQ(faces_left_behind(result, options.orders), 0u);
  }
}

TEST(CurveWing, KeepsItsPromisesAtOrderFour) {
  const CurveOptions options = order(4);

  const CurveResult result = curve_case("wing", options);

  expect_promises(result);
  expect_wall_spacing_kept(result.report);
  EXPECT_EQ(faces_left_behind(result, options.orders), 0u);
  // What the report says of itself agrees with what an outsider sees in the exported mesh.
  const std::unique_ptr<GeometryModel> geometry = testing::case_geometry("wing");
  const Report seen = check(exported(result, options), geometry.get());
  EXPECT_EQ(seen.validity.certified, result.report.validity.certified);
  EXPECT_EQ(seen.validity.min_scaled_jacobian, result.report.validity.min_scaled_jacobian);
  EXPECT_EQ(seen.conformity.max_order_jump, result.report.conformity.max_order_jump);
  EXPECT_LE(seen.conformity.max_gap, 1e-13 * seen.conformity.model_size);
}

// 476 tets on a torus, far too coarse for it: the start is inverted and the ladder has to be
// climbed.
TEST(CurveCoarseTorus, EndsCertifiedWithTheSameBitsForAnyNumberOfThreads) {
  const std::string folder = std::string(CAMBER_SHARED_CASES) + "/layers/";
  if (!std::filesystem::exists(folder + "torus_tet.msh")) GTEST_SKIP() << "no shared cases here";
  const MeshData mesh = io::read_mesh(folder + "torus_tet.msh");
  std::vector<testing::Bits> bits;
  for (int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    const std::unique_ptr<GeometryModel> geometry = read_cad(folder + "torus_tet.brep");

    const CurveResult result = curve(mesh, *geometry, order(2));

    expect_promises(result);
    const Report& report = result.report;
    EXPECT_LT(report.surface.average, report.surface.linear_average);
    // What was given up is listed with its place and its cost.
    if (report.rescue.orders_lowered + report.rescue.scaled_back > 0) {
      ASSERT_FALSE(report.rescue.places.empty());
      for (const RescuePlace& place : report.rescue.places) {
        EXPECT_FALSE(place.reason.empty());
        EXPECT_LE(place.distance, report.surface.maximum);
      }
    }
    bits.push_back(testing::bits_of(result));
  }
  EXPECT_EQ(bits[0], bits[1]);
}

}  // namespace
}  // namespace camber
