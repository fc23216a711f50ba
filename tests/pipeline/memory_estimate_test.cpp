#include <camber/base/error.hpp>
#include <camber/pipeline/memory_estimate.hpp>

#include <filesystem>
#include <fstream>
#include <unistd.h>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace camber {
namespace {

MeshData cells(Shape shape, std::size_t count) {
  MeshData mesh;
  ElementBlock& block = mesh.blocks.emplace_back();
  block.shape = shape;
  block.nodes.resize(count * static_cast<std::size_t>(node_count(shape, 1)));
  return mesh;
}

TEST(MemoryEstimate, IsTheFormulaOfItsDocumentation) {
  // sqrt(2^3 4^3) = 22.627; 47 MB + 1000 (500 + 185 * 22.627); a tet is a sixth of a hex.
  EXPECT_EQ(estimated_memory(cells(Shape::hexahedron, 1000), {.max_order = 4}), 51'686'072U);
  EXPECT_EQ(estimated_memory(cells(Shape::tetrahedron, 6000), {.max_order = 4}), 54'186'072U);
  EXPECT_EQ(estimated_memory(cells(Shape::triangle, 6000), {.max_order = 4}), 47'000'000U);
}

TEST(MemoryEstimate, GrowsWithTheOrders) {
  const MeshData mesh = cells(Shape::prism, 100000);
  const std::size_t two = estimated_memory(mesh, {.max_order = 2});
  const std::size_t four = estimated_memory(mesh, {.max_order = 4});
  EXPECT_LT(two, estimated_memory(mesh, {.max_order = 3}));
  EXPECT_LT(four, estimated_memory(mesh, {.max_order = 4, .uniform = true}));
  EXPECT_EQ(estimated_memory(mesh, {.max_order = 4, .min_order = 4}),
            estimated_memory(mesh, {.max_order = 4, .uniform = true}));
}

TEST(MemoryEstimate, ReadsWhatTheSystemSays) {
  const auto path =
      std::filesystem::temp_directory_path() / ("camber_meminfo_" + std::to_string(::getpid()));
  std::ofstream(path) << "MemTotal:  200 kB\nHugePages_Total:       0\nMemAvailable:   150 kB\n";
  EXPECT_EQ(available_memory(path.string()), 150U * 1024U);
  std::ofstream(path) << "MemTotal:  200 kB\n";
  EXPECT_EQ(available_memory(path.string()), 0U);
  std::filesystem::remove(path);
  EXPECT_EQ(available_memory(path.string()), 0U);
}

TEST(MemoryEstimate, AboveWhatIsThereIsOneErrorThatSaysWhatToDo) {
  EXPECT_NO_THROW(require_memory(3'000'000'000, 1'000'000'000, 2'000'000'000, "big.msh"));
  EXPECT_NO_THROW(require_memory(3'000'000'000, 0, 0, "big.msh"));
  try {
    require_memory(3'000'000'000, 500'000'000, 2'000'000'000, "big.msh");
    ADD_FAILURE() << "was taken";
  } catch (const MeshError& error) {
    EXPECT_THAT(error.message(), ::testing::HasSubstr("about 3.0 GB"));
    EXPECT_THAT(error.message(), ::testing::HasSubstr("2.5 GB are available"));
    EXPECT_EQ(error.where(), "big.msh");
    EXPECT_THAT(error.remedy(), ::testing::HasSubstr("--allow-memory"));
  }
}

}  // namespace
}  // namespace camber
