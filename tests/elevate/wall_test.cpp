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

}  // namespace
}  // namespace camber
