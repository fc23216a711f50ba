#include <camber/base/error.hpp>
#include <camber/geom/primitive.hpp>

#include <gtest/gtest.h>

namespace camber {
namespace {

double distance(const std::string& text, const Vec3& x) {
  return make_primitive(text)->projector()->closest({2, 1}, x).distance;
}

TEST(Primitive, HasTheSizeAndPlaceThatItsNumbersSay) {
  EXPECT_NEAR(distance("sphere:1,2,3,0.5", {1.0, 2.0, 5.0}), 1.5, 1e-12);
  EXPECT_NEAR(distance("ellipsoid:0,0,0,3,1,0.5", {4.0, 0.0, 0.0}), 1.0, 1e-12);
  EXPECT_NEAR(distance("ellipsoid:0,0,0,3,1,0.5", {0.0, 0.0, 2.0}), 1.5, 1e-12);
  EXPECT_NEAR(distance("cylinder:0,0,-1,0,0,2,0.25", {1.0, 0.0, 0.3}), 0.75, 1e-12);
  EXPECT_NEAR(distance("cylinder:0,0,-1,0,0,2,0.25", {0.25, 0.0, 3.0}), 2.0, 1e-12);
  EXPECT_NEAR(distance("torus:0,0,0,0,0,1,2,0.5", {2.0, 0.0, 0.0}), 0.5, 1e-12);
  EXPECT_NEAR(distance("torus:0,0,0,1,0,0,2,0.5", {0.0, 0.0, 3.0}), 0.5, 1e-12);
}

TEST(Primitive, IsToldFromAPathByItsKind) {
  EXPECT_TRUE(is_primitive("sphere:0,0,0,1"));
  EXPECT_TRUE(is_primitive("torus:"));
  EXPECT_FALSE(is_primitive("sphere.step"));
  EXPECT_FALSE(is_primitive("box:1,2"));
  EXPECT_FALSE(is_primitive("C:/sphere:0"));
}

TEST(Primitive, RefusesWhatMakesNoSurface) {
  for (const char* text :
       {"sphere:", "sphere:0,0,0", "sphere:0,0,0,1,2", "sphere:0,0,x,1", "sphere:0,0,0,-1",
        "sphere:0,0,0,nan", "sphere:0,0,0,1 ", "ellipsoid:0,0,0,1,0,1", "cylinder:0,0,0,0,0,0,1",
        "cylinder:0,0,0,0,0,1,0", "torus:0,0,0,0,0,1,1,1", "torus:0,0,0,0,0,1,1,inf", "box:1"}) {
    EXPECT_THROW((void)make_primitive(text), OptionError) << text;
  }
}

}  // namespace
}  // namespace camber
