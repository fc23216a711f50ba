#include "random_wall.hpp"

#include <camber/geom/analytic_model.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <random>

#include <fmt/format.h>

namespace camber::testing {
namespace {

constexpr int k_wall_poles = 13;
/// Of a bump: height over radius. Steeper ones turn by more than a face can follow.
constexpr double k_steepest = 0.3;
/// Layers along normals end before the centres of curvature: radius^2 / (2 height), radius >= 0.15.
constexpr double k_normal_room = 0.12;

/// Uniform numbers; those of the standard library differ from one implementation to the next.
class Dice {
 public:
  explicit Dice(std::uint32_t seed) : generator_(seed) {}
  double between(double low, double high) {
    return low + (high - low) * static_cast<double>(generator_()) / 4294967296.0;
  }
  int pick(int count) { return static_cast<int>(between(0.0, count)); }
  bool toss() { return pick(2) == 1; }

 private:
  std::mt19937 generator_;
};

BsplineSurface random_wall(Dice& dice) {
  struct Bump {
    double x, y, radius, height;
  };
  std::vector<Bump> bumps(static_cast<std::size_t>(2 + dice.pick(4)));
  for (Bump& b : bumps) {
    b.x = dice.between(0.2, 0.8);
    b.y = dice.between(0.2, 0.8);
    b.radius = dice.between(0.15, 0.35);
    b.height = b.radius * dice.between(-k_steepest, k_steepest);
  }
  const auto height = [&](double x, double y) {
    // Two rows of poles at the border stay: the wall meets its side planes at right angles.
    constexpr double border = 0.5 / (k_wall_poles - 3);
    if (std::min({x, y, 1.0 - x, 1.0 - y}) < border) return 0.0;
    double sum = 0.0;
    for (const Bump& b : bumps) {
      const double r2 = (x - b.x) * (x - b.x) + (y - b.y) * (y - b.y);
      sum += b.height * std::exp(-r2 / (b.radius * b.radius));
    }
    return sum;
  };
  return bump(height, k_wall_poles);
}

/// n x n quadrilaterals, inner vertices moved by up to a quarter of the spacing, cut along either
/// diagonal with the given chance.
SurfaceMesh random_grid(Dice& dice, const BsplineSurface& wall, int n, double cut_chance) {
  SurfaceMesh mesh = grid(n, n, [&](double u, double v) {
    const bool is_inside = std::min({u, v, 1.0 - u, 1.0 - v}) > 1e-9;
    const double du = dice.between(-0.25, 0.25) / n, dv = dice.between(-0.25, 0.25) / n;
    return wall.jet(is_inside ? Vec2(u + du, v + dv) : Vec2(u, v)).s;
  });
  std::vector<std::array<Index, 4>> faces;
  for (const auto& [a, b, c, d] : mesh.faces) {
    const bool is_cut = dice.between(0.0, 1.0) < cut_chance, is_turned = dice.toss();
    if (!is_cut) {
      faces.push_back({a, b, c, d});
    } else if (is_turned) {
      faces.push_back({a, b, d, k_none});
      faces.push_back({b, c, d, k_none});
    } else {
      faces.push_back({a, b, c, k_none});
      faces.push_back({a, c, d, k_none});
    }
  }
  mesh.faces = std::move(faces);
  return mesh;
}

}  // namespace

RandomCase random_case(std::uint32_t seed) {
  Dice dice(seed);
  RandomCase random;
  random.seed = seed;
  const BsplineSurface wall = random_wall(dice);
  random.is_all_tets = dice.pick(3) == 0;
  random.is_normal = dice.toss();
  const SurfaceMesh surface =
      random_grid(dice, wall, 4 + dice.pick(4), random.is_all_tets ? 1.0 : 0.5);
  random.edge = mean_edge(surface);
  random.first_over_edge = std::pow(10.0, dice.between(-6.0, -1.0));
  random.growth = dice.between(1.5, 6.0);
  double total = random.edge * dice.between(0.5, 1.5);
  if (random.is_normal) total = std::min(total, k_normal_room);

  LayerOptions layers;
  layers.filling = random.is_all_tets ? LayerFilling::tets : LayerFilling::capped;
  layers.cap_height = dice.between(0.3, 0.6);
  layers.lateral_entity = [](const Vec3& x) {
    if (x.x() < 1e-9) return 11;
    if (x.x() > 1.0 - 1e-9) return 12;
    return x.y() < 1e-9 ? 13 : 14;
  };
  const bool is_normal = random.is_normal;
  const auto direction = [&](const Vec3& x) -> Vec3 {
    if (!is_normal) return Vec3::UnitZ();
    const SurfaceJet jet = wall.jet({x.x(), x.y()});  // x = u, y = v on these walls
    return jet.su.cross(jet.sv).normalized();
  };
  random.mesh = layers_on(
      surface, growing_heights(random.first_over_edge * random.edge, random.growth, total),
      direction, layers);
  random.mesh.source = fmt::format("random case {}", seed);
  random.options.orders.max_order = 2 + dice.pick(3);
  random.options.orders.min_order = dice.toss() ? random.options.orders.max_order : 1;
  random.options.scale = 1.0;
  random.options.smoothing = Smoothing::none;
  random.model = make_bspline_patch(wall);
  return random;
}

std::string RandomCase::text() const {
  return fmt::format("seed {}: first cell {:.1e} of the edge, growth {:.2f}, {}, {}, orders {}..{}",
                     seed, first_over_edge, growth,
                     is_all_tets ? "tets" : "hexes, prisms, pyramids and tets",
                     is_normal ? "along normals" : "straight up", options.orders.min_order,
                     options.orders.max_order);
}

}  // namespace camber::testing
