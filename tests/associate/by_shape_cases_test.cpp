// Meshes with the CAD's tags against what is found when these are taken away.
#include <camber/associate/by_shape.hpp>
#include <camber/associate/cad_scale.hpp>
#include <camber/base/error.hpp>
#include <camber/geom_occ/cad_file.hpp>
#include <camber/io/mesh_file.hpp>

#include <filesystem>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace camber {
namespace {

struct Case {
  const char* name;  // of the test
  const char* mesh;  // file, in the project's cases or (shared) in those beside it
  const char* cad;
  bool is_shared;
};

/// The mesh as a format without association would hold it: cells and nothing else.
MeshData stripped(MeshData data) {
  std::erase_if(data.blocks, [](const ElementBlock& block) { return dimension(block.shape) < 3; });
  data.point_entity.clear();
  data.point_parameters.clear();
  data.entities.clear();
  data.physical_names.clear();
  return data;
}

class ByShape : public ::testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    const std::string root = GetParam().is_shared ? std::string(CAMBER_SHARED_CASES) + "/"
                                                  : std::string(CAMBER_SOURCE_DIR) + "/cases/";
    if (!std::filesystem::exists(root + GetParam().mesh)) GTEST_SKIP() << "no " << GetParam().mesh;
    tagged_ = io::read_mesh(root + GetParam().mesh);
    geometry_ = read_cad(root + GetParam().cad);
    mesh_ = build_linear_mesh(tagged_);
    topology_ = build_topology(mesh_);
    fit_cad_scale(tagged_, *geometry_);
    expected_ = associate_by_tags(mesh_, topology_, *geometry_);
  }

  [[nodiscard]] ShapeLink link() {
    bare_ = build_linear_mesh(stripped(tagged_));
    bare_topology_ = build_topology(bare_);
    const double scale = geometry_->scale();
    fit_cad_scale_by_shape(bare_, bare_topology_, *geometry_);
    EXPECT_DOUBLE_EQ(geometry_->scale(), scale);
    return associate_by_shape(bare_, bare_topology_, *geometry_);
  }

  [[nodiscard]] bool is_sharp(Index e, const std::vector<std::array<Index, 2>>& sides) const {
    const auto [a, b] = sides[at(e)];
    if (a == k_none || b == k_none) return true;
    return outward_normal(mesh_, topology_, a).dot(outward_normal(mesh_, topology_, b)) <
           k_sharp_cosine;
  }

  static constexpr double k_sharp_cosine = 0.866;
  MeshData tagged_;
  std::unique_ptr<GeometryModel> geometry_;
  LinearMesh mesh_, bare_;
  Topology topology_, bare_topology_;
  Association expected_;
};

TEST_P(ByShape, FindsTheCadFacesAndCurvesOfTheTags) {
  const ShapeLink found = link();

  ASSERT_EQ(topology_.face2vertex, bare_topology_.face2vertex);
  std::size_t faces = 0, same = 0;
  std::vector<std::array<Index, 2>> sides(topology_.edge_count(), {k_none, k_none});
  for (Index f = 0; at(f) < topology_.face_count(); ++f) {
    if (!topology_.is_boundary(f)) continue;
    const Patch *expected = expected_.patch_of(f), *actual = found.association.patch_of(f);
    ASSERT_NE(expected, nullptr);
    ASSERT_NE(actual, nullptr);
    ++faces;
    same += expected->group == actual->group && expected->kind == actual->kind;
    for (int i = 0; i < topology_.corners_of_face(f); ++i) {
      std::array<Index, 2>& two =
          sides[at(topology_.face2edge[at(f)][static_cast<std::size_t>(i)])];
      (two[0] == k_none ? two[0] : two[1]) = f;
    }
  }
  std::size_t edges = 0, same_edges = 0, sharp = 0, same_sharp = 0;
  for (Index e = 0; at(e) < topology_.edge_count(); ++e) {
    const GeomEntity expected = expected_.edge2curve[at(e)];
    const GeomEntity actual = found.association.edge2curve[at(e)];
    if (expected.dim != 1) {
      // Two bundled meshes follow seams without line elements there.
      if (actual.dim == 1) {
        const std::vector<int> around = geometry_->faces_of_curve(actual.tag);
        EXPECT_TRUE(around.size() == 1 && geometry_->is_seam(actual.tag, around.front())) << e;
      }
      continue;
    }
    ++edges;
    same_edges += expected == actual;
    if (!is_sharp(e, sides)) continue;
    ++sharp;
    same_sharp += expected == actual;
  }
  RecordProperty("faces", static_cast<int>(faces));
  RecordProperty("same_faces", static_cast<int>(same));
  EXPECT_GE(static_cast<double>(same), 0.999 * static_cast<double>(faces)) << faces - same;
  EXPECT_EQ(same_sharp, sharp) << sharp;
  EXPECT_EQ(same_edges, edges) << edges;
  EXPECT_EQ(found.straddling, 0u);
  EXPECT_LE(found.association.largest_distance, expected_.largest_distance * (1 + 1e-6));
}

constexpr Case k_cases[] = {
    {"Ball", "ball/linear.msh", "ball/body.step", false},
    {"Wing", "wing/linear.msh", "wing/body.step", false},
    {"Elbow", "elbow/linear.msh", "elbow/body.step", false},
    {"BallHybrid", "ball-hybrid/linear.msh", "ball-hybrid/body.step", true},
    {"WingBlCoarse", "wing-bl-coarse/linear.msh", "wing-bl-coarse/body.step", true},
    {"WingBl", "wing-bl/linear.msh", "wing-bl/body.step", true},
    {"SphereHyb4", "layers/sphere_hyb_4.msh", "layers/sphere_hyb_4.brep", true},
    {"SphereHex", "layers/sphere_hex.msh", "layers/sphere_hex.brep", true},
    {"Ellipsoid4", "layers/ellip_prism_4.msh", "layers/ellip_prism_4.brep", true},
    {"WingHexbl2", "layers/wing_hexbl_2.msh", "layers/wing_hexbl_2.brep", true},
    {"SphereTet", "layers/sphere_tet_c.msh", "layers/sphere_tet_c.brep", true},
    {"SphereHexbl4", "layers/sphere_hexbl_4.msh", "layers/sphere_hexbl_4.brep", true},
    {"Fillet", "layers/fillet_tet.msh", "layers/fillet_tet.brep", true},
    {"Torus", "layers/torus_tet.msh", "layers/torus_tet.brep", true},
    {"Pipe", "layers/pipe_tet.msh", "layers/pipe_tet.brep", true},
    {"OneraM6Bl", "foreign/onera-m6-bl/linear.msh", "foreign/onera-m6-bl/body.step", true},
    {"HighLift", "foreign/crmhl-2d-section/gen/crm2d_hyb_coarse.msh",
     "foreign/crmhl-2d-section/gen/domain.brep", true},
};

INSTANTIATE_TEST_SUITE_P(Cases, ByShape, ::testing::ValuesIn(k_cases),
                         [](const auto& one) { return std::string(one.param.name); });

}  // namespace
}  // namespace camber
