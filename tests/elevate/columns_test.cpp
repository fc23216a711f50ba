#include <camber/elevate/columns.hpp>
#include <camber/geom/analytic_model.hpp>

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include "layer_meshes.hpp"

namespace camber {
namespace {

using namespace testing;

Vec3 outwards(const Vec3& x) { return x.normalized(); }

std::unique_ptr<Case> sphere_case(const SurfaceMesh& surface, const std::vector<double>& heights,
                                  const LayerOptions& options = {}) {
  return make_case(layers_on(surface, heights, outwards, options), make_sphere(Vec3::Zero(), 1.0),
                   2);
}

TEST(Columns, OfPrismsAndHexahedraReachThroughAllLayers) {
  const std::vector<double> heights{0.0, 0.01, 0.03, 0.1};
  for (const SurfaceMesh& surface : {icosphere(0), cubed_sphere(2)}) {
    const auto c = sphere_case(surface, heights);
    const Index n = static_cast<Index>(surface.points.size());

    EXPECT_EQ(c->columns.column_count, surface.faces.size());
    for (Index v = 0; at(v) < c->mesh.vertices.size(); ++v) {
      EXPECT_EQ(c->columns.base[at(v)], v % n);
      EXPECT_NEAR(c->columns.height[at(v)], heights[at(v / n)], 1e-15);
    }
    for (Index cell = 0; at(cell) < c->mesh.cell_count(); ++cell) {
      const Index slot = c->columns.cell_face_slot[at(cell)];
      ASSERT_NE(slot, k_none);
      const std::array<Index, 4>& foot = c->topology.face2vertex[at(c->wall.faces[at(slot)])];
      for (Index v : c->mesh.cell(cell)) {
        EXPECT_NE(std::find(foot.begin(), foot.end(), v % n), foot.end());
      }
    }
  }
}

TEST(Columns, OfLayersSplitIntoTetsAreThoseOfTheirPrisms) {
  LayerOptions options;
  options.filling = LayerFilling::tets;
  const std::vector<double> heights{0.0, 1e-6, 1e-3, 0.1};
  const SurfaceMesh surface = icosphere(1);
  const auto c = sphere_case(surface, heights, options);
  const Index n = static_cast<Index>(surface.points.size());

  EXPECT_EQ(c->columns.column_count, surface.faces.size());
  for (Index v = 0; at(v) < c->mesh.vertices.size(); ++v) EXPECT_EQ(c->columns.base[at(v)], v % n);
  std::vector<int> cells_on(c->wall.face_count(), 0);
  for (Index cell = 0; at(cell) < c->mesh.cell_count(); ++cell) {
    const Index slot = c->columns.cell_face_slot[at(cell)];
    ASSERT_NE(slot, k_none);
    ++cells_on[at(slot)];
    const std::array<Index, 4>& foot = c->topology.face2vertex[at(c->wall.faces[at(slot)])];
    for (Index v : c->mesh.cell(cell)) {
      EXPECT_NE(std::find(foot.begin(), foot.end(), v % n), foot.end());
    }
  }
  for (int count : cells_on) EXPECT_EQ(count, 9);
}

TEST(Columns, DoNotStandOnTetsAsHighAsTheirFaces) {
  LayerOptions options;
  options.filling = LayerFilling::tets;
  const SurfaceMesh surface = icosphere(0);
  const auto c = sphere_case(surface, {0.0, 1.1, 2.2}, options);
  const std::size_t n = surface.points.size();

  EXPECT_EQ(c->columns.column_count, 0u);
  for (Index slot : c->columns.cell_face_slot) EXPECT_EQ(slot, k_none);
  for (std::size_t v = 0; v < c->mesh.vertices.size(); ++v) {
    EXPECT_EQ(c->columns.base[v], v < n ? static_cast<Index>(v) : k_none);
  }
}

TEST(Columns, BetweenTwoWallsEndWhereTheyMeet) {
  // Cylinders of radius 1 and 2, five layers between: the third belongs to one of them, never to
  // both.
  const auto around = [](double u, double v) {
    const double angle = 2.0 * std::numbers::pi * u;
    return Vec3(std::cos(angle), std::sin(angle), v);
  };
  LayerOptions options;
  options.outer_entity = 2;
  std::vector<std::unique_ptr<GeometryModel>> parts;
  parts.push_back(make_cylinder(Vec3::Zero(), Vec3::UnitZ(), 1.0));
  parts.push_back(make_cylinder(Vec3::Zero(), Vec3::UnitZ(), 2.0));
  const SurfaceMesh surface = grid(8, 2, around, false, true);
  const auto c = make_case(layers_on(
                               surface, {0.0, 0.2, 0.4, 0.6, 0.8, 1.0},
                               [](const Vec3& x) { return Vec3(x.x(), x.y(), 0.0); }, options),
                           joined(std::move(parts)), 2);
  const Index n = static_cast<Index>(surface.points.size());

  ASSERT_EQ(c->wall.face_count(), 2 * surface.faces.size());
  EXPECT_EQ(c->columns.column_count, 2 * surface.faces.size());
  for (Index v = 0; at(v) < c->mesh.vertices.size(); ++v) {
    const Index layer = v / n;
    EXPECT_EQ(c->columns.base[at(v)], layer <= 2 ? v % n : 5 * n + v % n);
    const double height = layer <= 2 ? 0.2 * layer : 0.2 * (5 - layer);
    EXPECT_NEAR(c->columns.height[at(v)], height, 1e-14);
  }
  std::size_t without = 0;
  for (Index slot : c->columns.cell_face_slot) without += slot == k_none;
  EXPECT_EQ(without, surface.faces.size());
}

}  // namespace
}  // namespace camber
