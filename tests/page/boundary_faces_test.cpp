#include <camber/page/boundary_faces.hpp>

#include <gtest/gtest.h>

#include "round_block.hpp"

namespace camber {
namespace {

TEST(BoundaryFaces, AreThoseOfOneCellOnly) {
  const MeshData data = test::round_block(3, 2);
  const ElementList cells(data, 3), surfaces(data, 2);

  const std::vector<BoundaryFace> faces = boundary_faces(cells, surfaces);

  EXPECT_EQ(faces.size(), 6u * 9u);  // 3 x 3 on each side of the block
}

TEST(BoundaryFaces, KnowTheSurfaceElementThatLiesOnThem) {
  const MeshData data = test::round_block(2, 3);
  const ElementList cells(data, 3), surfaces(data, 2);
  Points nodes;

  std::size_t linked = 0;
  for (const BoundaryFace& face : boundary_faces(cells, surfaces)) {
    if (face.surface == k_none) continue;
    ++linked;
    EXPECT_EQ(gather_face(cells, face, nodes), Shape::quadrilateral);
    Vec3 centre = Vec3::Zero();
    for (Index n : face_corners(cells, face)) centre += data.points[at(n)] / 4.0;
    EXPECT_LT((centre - surfaces.centre(at(face.surface))).norm(), 1e-14);
  }
  EXPECT_EQ(linked, 4u);
}

TEST(BoundaryFaces, LookOutwards) {
  const MeshData data = test::round_block(2, 2);
  const ElementList cells(data, 3), surfaces(data, 2);

  for (const BoundaryFace& face : boundary_faces(cells, surfaces)) {
    const std::array<Index, 4> c = face_corners(cells, face);
    const Vec3 a = data.points[at(c[0])], b = data.points[at(c[1])], d = data.points[at(c[3])];
    EXPECT_GT((b - a).cross(d - a).dot(a), 0.0);  // the centre of the ball is the origin
  }
}

}  // namespace
}  // namespace camber
