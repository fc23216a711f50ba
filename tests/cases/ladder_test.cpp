// The ladder of bench/ on its smallest cases: its numbers are those of the mesh.
#include "ladder.hpp"

#include <camber/elevate/rescue.hpp>
#include <camber/validity/element_validity.hpp>

#include <cmath>
#include <map>

#include <gtest/gtest.h>

namespace camber {
namespace {

using namespace testing;

TEST(Ladder, CarriedStartOfASphereNeedsNoRescue) {
  const LadderRow row =
      climb_ladder(body_case("sphere", "hexes", CaseSize::small), {1e-3, 3, Propagation::layer});

  EXPECT_EQ(row.error, "");
  EXPECT_GT(row.cells, 100u);
  EXPECT_EQ(row.invalid_at_start, 0u);
  EXPECT_TRUE(row.is_certified());
  EXPECT_FALSE(row.is_rescued());
  EXPECT_GT(row.min_jacobian_ratio, 0.0);
  EXPECT_EQ(row.start.minimum, row.end.minimum) << "nothing was done to it";
  EXPECT_EQ(row.start.mean, row.end.mean);
  EXPECT_GT(row.certify_s, 0.0);
}

TEST(Ladder, StartOfTheWallCellsAloneIsTangledAndRescued) {
  const LadderRow row =
      climb_ladder(body_case("sphere", "prisms", CaseSize::small), {1e-2, 2, Propagation::cell});

  EXPECT_EQ(row.error, "");
  EXPECT_GT(row.invalid_at_start, 0u);
  EXPECT_LT(row.start.minimum, 0.0);
  EXPECT_TRUE(row.is_certified());
  EXPECT_TRUE(row.is_rescued());
  EXPECT_GT(row.end.minimum, 0.0);
}

TEST(Ladder, ErrorsOfTheLibraryAreWordsInTheRow) {
  BodyCase wrong = body_case("sphere", "hexes", CaseSize::small);
  wrong.model = body_case("torus-inside", "hexes", CaseSize::small).model;

  const LadderRow row = climb_ladder(wrong, {});

  EXPECT_NE(row.error, "");
  EXPECT_FALSE(row.is_certified());
}

TEST(Bodies, HaveLinearCellsThatAreAllValidDownToTheThinnestLayer) {
  for (const BodyCase& body : body_cases(CaseSize::small)) {
    for (double first : {1e-1, 1e-7}) {
      EXPECT_NO_THROW({
        const LinearMesh mesh = build_linear_mesh(body.mesh(first));
        EXPECT_GT(mesh.cell_count(), 20u);
      }) << body.body
         << ", " << body.filling << ", first cell " << first;
    }
  }
}

TEST(Bodies, WithCapsHoldHexesPyramidsAndTetsWithoutAGap) {
  const auto c = [&] {
    const BodyCase body = body_case("sphere", "caps", CaseSize::small);
    return make_case(body.mesh(1e-2), body.model());
  }();
  std::map<Shape, int> count;
  for (Shape shape : c->mesh.cell_shape) ++count[shape];

  EXPECT_EQ(count[Shape::pyramid], 54);
  EXPECT_EQ(count[Shape::tetrahedron], 108) << "one an edge";
  EXPECT_GT(count[Shape::hexahedron], 54);
  std::size_t boundary = 0;
  for (const auto& sides : c->topology.face2cell) boundary += sides[1] == k_none ? 1U : 0U;
  EXPECT_EQ(boundary, 54u + 216u) << "wall, and two triangles a tet outside";
}

TEST(Bodies, RoundedEdgeIsAnEllipseContinuedByStraightSides) {
  constexpr double a = 2.0, b = 0.5, flat = 3.0;
  const BsplineSurface edge = rounded_edge(a, b, flat, 1.0);
  for (int i = 0; i <= 40; ++i) {
    const SurfaceJet jet = edge.jet({0.1 * i, 0.3});
    EXPECT_NEAR(jet.s.y(), 0.3, 1e-15);
    if (jet.s.x() > 0.0) {
      EXPECT_NEAR(std::abs(jet.s.z()), b, 1e-15);
    } else {
      EXPECT_NEAR(std::hypot(jet.s.x() / a, jet.s.z() / b), 1.0, 1e-14);
    }
    EXPECT_GT(jet.su.cross(jet.sv).dot(jet.s - Vec3(4.0, 0.3, 0.0)), 0.0) << "outwards";
  }
}

}  // namespace
}  // namespace camber
