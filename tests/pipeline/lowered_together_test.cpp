// Thin wall faces give up their shape with the face that they share a long edge with.
#include <camber/geom/analytic_model.hpp>
#include <camber/pipeline/detail/lowered_together.hpp>
#include <camber/pipeline/wall_repair.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <numeric>

#include <gtest/gtest.h>

#include "bodies.hpp"

namespace camber {
namespace {

using Caps = std::vector<std::pair<Index, int>>;

/// A bump with a band of thin faces along its slopes, as where thin layers end on a wall.
class LoweredTogether : public ::testing::Test {
 protected:
  LoweredTogether() {
    const auto rise = [](double x) { return 0.3 * std::pow(std::sin(std::numbers::pi * x), 2); };
    const BsplineSurface surface = testing::bump([&](double x, double) { return rise(x); }, 9);
    // Uneven rows across: three of them 500 times thinner than wide.
    const auto across = [](double v) {
      const double rows[] = {0.0, 0.2, 0.4, 0.4005, 0.401, 0.4015, 0.6, 0.8, 1.0};
      return rows[static_cast<int>(std::lround(8.0 * v))];
    };
    const testing::SurfaceMesh faces = testing::grid(4, 8, [&](double u, double v) {
      return surface.jet({u, across(v)}).s;
    });
    c_ = testing::make_case(
        testing::layers_on(faces, {0.0, 0.1, 0.3}, [](const Vec3&) { return Vec3::UnitZ(); }),
        make_bspline_patch(surface));
  }

  Caps spread(const Caps& caps) const {
    return lowered_together(c_->mesh, c_->topology, c_->association, c_->wall, *c_->placement,
                            caps);
  }

  /// Height of a wall face: its area over its longest edge.
  double height(Index slot) const {
    const auto& v = c_->topology.face2vertex[at(c_->wall.faces[at(slot)])];
    const auto x = [&](int i) { return c_->mesh.vertices[at(v[at(i % 4)])]; };
    double longest = 0.0;
    for (int i = 0; i < 4; ++i) longest = std::max(longest, (x(i + 1) - x(i)).norm());
    return 0.5 * (x(2) - x(0)).cross(x(3) - x(1)).norm() / longest;
  }

  Index thinnest() const {
    Index found = 0;
    for (Index s = 0; at(s) < c_->wall.face_count(); ++s) {
      if (height(s) < height(found)) found = s;
    }
    return found;
  }

  std::unique_ptr<testing::Case> c_;
};

TEST_F(LoweredTogether, TakesTheThinStackAndLeavesHighFacesAlone) {
  const Index first = thinnest();
  const Caps caps = spread({{first, 1}});
  ASSERT_GT(caps.size(), 2u);
  ASSERT_LT(caps.size(), c_->wall.face_count() / 2);
  const double moved = c_->placement->largest_displacement();
  for (const auto& [slot, cap] : caps) {
    EXPECT_EQ(cap, 1);
    EXPECT_TRUE(slot == first || height(slot) < 4.0 * moved) << slot;
  }
  EXPECT_TRUE(
      std::any_of(caps.begin(), caps.end(), [&](const auto& c) { return c.first == first; }));
}

TEST_F(LoweredTogether, IsClosed) {
  const Caps caps = spread({{thinnest(), 1}});
  EXPECT_EQ(spread(caps), caps);
}

TEST_F(LoweredTogether, HasNothingToAddWhereTheFacesAreStraightAlready) {
  const Caps caps = spread({{thinnest(), 1}});
  c_->placement->lower(caps);
  EXPECT_EQ(spread({{thinnest(), 1}}).size(), 1u);
}

TEST_F(LoweredTogether, LowersLessWhereTheCapMovesEdgesLess) {
  EXPECT_LE(spread({{thinnest(), 3}}).size(), spread({{thinnest(), 1}}).size());
}

TEST_F(LoweredTogether, SmoothingLeavesLoweredFacesAlone) {
  Placement& placement = *c_->placement;
  std::vector<Index> all(c_->wall.face_count());
  std::iota(all.begin(), all.end(), 0);
  const Index slot = thinnest();
  placement.lower({{slot, 1}});
  const auto shape = [&] {
    const std::span<const Vec3> d = placement.face_displacement(slot, placement.max_order());
    return Points(d.begin(), d.end());
  };
  const Points before = shape();
  const std::vector<Index> changed = smooth_wall_faces(c_->mesh, c_->topology, c_->association,
                                                       *c_->model, c_->wall, placement, all);
  ASSERT_FALSE(changed.empty());
  EXPECT_FALSE(std::binary_search(changed.begin(), changed.end(), slot));
  EXPECT_EQ(shape(), before);
}

TEST_F(LoweredTogether, RingsShareAVertex) {
  const std::vector<Index> ring = with_wall_ring(c_->mesh, c_->topology, c_->wall, {thinnest()});
  const auto corners = [&](Index slot) {
    const auto& v = c_->topology.face2vertex[at(c_->wall.faces[at(slot)])];
    return std::vector<Index>(v.begin(), v.end());
  };
  const std::vector<Index> own = corners(thinnest());
  for (Index s = 0; at(s) < c_->wall.face_count(); ++s) {
    const std::vector<Index> other = corners(s);
    const bool is_near = std::any_of(other.begin(), other.end(), [&](Index v) {
      return std::find(own.begin(), own.end(), v) != own.end();
    });
    EXPECT_EQ(std::binary_search(ring.begin(), ring.end(), s), is_near) << s;
  }
}

}  // namespace
}  // namespace camber
