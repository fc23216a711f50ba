// Every node of the shared meshes lies on the entity whose number Gmsh gave it.
#include <camber/geom_occ/cad_file.hpp>

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>

#include <gtest/gtest.h>

#include "sample_bodies.hpp"

namespace camber {
namespace {

struct ClassifiedNode {
  GeomEntity entity;
  Vec3 x;
};

/// The $Nodes section of a binary Gmsh 4.1 file.
class NodeSection {
 public:
  explicit NodeSection(const std::string& path) {
    std::ifstream file(path, std::ios::binary);
    bytes_.assign(std::istreambuf_iterator<char>(file), {});
    const std::string start = "$Nodes\n";
    const std::size_t found = bytes_.find(start);
    if (found == std::string::npos) throw std::runtime_error("no $Nodes in " + path);
    at_ = found + start.size();
  }

  std::vector<ClassifiedNode> read() {
    std::vector<ClassifiedNode> nodes;
    const auto blocks = take<std::uint64_t>();
    skip(3 * sizeof(std::uint64_t));
    for (std::uint64_t b = 0; b < blocks; ++b) {
      const auto dim = take<std::int32_t>(), tag = take<std::int32_t>(),
                 parametric = take<std::int32_t>();
      const auto count = take<std::uint64_t>();
      skip(count * sizeof(std::uint64_t));
      for (std::uint64_t i = 0; i < count; ++i) {
        const double x = take<double>(), y = take<double>(), z = take<double>();
        if (parametric != 0) skip(static_cast<std::size_t>(dim) * sizeof(double));
        nodes.push_back({{dim, tag}, {x, y, z}});
      }
    }
    return nodes;
  }

 private:
  template <class T>
  T take() {
    T value{};
    if (at_ + sizeof(T) > bytes_.size()) throw std::runtime_error("$Nodes cut short");
    std::memcpy(&value, bytes_.data() + at_, sizeof(T));
    at_ += sizeof(T);
    return value;
  }
  void skip(std::size_t count) { at_ += count; }

  std::string bytes_;
  std::size_t at_ = 0;
};

class SharedCase : public testing::TestWithParam<const char*> {};

TEST_P(SharedCase, HasItsNodesOnTheEntitiesOfTheirTags) {
  const std::string folder = std::string(CAMBER_SHARED_CASES) + "/" + GetParam();
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is absent";
  const auto model = read_cad(folder + "/body.step");
  const auto projector = model->projector();
  const double size = model->box().diagonal();
  int checked = 0;
  for (const ClassifiedNode& node : NodeSection(folder + "/linear.msh").read()) {
    if (node.entity.dim > 2 || node.entity.tag > model->count(node.entity.dim)) continue;
    const Projection p = projector->closest(node.entity, node.x);
    EXPECT_LT(p.distance, 1e-6 * size) << node.entity.dim << " " << node.entity.tag;
    ++checked;
  }
  EXPECT_GT(checked, 100);
}

INSTANTIATE_TEST_SUITE_P(Of, SharedCase, testing::Values("ball-hybrid", "wing-bl-coarse"));

TEST(SharedCase, OfTheWingIsMetByLinesAlongItsNormals) {
  const std::string path = std::string(CAMBER_SHARED_CASES) + "/wing-bl-coarse/body.step";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is absent";
  const auto model = read_cad(path);
  const auto projector = model->projector();
  for (int f = 1; f <= model->count(2); ++f) {
    const double size = model->box({2, f}).diagonal();
    for (const Vec3& y : test::random_points(model->box({2, f}), 40)) {
      const Projection on = projector->closest({2, f}, y);
      if (on.status != ProjectionStatus::inside) continue;
      const SurfacePoint s = projector->evaluate_face(f, on.uv);
      const Vec3 x = s.point + 0.01 * size * s.normal;
      const auto hit = projector->along_line(f, x, s.normal, 0.011 * size);
      ASSERT_TRUE(hit) << "face " << f;
      EXPECT_LE(hit->distance, 0.01 * size * (1.0 + 1e-9));
    }
  }
}

}  // namespace
}  // namespace camber
