#include <camber/elevate/pinched.hpp>
#include <camber/geom/analytic_model.hpp>
#include <camber/pipeline/curve.hpp>

#include <gtest/gtest.h>

#include "layer_meshes.hpp"

namespace camber {
namespace {

using testing::make_case;

/// Octahedron in a sphere: eight tets around its centre, or four around an axis, each of which has
/// two faces on the sphere.
MeshData ball_of_tets(bool with_pinched) {
  MeshData data;
  data.source = "ball";
  data.points = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  ElementBlock tets{Shape::tetrahedron, 1, 1, {}, {}}, wall{Shape::triangle, 1, 1, {}, {}};
  const auto add = [&](Index a, Index b, Index c, Index d) {
    const Vec3& o = data.points[at(a)];
    const double volume =
        (data.points[at(b)] - o).cross(data.points[at(c)] - o).dot(data.points[at(d)] - o);
    if (volume < 0.0) std::swap(b, c);
    tets.nodes.insert(tets.nodes.end(), {a, b, c, d});
  };
  if (!with_pinched) data.points.emplace_back(0, 0, 0);
  for (Index x : {0, 1}) {
    for (Index y : {2, 3}) {
      for (Index z : {4, 5}) {
        wall.nodes.insert(wall.nodes.end(), {x, y, z});
        if (!with_pinched) add(6, x, y, z);
      }
      if (with_pinched) add(4, 5, x, y);
    }
  }
  data.blocks = {tets, wall};
  return data;
}

TEST(Pinched, FindsTetsWithTwoFacesOnOneSurface) {
  const auto pinched = make_case(ball_of_tets(true), make_sphere(Vec3::Zero(), 1.0), 2);
  EXPECT_EQ(
      find_pinched_cells(pinched->mesh, pinched->topology, pinched->association, pinched->wall),
      (std::vector<Index>{0, 1, 2, 3}));
}

TEST(Pinched, FindsNothingWhereEveryCellHasAnInnerVertex) {
  const auto sound = make_case(ball_of_tets(false), make_sphere(Vec3::Zero(), 1.0), 2);
  EXPECT_TRUE(
      find_pinched_cells(sound->mesh, sound->topology, sound->association, sound->wall).empty());
}

TEST(Pinched, EdgesBehindThemAreOppositeToTheEdgeTheirWallFacesShare) {
  const auto c = make_case(ball_of_tets(true), make_sphere(Vec3::Zero(), 1.0), 2);
  // Each tet has the wall faces (x, y, 4) and (x, y, 5): they share xy, behind it is the axis.
  const std::vector<Index> axis{c->topology.find_edge(4, 5)};
  EXPECT_EQ(edges_behind_pinched_tets(c->mesh, c->topology, c->wall, {0, 1, 2, 3}), axis);
}

TEST(Pinched, IsMendedByChangingTheInsideOnly) {
  for (int order = 2; order <= 4; ++order) {
    CurveOptions options;
    options.orders.max_order = order;
    options.split_pinched = true;
    const std::unique_ptr<GeometryModel> sphere = make_sphere(Vec3::Zero(), 1.0);
    const CurveResult result = curve(ball_of_tets(true), *sphere, options);
    const Report& report = result.report;
    EXPECT_EQ(report.rescue.edges_removed, 1u);
    EXPECT_EQ(report.rescue.pinched, 0u);
    EXPECT_EQ(report.rescue.orders_lowered + report.rescue.scaled_back, 0u);
    EXPECT_EQ(report.validity.certified, 8u);
    EXPECT_EQ(result.linear->patch_face_shape.size(), 8u);
    EXPECT_LT(report.surface.maximum, 0.4 * report.surface.linear_maximum);
  }
}

TEST(Pinched, IsNamedWhereTheMeshMustStay) {
  const std::unique_ptr<GeometryModel> sphere = make_sphere(Vec3::Zero(), 1.0);
  const CurveResult result = curve(ball_of_tets(true), *sphere, {});
  EXPECT_EQ(result.report.rescue.pinched, 4u);
  EXPECT_EQ(result.report.exit_code, 3);
  EXPECT_EQ(result.report.validity.certified, 4u);
}

}  // namespace
}  // namespace camber
