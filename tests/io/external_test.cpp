// Our files in other programs: Gmsh and VTK must see the same elements with the same sizes. The
// Python scripts beside this file do the looking; they end with 77 where the program is not
// installed.
#include <camber/basis/lagrange.hpp>
#include <camber/io/gmsh/gmsh_reader.hpp>
#include <camber/io/mesh_file.hpp>

#include <algorithm>
#include <cstdlib>
#include <iomanip>
#include <limits>
#include <sstream>
#include <sys/wait.h>

#include <gtest/gtest.h>

#include "sample_mesh.hpp"

namespace camber::io {
namespace {

constexpr int k_not_installed = 77;

int run(const std::string& command) {
  const int status = std::system(command.c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

std::string script(const std::string& name) {
  // The system's own Python has the packages of the distribution.
  return "/usr/bin/python3 " + std::string(CAMBER_SOURCE_DIR) + "/tests/io/" + name;
}

/// One line an element: number in the file, place over all blocks, shape, order, dimension,
/// measure.
void write_expected(const MeshData& mesh, const std::string& path) {
  std::ostringstream text;
  text << std::setprecision(17);
  const std::vector<double> sizes = measures(mesh);
  std::size_t e = 0;
  for (const ElementBlock& b : mesh.blocks) {
    for (std::size_t i = 0; i < b.size(); ++i, ++e) {
      // Curved pyramids of high order are cut into linear cells; element 77777 is straight.
      const bool is_cut = b.shape == Shape::pyramid && b.order > 2 && b.tags[i] != 77777;
      text << b.tags[i] << ' ' << e << ' ' << name(b.shape) << ' ' << b.order << ' '
           << dimension(b.shape) << ' ' << sizes[e] << ' ' << (is_cut ? 5e-3 : 1e-10) << '\n';
    }
  }
  spill(path, text.str());
}

struct Flavour {
  const char* name;
  double version;
  bool binary;
};

class InGmsh : public testing::TestWithParam<Flavour> {
 protected:
  [[nodiscard]] WriteOptions options() const {
    WriteOptions options;
    options.binary = GetParam().binary;
    options.gmsh_version = GetParam().version;
    return options;
  }
};

TEST_P(InGmsh, EveryElementHasItsMeasure) {
  const MeshData mesh = zoo();
  write_mesh(mesh, scratch("zoo.msh"), options());
  write_expected(mesh, scratch("expected.txt"));

  const int code =
      run(script("check_with_gmsh.py") + " " + scratch("zoo.msh") + " " + scratch("expected.txt"));

  if (code == k_not_installed) GTEST_SKIP() << "gmsh is not installed";
  EXPECT_EQ(code, 0);
}

TEST_P(InGmsh, AFileThatGmshWritesAgainIsTheSameMesh) {
  if (run("command -v gmsh > /dev/null") != 0) GTEST_SKIP() << "gmsh is not installed";
  const MeshData mesh = zoo();
  write_mesh(mesh, scratch("zoo.msh"), options());

  // Binary, as its text has 16 digits only; SaveAll, as the points are in no group.
  const int code =
      run("gmsh " + scratch("zoo.msh") + " -save -bin -format " +
          (GetParam().version > 3.0 ? "msh41" : "msh22") + " -setnumber Mesh.SaveAll 1 -o " +
          scratch("again.msh") + " > " + scratch("log.txt"));

  ASSERT_EQ(code, 0) << slurp(scratch("log.txt"));
  const MeshData again = read_gmsh(scratch("again.msh"));
  EXPECT_EQ(again.points.size(), mesh.points.size());
  EXPECT_EQ(again.element_count(), mesh.element_count());
  // Gmsh numbers the elements of version 2.2 anew; the zoo has no two of equal measure.
  std::vector<double> before = measures(mesh);
  std::vector<double> after = measures(again);
  std::sort(before.begin(), before.end());
  std::sort(after.begin(), after.end());
  EXPECT_EQ(after, before);
}

INSTANTIATE_TEST_SUITE_P(Flavours, InGmsh,
                         testing::Values(Flavour{"v41text", 4.1, false},
                                         Flavour{"v41binary", 4.1, true},
                                         Flavour{"v22text", 2.2, false},
                                         Flavour{"v22binary", 2.2, true}),
                         [](const auto& p) { return p.param.name; });

/// Gmsh's own elevation shows its order of nodes without our tables.
TEST(FromGmsh, NodesOfElevatedElementsStandWhereTheyBelong) {
  MeshData linear;
  for (int shape = 1; shape < k_shape_count; ++shape) {
    const MeshData one = single(static_cast<Shape>(shape), 1);
    const auto shift = static_cast<Index>(linear.points.size());
    ElementBlock block = one.blocks[0];
    for (Index& n : block.nodes) n += shift;
    block.tags = {shape};
    linear.blocks.push_back(std::move(block));
    linear.points.insert(linear.points.end(), one.points.begin(), one.points.end());
  }
  write_mesh(linear, scratch("linear.msh"));

  for (int order = 2; order <= k_max_order; ++order) {
    const int code = run(script("elevate_with_gmsh.py") + " " + scratch("linear.msh") + " " +
                         std::to_string(order) + " " + scratch("elevated.msh"));
    if (code == k_not_installed) GTEST_SKIP() << "gmsh is not installed";
    ASSERT_EQ(code, 0);

    const MeshData elevated = read_gmsh(scratch("elevated.msh"));

    ASSERT_EQ(elevated.element_count(), linear.element_count());
    for (const ElementBlock& block : elevated.blocks) {
      ASSERT_EQ(block.order, order);
      Points nodes;
      for (const Index n : block.nodes) nodes.push_back(elevated.points[at(n)]);
      Points corner_points;
      for (const int c : lattice_map(block.shape, order).corner) {
        corner_points.push_back(nodes[static_cast<std::size_t>(c)]);
      }
      const Points straight = straight_nodes(block.shape, order, corner_points);
      for (std::size_t n = 0; n < nodes.size(); ++n) {
        EXPECT_LT((nodes[n] - straight[n]).norm(), 1e-12)
            << name(block.shape) << " of order " << order << ", node " << n;
      }
    }
  }
}

class InVtk : public testing::TestWithParam<bool> {};

TEST_P(InVtk, EveryCellHasItsMeasureAndItsData) {
  MeshData mesh = zoo();
  mesh.point_tags.clear();
  mesh.point_entity.clear();
  mesh.point_parameters.clear();
  // A second element in a block, and a field with two values that are missing.
  const MeshData more = single(Shape::pyramid, 4, 0.0);
  const auto shift = static_cast<Index>(mesh.points.size());
  for (ElementBlock block : more.blocks) {
    for (Index& n : block.nodes) n += shift;
    block.tags = {77777};
    mesh.blocks.push_back(std::move(block));
  }
  mesh.points.insert(mesh.points.end(), more.points.begin(), more.points.end());
  Field field{"size & <more>", measures(mesh)};
  field.values.pop_back();
  field.values[10] = std::numeric_limits<double>::quiet_NaN();
  mesh.element_fields = {field};
  write_mesh(mesh, scratch("zoo.vtu"), {.binary = GetParam()});
  write_expected(mesh, scratch("expected.txt"));

  const int code =
      run(script("check_with_vtk.py") + " " + scratch("zoo.vtu") + " " + scratch("expected.txt"));

  if (code == k_not_installed) GTEST_SKIP() << "VTK for Python is not installed";
  EXPECT_EQ(code, 0);
}

INSTANTIATE_TEST_SUITE_P(Flavours, InVtk, testing::Bool(),
                         [](const auto& p) { return std::string(p.param ? "binary" : "text"); });

}  // namespace
}  // namespace camber::io
