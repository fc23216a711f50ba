// Real files: the shared cases, when they are there. The numbers are those of their README.
#include <camber/io/mesh_file.hpp>

#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include <gtest/gtest.h>

#include "sample_mesh.hpp"

namespace camber::io {
namespace {

namespace fs = std::filesystem;

struct Case {
  const char* file;
  std::size_t tets, pyramids, prisms, hexes;
};

class SharedCase : public testing::TestWithParam<Case> {};

std::map<Shape, std::size_t> count_cells(const MeshData& mesh) {
  std::map<Shape, std::size_t> counts;
  for (const ElementBlock& b : mesh.blocks) counts[b.shape] += b.size();
  return counts;
}

TEST_P(SharedCase, HasTheStatedCells) {
  const Case& c = GetParam();
  const std::string path = std::string(CAMBER_SHARED_CASES) + "/" + c.file;
  if (!fs::exists(path)) GTEST_SKIP() << path << " is absent";

  const MeshData mesh = read_mesh(path);

  std::map<Shape, std::size_t> cells = count_cells(mesh);
  EXPECT_EQ(cells[Shape::tetrahedron], c.tets);
  EXPECT_EQ(cells[Shape::pyramid], c.pyramids);
  EXPECT_EQ(cells[Shape::prism], c.prisms);
  EXPECT_EQ(cells[Shape::hexahedron], c.hexes);
  EXPECT_EQ(mesh.point_entity.size(), mesh.points.size());
  EXPECT_GT(cells[Shape::triangle] + cells[Shape::quadrilateral], 0U);
}

INSTANTIATE_TEST_SUITE_P(Gmsh, SharedCase,
                         testing::Values(Case{"ball-hybrid/linear.msh", 4338, 138, 336, 1104},
                                         Case{"wing-bl-coarse/linear.msh", 15164, 0, 36512, 0},
                                         Case{"wing-bl/linear.msh", 24048, 0, 79060, 0},
                                         Case{"foreign/onera-m6-bl/linear.msh", 25987, 0, 108624,
                                              0},
                                         Case{"layers/sphere_tet_c.msh", 838, 0, 0, 0},
                                         Case{"layers/sphere_tet_f.msh", 6169, 0, 0, 0},
                                         Case{"layers/sphere_hex.msh", 0, 0, 0, 324},
                                         Case{"layers/sphere_hexbl_2.msh", 0, 0, 0, 1536},
                                         Case{"layers/sphere_hexbl_4.msh", 0, 0, 0, 2496},
                                         Case{"layers/ellip_prism_2.msh", 1312, 0, 2000, 0},
                                         Case{"layers/ellip_prism_4.msh", 1311, 0, 5000, 0},
                                         Case{"layers/wing_hexbl_2.msh", 0, 0, 0, 3072},
                                         Case{"layers/wing_hexbl_4.msh", 0, 0, 0, 5376},
                                         Case{"layers/wing_prbl_3.msh", 0, 0, 8448, 0},
                                         Case{"layers/wing_prbl_4.msh", 0, 0, 10752, 0},
                                         Case{"layers/fillet_tet.msh", 1352, 0, 0, 0},
                                         Case{"layers/torus_tet.msh", 476, 0, 0, 0},
                                         Case{"layers/pipe_tet.msh", 1088, 0, 0, 0}),
                         [](const auto& p) {
                           std::string name = p.param.file;
                           for (char& c : name) {
                             if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
                           }
                           return name;
                         });

TEST(SharedCases, CellsHavePositiveVolume) {
  const fs::path folder = fs::path(CAMBER_SHARED_CASES) / "layers";
  if (!fs::exists(folder)) GTEST_SKIP() << folder << " is absent";
  for (const char* const name : {"sphere_hyb_2", "ellip_prism_2"}) {
    MeshData mesh = read_mesh((folder / (std::string(name) + ".msh")).string());
    std::erase_if(mesh.blocks, [](const ElementBlock& b) { return dimension(b.shape) < 3; });

    // A wrong node order would show as a negative volume.
    const std::vector<double> volumes = measures(mesh);

    EXPECT_GT(volumes.size(), 2000U);
    for (const double volume : volumes) ASSERT_GT(volume, 0.0) << name;
  }
}

TEST(SharedCases, Version22PatchesKeepTheirNames) {
  const std::string path =
      std::string(CAMBER_SHARED_CASES) + "/foreign/ahmed-body/projectcad_ahmed_linear.msh";
  if (!fs::exists(path)) GTEST_SKIP() << path << " is absent";

  const MeshData mesh = read_mesh(path);

  EXPECT_EQ(mesh.points.size(), 1915U);
  EXPECT_EQ(mesh.element_count(), 7475U);
  std::set<std::string> names;
  for (const EntityRecord& e : mesh.entities) {
    if (e.key.dim == 2) names.insert(e.name);
  }
  EXPECT_EQ(names.size(), 7U);
  EXPECT_TRUE(names.contains("Ahmed_25_full_4L_half.Symmetry_Z0"));
}

TEST(SharedCases, RewritingKeepsEverything) {
  const std::string path = std::string(CAMBER_SHARED_CASES) + "/layers/sphere_hyb_2.msh";
  if (!fs::exists(path)) GTEST_SKIP() << path << " is absent";
  const MeshData mesh = read_mesh(path);

  for (const bool binary : {false, true}) {
    write_mesh(mesh, scratch("copy.msh"), {.binary = binary});
    expect_same_mesh(mesh, read_mesh(scratch("copy.msh")), true);
  }
}

}  // namespace
}  // namespace camber::io
