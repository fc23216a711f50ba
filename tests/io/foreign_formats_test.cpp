// CGNS, SU2 and UGRID files of other programs: the shared cases, when they are there.
#include <camber/basis/lagrange.hpp>
#include <camber/io/mesh_file.hpp>
#include <camber/validity/element_validity.hpp>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "sample_mesh.hpp"

namespace camber::io {
namespace {

namespace fs = std::filesystem;

std::string foreign(const std::string& name) {
  return std::string(CAMBER_SHARED_CASES) + "/foreign/" + name;
}

std::map<Shape, std::size_t> counts(const MeshData& mesh) {
  std::map<Shape, std::size_t> all;
  for (const ElementBlock& block : mesh.blocks) all[block.shape] += block.size();
  return all;
}

double total_measure(MeshData mesh, int dim) {
  std::erase_if(mesh.blocks, [&](const ElementBlock& b) { return dimension(b.shape) != dim; });
  double sum = 0.0;
  for (const double m : measures(mesh)) sum += m;
  return sum;
}

/// Cells that are not certified.
std::size_t bad_cells(const MeshData& mesh) {
  std::size_t bad = 0;
  for (const ElementBlock& block : mesh.blocks) {
    if (dimension(block.shape) < 3) continue;
    const auto per = static_cast<std::size_t>(node_count(block.shape, block.order));
    Points nodes(per);
    for (std::size_t e = 0; e < block.size(); ++e) {
      for (std::size_t n = 0; n < per; ++n) nodes[n] = mesh.points[at(block.nodes[e * per + n])];
      bad += quick_verdict(block.shape, block.order, nodes) == Verdict::valid ? 0U : 1U;
    }
  }
  return bad;
}

/// The full Lagrange types of the sample files; a wrong node order would tangle the cell or move
/// nodes from the straight lattice.
class SingleElement : public testing::TestWithParam<const char*> {};

TEST_P(SingleElement, HasItsNodesWhereTheConventionPutsThem) {
  const std::string path = foreign("cgns-single-elements/" + std::string(GetParam()) + ".cgns");
  if (!fs::exists(path)) GTEST_SKIP() << path << " is absent";

  const MeshData mesh = read_mesh(path);

  EXPECT_EQ(bad_cells(mesh), 0U);
  for (const ElementBlock& block : mesh.blocks) {
    if (dimension(block.shape) < 2) continue;
    const std::vector<int>& corner = lattice_map(block.shape, block.order).corner;
    const std::vector<int>& linear = lattice_map(block.shape, 1).corner;
    const auto per = static_cast<std::size_t>(node_count(block.shape, block.order));
    for (std::size_t e = 0; e < block.size(); ++e) {
      Points corners(corner.size());
      Box box;
      for (std::size_t i = 0; i < corner.size(); ++i) {
        corners[static_cast<std::size_t>(linear[i])] =
            mesh.points[at(block.nodes[e * per + static_cast<std::size_t>(corner[i])])];
      }
      for (const Vec3& x : corners) box.add(x);
      for (std::size_t n = 0; n < per; ++n) {
        const Vec3 straight =
            evaluate(block.shape, 1, corners, lattice_xi(block.shape, block.order)[n]);
        const Vec3& x = mesh.points[at(block.nodes[e * per + n])];
        EXPECT_LT((x - straight).norm(), 1e-6 * box.diagonal())
            << name(block.shape) << ' ' << block.order << " node " << n;
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cgns, SingleElement,
                         testing::Values("TETRA_10", "TETRA_20", "TETRA_35", "PYRA_14", "PYRA_30",
                                         "PYRA_55", "PENTA_18", "PENTA_40", "PENTA_75", "HEXA_64",
                                         "HEXA_125"),
                         [](const auto& p) { return std::string(p.param); });

TEST(ForeignMeshes, FourFormatsOfOneMeshSayTheSame) {
  const std::string stem = foreign("onera-m6/gen/m6_hyb_alltypes");
  if (!fs::exists(stem + ".cgns")) GTEST_SKIP() << stem << " is absent";

  const MeshData cgns = read_mesh(stem + ".cgns"), ugrid = read_mesh(stem + ".lb8.ugrid");

  EXPECT_EQ(counts(cgns), counts(ugrid));
  EXPECT_EQ(cgns.points.size(), 26396U);
  EXPECT_EQ(ugrid.points.size(), 26396U);
  const double volume = total_measure(cgns, 3), area = total_measure(cgns, 2);
  EXPECT_NEAR(total_measure(ugrid, 3), volume, 1e-12 * volume);
  EXPECT_NEAR(total_measure(ugrid, 2), area, 1e-12 * area);
  EXPECT_EQ(bad_cells(ugrid), 0U);
  std::set<std::string> of_cgns, of_ugrid;
  for (const EntityRecord& e : cgns.entities) {
    if (e.key.dim == 2) of_cgns.insert(e.name);
  }
  for (const EntityRecord& e : ugrid.entities) {
    if (e.key.dim == 2) of_ugrid.insert(e.name);
  }
  EXPECT_EQ(of_cgns, of_ugrid);
  EXPECT_EQ(of_cgns.size(), 16U);
}

/// Unpacks NAME.gz into the test's folder. "" if it is not there or cannot be unpacked.
std::string unpacked(const std::string& name) {
  const std::string from = foreign(name) + ".gz", to = scratch("unpacked.su2");
  const std::string command = "gzip -dc '" + from + "' > '" + to + "' 2> /dev/null";
  return fs::exists(from) && std::system(command.c_str()) == 0 ? to : "";
}

TEST(ForeignMeshes, TheSu2FileOfTheSameMeshSaysTheSameAgain) {
  const std::string stem = "onera-m6/gen/m6_hyb_alltypes";
  const std::string path = unpacked(stem + ".su2");
  if (path.empty()) GTEST_SKIP() << stem << " is absent";

  const MeshData su2 = read_mesh(path), cgns = read_mesh(foreign(stem + ".cgns"));

  EXPECT_EQ(counts(su2), counts(cgns));
  const double volume = total_measure(cgns, 3), area = total_measure(cgns, 2);
  EXPECT_NEAR(total_measure(su2, 3), volume, 1e-12 * volume);
  EXPECT_NEAR(total_measure(su2, 2), area, 1e-12 * area);
}

TEST(ForeignMeshes, TheGmshFileOfTheSameMeshSaysTheSameOnceMore) {
  const std::string stem = "onera-m6/gen/m6_hyb_alltypes";
  const std::string path = unpacked(stem + ".msh");
  if (path.empty()) GTEST_SKIP() << stem << " is absent";

  MeshData msh = read_mesh(path, {.format = Format::gmsh});
  std::erase_if(msh.blocks, [](const ElementBlock& b) { return dimension(b.shape) < 2; });
  const MeshData cgns = read_mesh(foreign(stem + ".cgns"));

  EXPECT_EQ(counts(msh), counts(cgns));
  const double volume = total_measure(cgns, 3), area = total_measure(cgns, 2);
  EXPECT_NEAR(total_measure(msh, 3), volume, 1e-12 * volume);
  EXPECT_NEAR(total_measure(msh, 2), area, 1e-12 * area);
}

TEST(ForeignMeshes, TheCubicSphereOfSu2IsCertified) {
  const std::string path = unpacked("su2-sphere-and-3d/SphereInSphereStructured_nPoly3.su2");
  if (path.empty()) GTEST_SKIP() << "the cubic sphere is absent";

  const MeshData mesh = read_mesh(path);

  EXPECT_EQ(counts(mesh)[Shape::hexahedron], 768U);
  EXPECT_EQ(counts(mesh)[Shape::quadrilateral], 512U);
  EXPECT_EQ(bad_cells(mesh), 0U);
}

TEST(ForeignMeshes, Su2PrismsWithTheirFirstTriangleOutwardsAreTurned) {
  const std::string path = foreign("su2-sphere-and-3d/slice_2syms.su2");
  if (!fs::exists(path)) GTEST_SKIP() << path << " is absent";

  const MeshData mesh = read_mesh(path);

  EXPECT_EQ(counts(mesh)[Shape::prism], 7758U);
  EXPECT_EQ(bad_cells(mesh), 0U);
}

TEST(ForeignMeshes, HybridCgnsMeshesOfAnsaHaveNoTangledCell) {
  const std::string folder = foreign("cgns-hybrid-ansa/");
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";

  for (const char* const name :
       {"linear_tet_prism_pyra_mesh", "linear_tet_pyra_hex_mesh", "ImpossiblePyramids_linear",
        "HiOrderMesh_tet_hex_pyr_order4_midvol"}) {
    const MeshData mesh = read_mesh(folder + name + ".cgns");

    EXPECT_GT(mesh.element_count(), 1U) << name;
    EXPECT_EQ(bad_cells(mesh), 0U) << name;
  }
}

TEST(ForeignMeshes, PatchesOfAnAdfFileAreItsConditionsAndFamilies) {
  const std::string path = foreign("su2-sphere-and-3d/mesh_bend_coarse.cgns");
  if (!fs::exists(path)) GTEST_SKIP() << path << " is absent";

  const MeshData mesh = read_mesh(path);

  std::set<std::string> patches;
  for (const EntityRecord& e : mesh.entities) {
    if (e.key.dim == 2) patches.insert(e.name);
  }
  EXPECT_EQ(patches, (std::set<std::string>{"INLET_2D", "OUTLET_2D", "SYMMETRY_2D", "WALL1_2D",
                                            "WALL2_2D"}));
  EXPECT_EQ(bad_cells(mesh), 0U);
}

}  // namespace
}  // namespace camber::io
