// Periodic pairs: shapes equal to the bit after the motion.
#include <camber/base/error.hpp>
#include <camber/geom/analytic_model.hpp>
#include <camber/pipeline/curve.hpp>
#include <camber/pipeline/periodic.hpp>

#include <cmath>
#include <numbers>
#include <set>
#include <tuple>

#include <gtest/gtest.h>

#include "layer_meshes.hpp"

namespace camber {
namespace {

using namespace testing;

/// Layers on a quarter of a cylinder: sides 2 and 3 at z = 0 and 1, 4 and 5 at y = 0 and x = 0.
MeshData quarter(int n, bool is_triangles) {
  const SurfaceMesh wall = grid(
      n, n,
      [](double u, double v) {
        const double a = 0.5 * std::numbers::pi * u;
        return Vec3(std::cos(a), std::sin(a), v);
      },
      is_triangles);
  LayerOptions options;
  options.lateral_entity = [](const Vec3& x) {
    if (x.z() < 1e-6) return 2;
    if (x.z() > 1.0 - 1e-6) return 3;
    return x.y() < 1e-6 ? 4 : 5;
  };
  return layers_on(
      wall, {0.0, 0.01, 0.05, 0.3},
      [](const Vec3& x) { return Vec3(x.x(), x.y(), 0.0).normalized(); }, options);
}

CurveResult run(const MeshData& mesh, const std::vector<std::string>& pairs, int order,
                Smoothing smoothing = Smoothing::automatic) {
  CurveOptions options;
  options.orders.max_order = order;
  options.orders.deviation = 1e-4;
  options.smoothing = smoothing;
  for (const std::string& pair : pairs) options.periodic.push_back(parse_periodic(pair));
  const auto model = make_cylinder(Vec3(0, 0, -1), Vec3(0, 0, 3), 1.0);
  return curve(mesh, *model, options);
}

using Exact = std::tuple<double, double, double>;
Exact exact(const Vec3& x) { return {x.x(), x.y(), x.z()}; }

/// Nodes inside the faces, and on the edges that no other side shares, of one side.
std::set<Exact> nodes_of(const CurveResult& result, int side,
                         const std::function<Vec3(const Vec3&)>& motion) {
  const Topology& topology = *result.topology;
  std::map<Index, std::set<int>> sides_of_edge;
  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    const Patch* patch = result.association.patch_of(f);
    if (!patch || patch->entity == 1 || patch->entity == 1000) continue;
    for (int i = 0; i < topology.corners_of_face(f); ++i) {
      sides_of_edge[topology.face2edge[at(f)][static_cast<std::size_t>(i)]].insert(patch->entity);
    }
  }
  std::set<Exact> nodes;
  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    const Patch* patch = result.association.patch_of(f);
    if (!patch || patch->entity != side) continue;
    for (const Vec3& x : std::as_const(*result.curved).face_nodes(f))
      nodes.insert(exact(motion(x)));
  }
  for (const auto& [e, sides] : sides_of_edge) {
    if (sides != std::set<int>{side}) continue;
    for (const Vec3& x : std::as_const(*result.curved).edge_nodes(e))
      nodes.insert(exact(motion(x)));
  }
  return nodes;
}

void expect_equal(const CurveResult& result) {
  EXPECT_EQ(result.report.validity.certified, result.linear->cell_count());
  EXPECT_LE(result.report.conformity.max_order_jump, 1);
  for (const PeriodicRow& row : result.report.periodic) {
    EXPECT_EQ(row.refused, 0u);
    EXPECT_LT(row.largest_mismatch, 1e-14);
    EXPECT_GT(row.faces, 0u);
    const auto images = nodes_of(result, std::stoi(row.from), row.motion);
    EXPECT_FALSE(images.empty());
    EXPECT_EQ(images, nodes_of(result, std::stoi(row.to), [](const Vec3& x) { return x; }));
  }
}

TEST(Periodic, SidesAreEqualToTheBitAfterATranslationAndARotation) {
  for (bool is_triangles : {false, true}) {
    for (int order : {2, 4}) {
      const CurveResult result =
          run(quarter(4, is_triangles), {"2=3", "4=5"}, order, Smoothing::none);
      ASSERT_EQ(result.report.periodic.size(), 2u);
      expect_equal(result);
      const auto& [along, round] =
          std::tie(result.report.periodic[0].motion, result.report.periodic[1].motion);
      EXPECT_NEAR((along.translation - Vec3::UnitZ()).norm(), 0.0, 1e-14);
      EXPECT_NEAR((round.rotation * Vec3::UnitX() - Vec3::UnitY()).norm(), 0.0, 1e-14);
      // Diagonals make the cells on the two sides differ, and what the layers make of the sides.
      EXPECT_LT(result.report.periodic[0].largest_change, is_triangles ? 2e-3 : 1e-12);
    }
  }
}

TEST(Periodic, PartnersHaveTheSameOrders) {
  const MeshData mesh = quarter(4, true);
  const CurveResult result = run(mesh, {"2=3", "5=4"}, 4);
  const Topology& topology = *result.topology;
  std::map<int, std::multiset<int>> orders;
  for (Index f = 0; at(f) < topology.face_count(); ++f) {
    const Patch* patch = result.association.patch_of(f);
    if (patch) orders[patch->entity].insert(result.curved->face_order(f));
  }
  EXPECT_EQ(orders[2], orders[3]);
  EXPECT_EQ(orders[4], orders[5]);
}

TEST(Periodic, AMotionGivenIsTaken) {
  const CurveResult result =
      run(quarter(3, false), {"2=3:0,0,1", "4=5:0,0,7,0,0,2,90"}, 3, Smoothing::none);
  expect_equal(result);
}

TEST(Periodic, WhatIsNoPairIsRefused) {
  const MeshData mesh = quarter(3, false);
  EXPECT_THROW((void)run(mesh, {"2=5"}, 2), OptionError);        // no motion of these kinds
  EXPECT_THROW((void)run(mesh, {"2=3:0,0,2"}, 2), OptionError);  // the wrong one
  EXPECT_THROW((void)run(mesh, {"2=9"}, 2), OptionError);
  EXPECT_THROW((void)run(mesh, {"1=2"}, 2), OptionError);
  for (const char* text :
       {"", "a", "a=", "=a", "a=a", "a=b:1,2", "a=b:1,2,x", "a=b:0,0,0,0,0,0,9", "a=b:1,2,inf"}) {
    EXPECT_THROW((void)parse_periodic(text), OptionError) << text;
  }
  const PeriodicPair pair = parse_periodic("in let=out:1,0,0");
  EXPECT_EQ(pair.from, "in let");
  EXPECT_EQ(pair.to, "out");
  ASSERT_TRUE(pair.motion);
  EXPECT_EQ((*pair.motion)(Vec3::Zero()), Vec3::UnitX());
}

}  // namespace
}  // namespace camber
