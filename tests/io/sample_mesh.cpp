#include "sample_mesh.hpp"

#include <camber/basis/lagrange.hpp>
#include <camber/basis/quadrature.hpp>

#include <bit>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <sstream>
#include <unistd.h>

#include <gtest/gtest.h>

namespace camber::io {
namespace {

/// A smooth map that is no polynomial, so that no two coordinates share bits by chance.
Vec3 bend(const Vec3& x, double amplitude) {
  return x + amplitude * Vec3(std::sin(2.0 * x.y() + x.z()), std::cos(1.5 * x.x() - x.z()),
                              std::sin(x.x() + 0.7 * x.y()));
}

void add_element(MeshData& mesh, Shape shape, int order, double amplitude) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const int dim = dimension(shape);
  const int base = static_cast<int>(shape) + 1;
  ElementBlock block;
  block.shape = shape;
  block.order = order;
  block.entity = 10 * base + order;
  block.tags = {static_cast<GlobalId>(1000 + 7 * mesh.blocks.size())};
  const Vec3 shift(2.0 * base, 2.0 * order, 0.1 * base);
  const std::vector<Vec3> origin{Vec3::Zero()};
  const std::span<const Vec3> lattice = shape == Shape::point ? origin : lattice_xi(shape, order);
  for (const Vec3& xi : lattice) {
    block.nodes.push_back(static_cast<Index>(mesh.points.size()));
    mesh.point_tags.push_back(static_cast<GlobalId>(5 + 3 * mesh.points.size()));
    mesh.points.push_back(bend(xi + shift, amplitude));
    mesh.point_entity.push_back({dim, block.entity});
    const bool has_parameters = dim == 1 || dim == 2;
    mesh.point_parameters.emplace_back(has_parameters ? xi.x() / 3.0 : nan,
                                       has_parameters ? (dim == 2 ? xi.y() / 7.0 : 0.0) : nan);
  }
  EntityRecord entity;
  entity.key = {dim, block.entity};
  entity.physical_tags = {base};
  entity.name = "all " + std::string(name(shape)) + "s";
  for (const Index n : block.nodes) entity.box.add(mesh.points[at(n)]);
  mesh.entities.push_back(entity);
  bool named = false;
  for (const PhysicalName& p : mesh.physical_names)
    named = named || (p.dim == dim && p.tag == base);
  if (!named) mesh.physical_names.push_back({dim, base, entity.name});
  mesh.blocks.push_back(std::move(block));
}

std::string bits(double value) { return std::to_string(std::bit_cast<std::uint64_t>(value)); }

/// Everything about the mesh that a format keeps, one text per item, nodes named by number.
std::map<std::string, std::string> digest(const MeshData& mesh, bool with_classification) {
  std::map<std::string, std::string> items;
  const auto tag = [&](Index i) {
    return std::to_string(mesh.point_tags.empty() ? i + 1 : mesh.point_tags[at(i)]);
  };
  for (Index i = 0; at(i) < mesh.points.size(); ++i) {
    const Vec3& x = mesh.points[at(i)];
    std::string& text = items["node " + tag(i)];
    text = bits(x.x()) + ' ' + bits(x.y()) + ' ' + bits(x.z());
    if (!with_classification) continue;
    const EntityKey& key = mesh.point_entity[at(i)];
    text += " on " + std::to_string(key.dim) + ' ' + std::to_string(key.tag);
    const bool has_parameters =
        !mesh.point_parameters.empty() && mesh.point_parameters[at(i)].allFinite();
    if (!has_parameters) continue;
    const Vec2& uv = mesh.point_parameters[at(i)];
    text += " at " + bits(uv.x()) + ' ' + bits(uv.y());
  }
  for (std::size_t b = 0; b < mesh.blocks.size(); ++b) {
    const ElementBlock& block = mesh.blocks[b];
    std::string& text = items["block " + std::to_string(b)];
    text = std::string(name(block.shape)) + ' ' + std::to_string(block.order) + ' ' +
           std::to_string(block.entity) + ':';
    for (const GlobalId t : block.tags) text += ' ' + std::to_string(t);
    text += " nodes";
    for (const Index n : block.nodes) text += ' ' + tag(n);
  }
  for (const EntityRecord& e : mesh.entities) {
    std::string& text =
        items["entity " + std::to_string(e.key.dim) + ' ' + std::to_string(e.key.tag)];
    text = e.name;
    for (const int t : e.physical_tags) text += ' ' + std::to_string(t);
  }
  for (const PhysicalName& p : mesh.physical_names) {
    items["group " + std::to_string(p.dim) + ' ' + std::to_string(p.tag)] = p.name;
  }
  return items;
}

double measure(const MeshData& mesh, const ElementBlock& block, std::size_t e) {
  if (block.shape == Shape::point) return 0.0;
  const auto per = static_cast<std::size_t>(node_count(block.shape, block.order));
  Points nodes;
  for (std::size_t n = 0; n < per; ++n) nodes.push_back(mesh.points[at(block.nodes[e * per + n])]);
  const int dim = dimension(block.shape);
  // Volumes of polynomial cells are exact at 3p; lengths and areas are roots and need more.
  const Quadrature& rule = gauss(block.shape, dim == 3 ? 3 * block.order + 4 : 40);
  double sum = 0.0;
  for (std::size_t q = 0; q < rule.points.size(); ++q) {
    const Mat3 J = jacobian(block.shape, block.order, nodes, rule.points[q]);
    const double density = dim == 3   ? J.determinant()
                           : dim == 2 ? Vec3(J.col(0)).cross(Vec3(J.col(1))).norm()
                                      : J.col(0).norm();
    sum += rule.weights[q] * density;
  }
  return sum;
}

}  // namespace

MeshData zoo(double amplitude) {
  MeshData mesh;
  for (int s = 0; s < k_shape_count; ++s) {
    const auto shape = static_cast<Shape>(s);
    for (int order = 1; order <= (shape == Shape::point ? 1 : k_max_order); ++order) {
      add_element(mesh, shape, order, amplitude);
    }
  }
  return mesh;
}

MeshData single(Shape shape, int order, double amplitude) {
  MeshData mesh;
  add_element(mesh, shape, order, amplitude);
  return mesh;
}

std::vector<double> measures(const MeshData& mesh) {
  std::vector<double> result;
  for (const ElementBlock& block : mesh.blocks) {
    for (std::size_t e = 0; e < block.size(); ++e) result.push_back(measure(mesh, block, e));
  }
  return result;
}

namespace {

/// A folder of this process: several runs may go on at once.
class ScratchFolder {
 public:
  ScratchFolder()
      : path_(std::filesystem::path(testing::TempDir()) /
              ("camber_io_test." + std::to_string(::getpid()))) {}
  ~ScratchFolder() {
    std::error_code ignored;  // nothing depends on it any more
    std::filesystem::remove_all(path_, ignored);
  }
  /// The folder, emptied when a new test asks for the first time.
  const std::filesystem::path& of(const std::string& test) {
    if (test != test_) {
      test_ = test;
      std::filesystem::remove_all(path_);
      std::filesystem::create_directories(path_);
    }
    return path_;
  }

 private:
  std::filesystem::path path_;
  std::string test_;
};

}  // namespace

std::string scratch(const std::string& name) {
  static ScratchFolder folder;
  const testing::TestInfo* const test = testing::UnitTest::GetInstance()->current_test_info();
  return (folder.of(std::string(test->test_suite_name()) + "." + test->name()) / name).string();
}

std::string slurp(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream bytes;
  bytes << file.rdbuf();
  return bytes.str();
}

void spill(const std::string& path, const std::string& bytes) {
  std::ofstream(path, std::ios::binary) << bytes;
}

void expect_same_mesh(const MeshData& a, const MeshData& b, bool with_classification) {
  const std::map<std::string, std::string> of_a = digest(a, with_classification);
  const std::map<std::string, std::string> of_b = digest(b, with_classification);
  EXPECT_EQ(of_a.size(), of_b.size());
  for (const auto& [key, value] : of_a) {
    const auto twin = of_b.find(key);
    ASSERT_NE(twin, of_b.end()) << key << " is missing";
    EXPECT_EQ(value, twin->second) << key;
  }
}

}  // namespace camber::io
