#include <array>
#include <thread>

#include <gtest/gtest.h>

#include "sample_bodies.hpp"

namespace camber {
namespace {

/// Global, seeded, directional and curve answers at many points, as raw numbers.
std::vector<double> ask(const GeometryModel& model) {
  const auto projector = model.projector();
  std::vector<double> result;
  const auto note = [&](const Projection& p) {
    result.insert(result.end(), {p.point[0], p.point[1], p.point[2], p.uv[0], p.uv[1], p.distance});
  };
  for (int f = 1; f <= model.count(2); ++f) {
    for (const Vec3& x : test::random_points(model.box({2, f}), 12)) {
      const Projection p = projector->closest({2, f}, x);
      note(p);
      note(projector->closest({2, f}, x + Vec3::Constant(0.01), p.uv));
      if (const auto hit = projector->along_line(f, x, {0.1, 0.3, 1.0}, 3.0)) note(*hit);
    }
  }
  for (int c = 1; c <= model.count(1); ++c) {
    const auto range = model.range(c);
    std::array<Projection, 3> points;
    projector->divide_curve(c, range.first, range.last, std::array{0.2, 0.5, 0.9}, points);
    for (const Projection& p : points) note(p);
  }
  return result;
}

TEST(Projectors, InTwoThreadsGiveTheBitsOfOne) {
  for (const TopoDS_Shape& shape : {test::drilled_cylinder(), test::wavy_face_with_hole()}) {
    const std::vector<double> alone = ask(*test::round_trip(shape));
    const auto shared =
        test::round_trip(shape);  // nothing built yet: both threads race to the first use
    std::array<std::vector<double>, 2> answers;
    std::thread other([&] { answers[1] = ask(*shared); });
    answers[0] = ask(*shared);
    other.join();
    EXPECT_EQ(answers[0], alone);
    EXPECT_EQ(answers[1], alone);
  }
}

TEST(Projectors, AnswerTheSameInAnyOrderOfQuestions) {
  const auto model = test::round_trip(test::wavy_face());
  const std::vector<Vec3> points = test::random_points(model->box(), 40);
  const auto forwards = model->projector(), backwards = model->projector();
  std::vector<Projection> first, second(points.size());
  for (const Vec3& x : points) first.push_back(forwards->closest({2, 1}, x));
  for (std::size_t i = points.size(); i-- > 0;) second[i] = backwards->closest({2, 1}, points[i]);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(first[i].point, second[i].point);
    EXPECT_EQ(first[i].uv, second[i].uv);
  }
}

TEST(Projectors, OutliveTheirModel) {
  auto model = test::round_trip(test::sphere(1.0));
  const auto projector = model->projector();
  model.reset();
  EXPECT_NEAR(projector->closest({2, 1}, {0, 3, 0}).distance, 2.0, 1e-12);
}

}  // namespace
}  // namespace camber
