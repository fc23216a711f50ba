// Against the kernel's slow general distance (vertex to face), the naive reference.
#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeVertex.hxx>
#include <BRepExtrema_DistShapeShape.hxx>
#include <TopExp.hxx>
#include <TopTools_IndexedMapOfShape.hxx>
#include <gp_Pnt.hxx>

#include "sample_bodies.hpp"

namespace camber {
namespace {

class FacesOf : public testing::TestWithParam<TopoDS_Shape (*)()> {};

TEST_P(FacesOf, ASampleAreNoFartherThanTheKernelSays) {
  const TopoDS_Shape shape = GetParam()();
  const auto model = test::round_trip(shape);
  const auto projector = model->projector();
  TopTools_IndexedMapOfShape faces;
  TopExp::MapShapes(shape, TopAbs_FACE, faces);
  ASSERT_EQ(faces.Extent(), model->count(2));
  for (int f = 1; f <= faces.Extent(); ++f) {
    for (const Vec3& x : test::random_points(model->box({2, f}), 12)) {
      const BRepExtrema_DistShapeShape reference(
          BRepBuilderAPI_MakeVertex(gp_Pnt(x[0], x[1], x[2])).Shape(), faces(f));
      const Projection p = projector->closest({2, f}, x);
      EXPECT_NEAR(p.distance, reference.Value(), 3e-7)
          << "face " << f << " point " << x.transpose();
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Bodies, FacesOf,
                         testing::Values(&test::drilled_cylinder, &test::drilled_plate,
                                         &test::wavy_face, &test::wavy_face_with_hole));

}  // namespace
}  // namespace camber
