#include <camber/basis/lattice.hpp>
#include <camber/page/cut_table.hpp>

#include <stdexcept>

#include <gtest/gtest.h>

namespace camber {
namespace {

constexpr std::array<Shape, 4> k_volumes{Shape::tetrahedron, Shape::pyramid, Shape::prism,
                                         Shape::hexahedron};

const Vec3& point(Shape shape, int level, int node) {
  return lattice_xi(shape, level)[static_cast<std::size_t>(node)];
}

TEST(CutTable, TetrahedraFillTheShape) {
  for (Shape shape : k_volumes) {
    for (int level = 1; level <= 6; ++level) {
      double volume = 0.0;
      for (const auto& t : lattice_tetrahedra(shape, level)) {
        const Vec3 a = point(shape, level, t[0]);
        const double six = (point(shape, level, t[1]) - a)
                               .cross(point(shape, level, t[2]) - a)
                               .dot(point(shape, level, t[3]) - a);
        EXPECT_GT(six, 0.0);
        volume += six / 6.0;
      }
      EXPECT_NEAR(volume, reference_measure(shape), 1e-13) << name(shape) << ' ' << level;
    }
  }
}

TEST(CutTable, HasAsManyTetrahedraAsDocumented) {
  EXPECT_EQ(lattice_tetrahedra(Shape::hexahedron, 3).size(), 6u * 27u);
  EXPECT_EQ(lattice_tetrahedra(Shape::prism, 3).size(), 3u * 27u);
  EXPECT_EQ(lattice_tetrahedra(Shape::pyramid, 3).size(), 2u * 27u);
  EXPECT_EQ(lattice_tetrahedra(Shape::tetrahedron, 3).size(), 27u);
}

/// Divergence theorem: the skin encloses the volume once, looking outwards.
TEST(CutTable, SkinEnclosesTheShape) {
  for (Shape shape : k_volumes) {
    for (int level : {1, 2, 4}) {
      double volume = 0.0;
      for (const auto& t : skin(lattice_tetrahedra(shape, level))) {
        const Vec3 a = point(shape, level, t[0]), b = point(shape, level, t[1]);
        volume += a.dot(b.cross(point(shape, level, t[2]))) / 6.0;
      }
      EXPECT_NEAR(volume, reference_measure(shape), 1e-13) << name(shape) << ' ' << level;
    }
  }
  // Two triangles a square, n^2 a triangle: tet 4 n^2, pyramid 6 n^2, prism 8 n^2, hex 12 n^2.
  EXPECT_EQ(skin(lattice_tetrahedra(Shape::pyramid, 3)).size(), 54u);
  EXPECT_EQ(skin(lattice_tetrahedra(Shape::prism, 3)).size(), 72u);
}

TEST(CutTable, TrianglesFillTheFaceCounterClockwise) {
  for (Shape shape : {Shape::triangle, Shape::quadrilateral}) {
    for (int level = 1; level <= 5; ++level) {
      double area = 0.0;
      for (const auto& t : lattice_triangles(shape, level)) {
        const Vec3 a = point(shape, level, t[0]);
        const double twice =
            (point(shape, level, t[1]) - a).cross(point(shape, level, t[2]) - a).z();
        EXPECT_GT(twice, 0.0);
        area += twice / 2.0;
      }
      EXPECT_NEAR(area, reference_measure(shape), 1e-13);
    }
  }
}

TEST(CutTable, RefusesOtherShapes) {
  EXPECT_THROW((void)lattice_tetrahedra(Shape::triangle, 2), std::invalid_argument);
  EXPECT_THROW((void)lattice_tetrahedra(Shape::prism, 0), std::invalid_argument);
  EXPECT_THROW((void)lattice_triangles(Shape::hexahedron, 2), std::invalid_argument);
}

}  // namespace
}  // namespace camber
