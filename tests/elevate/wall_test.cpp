#include <camber/elevate/pinched.hpp>
#include <camber/geom/analytic_model.hpp>

#include <algorithm>

#include <gtest/gtest.h>

#include "layer_meshes.hpp"

namespace camber {
namespace {

using namespace testing;

Vec3 outwards(const Vec3& x) { return x.normalized(); }

TEST(Wall, NormalsPointOutOfTheCells) {
  // Cells outside of the sphere: out of the cells is into the ball. Poles included (vertices 0 and
  // 11).
  for (const SurfaceMesh& surface : {icosphere(1), cubed_sphere(3)}) {
    for (double side : {1.0, -1.0}) {
      const auto c =
          make_case(layers_on(surface, {0.0, 0.1}, [&](const Vec3& x) -> Vec3 { return side * x; }),
                    make_sphere(Vec3::Zero(), 1.0), 2);
      const double sign = -side;
      ASSERT_EQ(c->wall.corners.size(), surface.points.size());
      for (const WallCorner& corner : c->wall.corners) {
        const Vec3 expected = sign * c->mesh.vertices[at(corner.vertex)];
        EXPECT_LT((corner.normal - expected).norm(), 1e-12);
        EXPECT_EQ(corner.face, (GeomEntity{2, 1}));
      }
      for (std::size_t s = 0; s < c->wall.face_count(); ++s) {
        const Index v = c->topology.face2vertex[at(c->wall.faces[s])][0];
        EXPECT_GT(sign * c->wall.facet_normal[s].dot(c->mesh.vertices[at(v)]), 0.5);
      }
    }
  }
}

TEST(Wall, HasEveryFaceAndEdgeOfTheCadOnce) {
  const auto c =
      make_case(layers_on(icosphere(1), {0.0, 0.1}, outwards), make_sphere(Vec3::Zero(), 1.0), 2);
  EXPECT_EQ(c->wall.face_count(), 80u);
  EXPECT_EQ(c->wall.edge_count(), 120u);
  for (std::size_t s = 0; s < c->wall.face_count(); ++s) {
    EXPECT_EQ(c->wall.face_slot[at(c->wall.faces[s])], static_cast<Index>(s));
  }
  for (const auto& [a, b] : c->wall.edge_faces) {
    EXPECT_NE(a, k_none);
    EXPECT_NE(b, k_none);
    EXPECT_NE(a, b);
  }
}

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

}  // namespace
}  // namespace camber
