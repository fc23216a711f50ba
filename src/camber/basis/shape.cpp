#include <camber/basis/shape.hpp>

#include <stdexcept>
#include <vector>

namespace camber {
namespace {

struct ShapeTable {
  std::string_view name;
  int dimension;
  double measure;
  Vec3 centroid;
  std::vector<Vec3> corners;
  std::vector<std::array<int, 2>> edges;
  std::vector<LocalFace> faces;
};

LocalFace tri(int a, int b, int c) { return {Shape::triangle, {a, b, c, -1}}; }
LocalFace quad(int a, int b, int c, int d) { return {Shape::quadrilateral, {a, b, c, d}}; }

std::array<ShapeTable, k_shape_count> make_tables() {
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  const Vec3 xy = x + y, xz = x + z, yz = y + z, xyz = x + y + z;
  constexpr double third = 1.0 / 3.0;
  return {{
      {"point", 0, 1.0, o, {o}, {}, {}},
      {"line", 1, 1.0, Vec3(0.5, 0, 0), {o, x}, {{0, 1}}, {}},
      {"tri", 2, 0.5, Vec3(third, third, 0), {o, x, y}, {{0, 1}, {1, 2}, {2, 0}}, {tri(0, 1, 2)}},
      {"quad",
       2,
       1.0,
       Vec3(0.5, 0.5, 0),
       {o, x, xy, y},
       {{0, 1}, {1, 2}, {2, 3}, {3, 0}},
       {quad(0, 1, 2, 3)}},
      {"tet",
       3,
       1.0 / 6.0,
       Vec3::Constant(0.25),
       {o, x, y, z},
       {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}},
       {tri(0, 2, 1), tri(0, 1, 3), tri(1, 2, 3), tri(2, 0, 3)}},
      {"pyramid",
       3,
       third,
       Vec3(0.375, 0.375, 0.25),
       {o, x, xy, y, z},
       {{0, 1}, {1, 2}, {2, 3}, {3, 0}, {0, 4}, {1, 4}, {2, 4}, {3, 4}},
       {quad(0, 3, 2, 1), tri(0, 1, 4), tri(1, 2, 4), tri(2, 3, 4), tri(3, 0, 4)}},
      {"prism",
       3,
       0.5,
       Vec3(third, third, 0.5),
       {o, x, y, z, xz, yz},
       {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 4}, {2, 5}, {3, 4}, {4, 5}, {5, 3}},
       {quad(0, 1, 4, 3), quad(1, 2, 5, 4), quad(2, 0, 3, 5), tri(0, 2, 1), tri(3, 4, 5)}},
      {"hex",
       3,
       1.0,
       Vec3::Constant(0.5),
       {o, x, xy, y, z, xz, xyz, yz},
       {{0, 1},
        {1, 2},
        {2, 3},
        {3, 0},
        {0, 4},
        {1, 5},
        {2, 6},
        {3, 7},
        {4, 5},
        {5, 6},
        {6, 7},
        {7, 4}},
       {quad(0, 3, 2, 1), quad(0, 1, 5, 4), quad(1, 2, 6, 5), quad(2, 3, 7, 6), quad(0, 4, 7, 3),
        quad(4, 5, 6, 7)}},
  }};
}

const ShapeTable& table(Shape shape) {
  static const std::array<ShapeTable, k_shape_count> tables = make_tables();
  const auto s = static_cast<std::size_t>(shape);
  if (s >= tables.size()) throw std::invalid_argument("unknown shape");
  return tables[s];
}

}  // namespace

int dimension(Shape shape) { return table(shape).dimension; }
int corner_count(Shape shape) { return static_cast<int>(table(shape).corners.size()); }
std::string_view name(Shape shape) { return table(shape).name; }
std::span<const Vec3> corners(Shape shape) { return table(shape).corners; }
std::span<const std::array<int, 2>> edges(Shape shape) { return table(shape).edges; }
std::span<const LocalFace> faces(Shape shape) { return table(shape).faces; }
double reference_measure(Shape shape) { return table(shape).measure; }
Vec3 reference_centroid(Shape shape) { return table(shape).centroid; }

}  // namespace camber
