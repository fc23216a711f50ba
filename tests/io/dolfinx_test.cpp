// Gmsh files of one order, integrated by DOLFINx where it is installed.
#include <camber/io/mesh_file.hpp>

#include <tuple>

#include <gtest/gtest.h>

#include "hybrid_mesh.hpp"
#include "run_script.hpp"
#include "sample_mesh.hpp"

namespace camber::io {
namespace {

class UniformOrder : public testing::TestWithParam<std::tuple<Shape, int>> {};

TEST_P(UniformOrder, HasTheSameVolumeAndSurfaceInDolfinx) {
  const auto [shape, order] = GetParam();
  const MeshData mesh = bent_cube(shape, order, 7);
  const std::string path = scratch("uniform.msh");
  write_mesh(mesh, path);

  const int code = judged_by("../independent/integrate_in_dolfinx.py", mesh, order, path);

  if (code == k_not_installed) GTEST_SKIP() << "python3-dolfinx is not installed";
  EXPECT_EQ(code, 0);
}

// As far as the table of Gmsh's elements in DOLFINx 0.5 (Debian 12) goes.
INSTANTIATE_TEST_SUITE_P(Tets, UniformOrder,
                         testing::Combine(testing::Values(Shape::tetrahedron),
                                          testing::Range(1, 4)));
INSTANTIATE_TEST_SUITE_P(Hexes, UniformOrder,
                         testing::Combine(testing::Values(Shape::hexahedron),
                                          testing::Range(1, 3)));

}  // namespace
}  // namespace camber::io
