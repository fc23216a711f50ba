#include "bodies.hpp"

#include <camber/geom/analytic_model.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>

namespace camber::testing {
namespace {

constexpr double k_pi = std::numbers::pi;
/// Layers reach this many surface edges into the volume; under caps less, so that these are moved.
constexpr double k_thickness = 1.5, k_thickness_under_caps = 0.4;

/// A surface with its meshes and what stands on it.
struct Body {
  std::string name;
  SurfaceMesh triangles, quads;
  std::function<Vec3(const Vec3&)> direction;
  std::function<std::unique_ptr<GeometryModel>()> model;
  double room = std::numeric_limits<double>::infinity();  // longest way along `direction`
  LayerOptions options = {};
};

BodyCase filled(const Body& body, const std::string& filling, double growth) {
  const SurfaceMesh& surface =
      filling == "prisms" || filling == "tets" ? body.triangles : body.quads;
  const double edge = mean_edge(surface);
  LayerOptions options = body.options;
  if (filling == "tets") options.filling = LayerFilling::tets;
  if (filling == "caps") options.filling = LayerFilling::capped;
  const double thickness = filling == "caps" ? k_thickness_under_caps : k_thickness;
  const double total = std::min(thickness * edge, body.room);
  const auto mesh = [=, direction = body.direction](double first_over_edge) {
    return layers_on(surface, growing_heights(first_over_edge * edge, growth, total), direction,
                     options);
  };
  return {body.name, filling, edge, mesh, body.model};
}

std::function<Vec3(const Vec3&)> off_ellipsoid(const Vec3& axes, double sign) {
  return [axes, sign](const Vec3& x) -> Vec3 {
    return sign * x.cwiseQuotient(axes.cwiseProduct(axes)).normalized();
  };
}

Body sphere(bool is_full) {
  return {"sphere", icosphere(is_full ? 2 : 1), cubed_sphere(is_full ? 8 : 3),
          [](const Vec3& x) -> Vec3 { return x.normalized(); },
          [] { return make_sphere(Vec3::Zero(), 1.0); }};
}

Body ellipsoid(bool is_full, bool is_inside) {
  const Vec3 axes(3.0, 1.0, 0.5);
  const double sharpest = axes.z() * axes.z() / axes.x();  // radius of curvature, at the long ends
  Body body{
      is_inside ? "ellipsoid-inside" : "ellipsoid", stretched(icosphere(is_full ? 3 : 2), axes),
      stretched(cubed_sphere(is_full ? 10 : 6), axes), off_ellipsoid(axes, is_inside ? -1.0 : 1.0),
      [axes] { return make_ellipsoid(Vec3::Zero(), axes); }};
  if (is_inside) body.room = 0.6 * sharpest;
  if (is_inside) body.options.cap_height = 0.1;
  return body;
}

Body torus_inside(bool is_full) {
  static constexpr double major = 3.0, minor = 1.0;
  const int n = is_full ? 12 : 8;
  Body body{"torus-inside", torus_grid(major, minor, 2 * n, n, true),
            torus_grid(major, minor, 2 * n, n, false),
            [](const Vec3& x) -> Vec3 {
              const Vec3 circle = major * Vec3(x.x(), x.y(), 0.0).normalized();
              return (circle - x).normalized();
            },
            [] { return make_torus(Vec3::Zero(), Vec3::UnitZ(), major, minor); }};
  body.room = 0.6 * minor;
  return body;
}

Body hill(bool is_full) {
  const auto height = [](double x, double y) {
    const double r2 = (x - 0.5) * (x - 0.5) + (y - 0.5) * (y - 0.5);
    return x <= 0.0 || x >= 1.0 || y <= 0.0 || y >= 1.0 ? 0.0 : 0.15 * std::exp(-r2 / 0.03);
  };
  constexpr int poles = 13;
  const BsplineSurface surface = bump(height, poles);
  const auto on_surface = [&](double u, double v) { return surface.jet({u, v}).s; };
  const int n = is_full ? 14 : 8;
  Body body{"bump", grid(n, n, on_surface, true), grid(n, n, on_surface),
            [](const Vec3&) -> Vec3 { return Vec3::UnitZ(); },
            [height] { return make_bspline_patch(bump(height, poles)); }};
  body.options.lateral_entity = [](const Vec3& x) {
    if (x.x() < 1e-9) return 11;
    if (x.x() > 1.0 - 1e-9) return 12;
    return x.y() < 1e-9 ? 13 : 14;
  };
  return body;
}

/// @param nose  vertices of the section on the ellipse, from below to above
/// @param side  vertices on each flat side
Body edge_body(const std::string& name, double a, double b, double flat, double span, int nose,
               int side, int along) {
  const auto section = [=](double s) -> Vec3 {  // s counts edges from the lower end
    const double t = (s - side) / nose;
    if (t < 0.0 || t > 1.0) {
      const double away = t < 0.0 ? (side - s) / side : (s - side - nose) / side;
      return {flat * away, 0.0, t < 0.0 ? -b : b};
    }
    const double angle = k_pi * (t - 0.5);
    // The ends of the nose are exactly above and below x = 0, where the layers may end.
    return {t == 0.0 || t == 1.0 ? 0.0 : -a * std::cos(angle), 0.0, b * std::sin(angle)};
  };
  const int n = nose + 2 * side;
  const auto point = [=](double u, double v) -> Vec3 {
    return section(std::round(u * n)) + v * span * Vec3::UnitY();
  };
  Body body{name, grid(n, along, point, true), grid(n, along, point),
            [=](const Vec3& x) -> Vec3 {
              if (x.x() >= 0.0) return std::copysign(1.0, x.z()) * Vec3::UnitZ();
              return Vec3(x.x() / (a * a), 0.0, x.z() / (b * b)).normalized();
            },
            [=] { return make_bspline_patch(rounded_edge(a, b, flat, span)); }};
  body.options.lateral_entity = [=](const Vec3& x) {
    if (x.y() < 1e-9 * span) return 11;
    if (x.y() > (1.0 - 1e-9) * span) return 12;
    return x.z() < 0.0 ? 13 : 14;
  };
  return body;
}

BodyCase corner(bool is_full) {
  const Index along = is_full ? 8 : 4;
  // Across: layers up to 0.15, then even cells.
  const double edge = 1.0 / (along - 1);
  const auto heights = [is_full](double first) {
    std::vector<double> z{0.0};
    for (double h = first; h < 0.1; h *= is_full ? 3.0 : 30.0) z.push_back(h);
    for (double h : {0.18, 0.35, 0.6, 0.8, 1.0}) z.push_back(h);
    return z;
  };
  return {"corner", "hexes", edge,
          [=](double first_over_edge) {
            return concave_corner(heights(first_over_edge * edge), along);
          },
          concave_corner_model};
}

}  // namespace

std::vector<BodyCase> body_cases(CaseSize size) {
  const bool is_full = size == CaseSize::full;
  const double growth = is_full ? 3.0 : 30.0;
  const std::vector<Body> bodies{
      sphere(is_full),
      ellipsoid(is_full, false),
      edge_body("wing", 1.0, 0.1, 0.2, 0.4, is_full ? 32 : 20, 2, is_full ? 8 : 3),
      hill(is_full),
      torus_inside(is_full),
      ellipsoid(is_full, true),
      edge_body("tip", 0.5, 0.5, 2.0, 2.0, 2, 3, is_full ? 6 : 3)};
  std::vector<BodyCase> cases;
  for (const Body& body : bodies) {
    for (const char* filling : {"prisms", "hexes", "tets", "caps"}) {
      cases.push_back(filled(body, filling, growth));
    }
  }
  cases.push_back(corner(is_full));
  return cases;
}

BodyCase body_case(const std::string& body, const std::string& filling, CaseSize size) {
  for (BodyCase& known : body_cases(size)) {
    if (known.body == body && known.filling == filling) return std::move(known);
  }
  throw std::invalid_argument("no case is named " + body + " with " + filling);
}

BsplineSurface rounded_edge(double a, double b, double flat, double span) {
  // Two straight spans as parabolas and two quarters of the ellipse as conics, double knots
  // between.
  const std::array<std::array<double, 3>, 9> section{{{flat, -b, 1.0},
                                                      {0.5 * flat, -b, 1.0},
                                                      {0.0, -b, 1.0},
                                                      {-a, -b, std::numbers::sqrt2 / 2.0},
                                                      {-a, 0.0, 1.0},
                                                      {-a, b, std::numbers::sqrt2 / 2.0},
                                                      {0.0, b, 1.0},
                                                      {0.5 * flat, b, 1.0},
                                                      {flat, b, 1.0}}};
  Points poles;
  std::vector<double> weights;
  for (const auto& [x, z, weight] : section) {
    for (double y : {0.0, span}) {
      poles.emplace_back(x, y, z);
      weights.push_back(weight);
    }
  }
  return {BsplineBasis(2, {0.0, 0.0, 0.0, 1.0, 1.0, 2.0, 2.0, 3.0, 3.0, 4.0, 4.0, 4.0}),
          BsplineBasis(1, {0.0, 0.0, 1.0, 1.0}), poles, weights};
}

}  // namespace camber::testing
