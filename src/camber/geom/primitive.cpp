#include <camber/base/error.hpp>
#include <camber/base/number_list.hpp>
#include <camber/geom/analytic_model.hpp>
#include <camber/geom/primitive.hpp>

#include <array>
#include <string_view>
#include <vector>

#include <fmt/format.h>

namespace camber {
namespace {

struct Kind {
  std::string_view name, numbers;
  std::size_t count;
};
constexpr std::array<Kind, 4> k_kinds{{{"sphere", "x,y,z,r", 4},
                                       {"ellipsoid", "x,y,z,a,b,c", 6},
                                       {"cylinder", "x,y,z,dx,dy,dz,r", 7},
                                       {"torus", "x,y,z,dx,dy,dz,R,r", 8}}};

const Kind* kind_of(std::string_view text) {
  for (const Kind& kind : k_kinds) {
    if (text.starts_with(kind.name) && text.substr(kind.name.size()).starts_with(":")) return &kind;
  }
  return nullptr;
}

[[noreturn]] void refuse(const std::string& text, const std::string& why, const Kind& kind) {
  throw OptionError(fmt::format("'{}' is no {}: {}", text, kind.name, why), "--geometry",
                    fmt::format("write {}:{}", kind.name, kind.numbers));
}

std::vector<double> numbers_of(const std::string& text, const Kind& kind) {
  const std::vector<double> numbers = comma_separated(
      std::string_view(text).substr(kind.name.size() + 1),
      [&](auto word) { refuse(text, fmt::format("'{}' is no number", word), kind); });
  if (numbers.size() != kind.count) {
    refuse(text, fmt::format("{} numbers, {} expected", numbers.size(), kind.count), kind);
  }
  return numbers;
}

}  // namespace

bool is_primitive(const std::string& text) { return kind_of(text) != nullptr; }

std::unique_ptr<GeometryModel> make_primitive(const std::string& text) {
  const Kind* kind = kind_of(text);
  if (!kind) {
    throw OptionError(fmt::format("'{}' is no analytic surface", text), "--geometry",
                      "choose one of sphere, ellipsoid, cylinder, torus");
  }
  const std::vector<double> n = numbers_of(text, *kind);
  const Vec3 origin(n[0], n[1], n[2]);
  const auto positive = [&](double length, const char* what) {
    if (!(length > 0.0)) refuse(text, fmt::format("{} must be positive", what), *kind);
  };
  if (kind->name == "sphere") {
    positive(n[3], "the radius");
    return make_sphere(origin, n[3]);
  }
  if (kind->name == "ellipsoid") {
    for (std::size_t i = 3; i < 6; ++i) positive(n[i], "a semi-axis");
    return make_ellipsoid(origin, {n[3], n[4], n[5]});
  }
  const Vec3 axis(n[3], n[4], n[5]);
  positive(axis.norm(), "the length of the axis");
  positive(n[6], "the radius");
  if (kind->name == "cylinder") return make_cylinder(origin, axis, n[6]);
  positive(n[7], "the radius of the tube");
  if (n[7] >= n[6]) refuse(text, "the tube is as wide as its ring", *kind);
  return make_torus(origin, axis, n[6], n[7]);
}

}  // namespace camber
