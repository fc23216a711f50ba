// Carried start on thin layers: nothing may be inverted, whatever the height of the first cell.
#include <camber/elevate/rescue.hpp>
#include <camber/geom/analytic_model.hpp>

#include <algorithm>
#include <cmath>
#include <functional>

#include <gtest/gtest.h>

#include "layer_meshes.hpp"

namespace camber {
namespace {

using namespace testing;

constexpr double k_major = 3.0, k_minor = 1.0;

double hill(double x, double y) {
  const double r2 = (x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5);
  return x <= 0.0 || x >= 1.0 || y <= 0.0 || y >= 1.0 ? 0.0 : 0.15 * std::exp(-r2 / 0.03);
}

struct Body {
  const char* name;
  SurfaceMesh surface;
  std::function<Vec3(const Vec3&)> direction;
  std::function<std::unique_ptr<GeometryModel>()> model;
  LayerOptions options;
};

std::vector<Body> bodies() {
  std::vector<Body> all;
  const auto radial = [](const Vec3& x) -> Vec3 { return x.normalized(); };
  const auto sphere = [] { return make_sphere(Vec3::Zero(), 1.0); };
  const auto cut = [](Body body) {
    body.options.filling = LayerFilling::tets;
    return body;
  };
  all.push_back({"sphere, prisms", icosphere(1), radial, sphere, {}});
  all.push_back(cut({"sphere, tets", icosphere(1), radial, sphere, {}}));
  all.push_back({"sphere, hexes", cubed_sphere(3), radial, sphere, {}});

  const Vec3 axes(3.0, 1.0, 0.5);
  const auto off_ellipsoid = [axes](const Vec3& x) -> Vec3 {
    return x.cwiseQuotient(axes.cwiseProduct(axes)).normalized();
  };
  const auto ellipsoid = [axes] { return make_ellipsoid(Vec3::Zero(), axes); };
  all.push_back({"ellipsoid, prisms", stretched(icosphere(2), axes), off_ellipsoid, ellipsoid, {}});
  all.push_back(
      cut({"ellipsoid, tets", stretched(icosphere(2), axes), off_ellipsoid, ellipsoid, {}}));
  all.push_back(
      {"ellipsoid, hexes", stretched(cubed_sphere(6), axes), off_ellipsoid, ellipsoid, {}});

  const auto to_tube_centre = [](const Vec3& x) -> Vec3 {
    const Vec3 circle = k_major * Vec3(x.x(), x.y(), 0.0).normalized();
    return (circle - x).normalized();
  };
  const auto torus = [] { return make_torus(Vec3::Zero(), Vec3::UnitZ(), k_major, k_minor); };
  all.push_back({"torus inside, hexes",
                 torus_grid(k_major, k_minor, 16, 8, false),
                 to_tube_centre,
                 torus,
                 {}});
  all.push_back({"torus inside, prisms",
                 torus_grid(k_major, k_minor, 16, 8, true),
                 to_tube_centre,
                 torus,
                 {}});

  const auto on_hill = [](double u, double v) {
    static const BsplineSurface surface = bump(hill, 13);
    return surface.jet({u, v}).s;
  };
  LayerOptions sides;
  sides.lateral_entity = [](const Vec3& x) {
    if (x.x() < 1e-9) return 11;
    if (x.x() > 1.0 - 1e-9) return 12;
    return x.y() < 1e-9 ? 13 : 14;
  };
  const auto up = [](const Vec3&) -> Vec3 { return Vec3::UnitZ(); };
  const auto hill_model = [] { return make_bspline_patch(bump(hill, 13)); };
  all.push_back({"bump, hexes", grid(8, 8, on_hill), up, hill_model, sides});
  all.push_back({"bump, prisms", grid(8, 8, on_hill, true), up, hill_model, sides});
  all.push_back(cut({"bump, tets", grid(8, 8, on_hill, true), up, hill_model, sides}));
  return all;
}

std::unique_ptr<Case> layered(const Body& body, double first_over_edge, double ratio = 30.0) {
  const double h = mean_edge(body.surface);
  const double total = body.surface.points.front().norm() > 1.5 * k_minor ? 0.6 * k_minor : 1.5 * h;
  const std::vector<double> heights = growing_heights(first_over_edge * h, ratio, total);
  return make_case(layers_on(body.surface, heights, body.direction, body.options), body.model());
}

class Ladder : public ::testing::TestWithParam<double> {};

TEST_P(Ladder, LeavesNothingInvalidAtOrderFour) {
  for (const Body& body : bodies()) {
    const auto c = layered(body, GetParam());
    const LayerField field = c->field();
    const CurvedMesh curved = carried(*c, field, 4);

    const std::vector<Index> bad = uncertified_cells(curved, all_cells(c->mesh));

    EXPECT_TRUE(bad.empty()) << body.name << ": " << bad.size() << " of " << c->mesh.cell_count();
  }
}

INSTANTIATE_TEST_SUITE_P(FirstCell, Ladder, ::testing::Values(1e-2, 1e-4, 1e-6));

}  // namespace
}  // namespace camber
