#include <camber/basis/lagrange.hpp>
#include <camber/basis/lattice.hpp>
#include <camber/reconstruct/detail/facet_patch.hpp>

#include <cmath>

#include <gtest/gtest.h>

namespace camber::detail {
namespace {

constexpr Shape k_shapes[] = {Shape::triangle, Shape::quadrilateral};

Points wavy_nodes(Shape shape) {
  Points nodes;
  for (const Vec3& xi : lattice_xi(shape, k_patch_order)) {
    nodes.emplace_back(xi.x() + 0.05 * std::sin(3.0 * xi.y()), 2.0 * xi.y(),
                       0.3 * std::sin(2.0 * xi.x()) * std::cos(xi.y()));
  }
  return nodes;
}

TEST(FacetPatch, IsTheLagrangePolynomialOfItsNodes) {
  for (Shape shape : k_shapes) {
    const Points nodes = wavy_nodes(shape);
    const FacetPatch patch(shape, nodes);
    for (const Vec2& uv : {Vec2(0.1, 0.2), Vec2(0.7, 0.25), Vec2(0.0, 1.0), Vec2(-0.2, 0.4)}) {
      const Vec3 x = evaluate(shape, k_patch_order, nodes, Vec3(uv.x(), uv.y(), 0.0));
      EXPECT_NEAR((patch.jet(uv).s - x).norm(), 0.0, 1e-12);
    }
    for (const Vec3& xi : lattice_xi(shape, 9)) {
      const Vec3 x = patch.jet(xi.head<2>()).s;
      EXPECT_TRUE((x.array() >= patch.box().lower.array() - 1e-14).all() &&
                  (x.array() <= patch.box().upper.array() + 1e-14).all());
    }
  }
}

TEST(FacetPatch, DerivativesAreThoseOfItsPoints) {
  const double h = 1e-4;
  for (Shape shape : k_shapes) {
    const FacetPatch patch(shape, wavy_nodes(shape));
    const Vec2 uv(0.3, 0.4), du(h, 0.0), dv(0.0, h);
    const auto x = [&](const Vec2& p) { return patch.jet(p).s; };
    const SurfaceJet s = patch.jet(uv);
    EXPECT_NEAR((s.su - (x(uv + du) - x(uv - du)) / (2 * h)).norm(), 0.0, 1e-7);
    EXPECT_NEAR((s.sv - (x(uv + dv) - x(uv - dv)) / (2 * h)).norm(), 0.0, 1e-7);
    EXPECT_NEAR((s.suu - (x(uv + du) - 2 * x(uv) + x(uv - du)) / (h * h)).norm(), 0.0, 1e-6);
    EXPECT_NEAR((s.svv - (x(uv + dv) - 2 * x(uv) + x(uv - dv)) / (h * h)).norm(), 0.0, 1e-6);
    const Vec3 mixed =
        (x(uv + du + dv) - x(uv + du - dv) - x(uv - du + dv) + x(uv - du - dv)) / (4 * h * h);
    EXPECT_NEAR((s.suv - mixed).norm(), 0.0, 1e-6);
  }
}

TEST(FacetPatch, FindsTheNearestPointInsideAndOnItsEdges) {
  for (Shape shape : k_shapes) {
    const FacetPatch patch(shape, wavy_nodes(shape));
    for (const Vec3& x : {Vec3(0.3, 0.5, 0.4), Vec3(0.9, 1.9, 0.1), Vec3(-0.5, 0.3, 0.0),
                          Vec3(0.2, -1.0, 0.2), Vec3(1.4, 0.1, 0.5)}) {
      const SurfaceFoot foot = patch.closest(x, std::nullopt);
      double nearest = 1e300;  // naive: a fine lattice
      for (const Vec3& xi : lattice_xi(shape, 31)) {
        nearest = std::min(nearest, (patch.jet(xi.head<2>()).s - x).norm());
      }
      EXPECT_LE(std::sqrt(foot.distance_squared), nearest + 1e-12);
      EXPECT_GE(std::sqrt(foot.distance_squared), nearest - 2e-2);
      EXPECT_GE(foot.uv.minCoeff(), 0.0);
      EXPECT_LE(shape == Shape::triangle ? foot.uv.sum() : foot.uv.maxCoeff(), 1.0 + 1e-15);
    }
  }
}

TEST(FacetPatch, MeetsALineOnlyInside) {
  for (Shape shape : k_shapes) {
    const FacetPatch patch(shape, wavy_nodes(shape));
    const Vec2 uv(0.2, 0.3);
    const SurfaceJet s = patch.jet(uv);
    const Vec3 d = Vec3(0.1, -0.2, 1.0).normalized();
    const auto hit = patch.crossing(s.s - 0.3 * d, d, std::nullopt);
    ASSERT_TRUE(hit);
    EXPECT_NEAR((hit->uv - uv).norm(), 0.0, 1e-10);
    EXPECT_FALSE(patch.crossing(patch.jet({1.3, 1.2}).s - 0.3 * d, d, std::nullopt));
  }
}

}  // namespace
}  // namespace camber::detail
