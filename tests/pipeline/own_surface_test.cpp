// curve_without_cad(): how near a geometry made from the mesh alone comes to the true one.
#include <camber/basis/lagrange.hpp>
#include <camber/basis/lattice.hpp>
#include <camber/pipeline/check.hpp>
#include <camber/pipeline/geometry_source.hpp>
#include <camber/pipeline/own_surface.hpp>

#include <cmath>
#include <filesystem>

#include <fmt/format.h>

#include "curve_cases.hpp"
#include "layer_meshes.hpp"

namespace camber {
namespace {

using namespace testing;

/// Largest distance of curved wall faces (surface entity 1), at order q everywhere.
double wall_error(const MeshData& mesh, int q, const std::function<double(const Vec3&)>& distance) {
  CurveOptions options = order(q);
  options.orders.min_order = q;
  options.smoothing = Smoothing::none;
  const CurveResult result = curve_without_cad(mesh, {}, options);
  EXPECT_EQ(result.report.validity.certified, result.linear->cell_count());
  double worst = 0.0;
  for (Index f = 0; at(f) < result.topology->face_count(); ++f) {
    const Patch* patch = result.association.patch_of(f);
    if (!patch || patch->entity != 1) continue;
    const Shape shape = result.topology->face_shape[at(f)];
    Points nodes(static_cast<std::size_t>(node_count(shape, q)));
    result.curved->face_lattice(f, q, nodes);
    for (const Vec3& xi : lattice_xi(shape, 7)) {
      worst = std::max(worst, distance(evaluate(shape, q, nodes, xi)));
    }
  }
  return worst;
}

Vec3 outwards(const Vec3& x) { return x.normalized(); }
double off_sphere(const Vec3& x) { return std::abs(x.norm() - 1.0); }
Vec3 from_ring(const Vec3& x) {
  const Vec3 ring = 2.0 * Vec3(x.x(), x.y(), 0.0).normalized();
  return (x - ring).normalized();
}
double off_torus(const Vec3& x) {
  const Vec3 ring = 2.0 * Vec3(x.x(), x.y(), 0.0).normalized();
  return std::abs((x - ring).norm() - 0.7);
}

TEST(WithoutCad, ConvergesToTheTrueSurfaceAtEveryOrder) {
  struct Row {
    const char* name;
    MeshData coarse, fine;
    std::function<double(const Vec3&)> distance;
  };
  const std::vector<double> heights{0.0, 0.5};
  const Row rows[] = {
      {"sphere, prisms", layers_on(icosphere(2), heights, outwards),
       layers_on(icosphere(3), heights, outwards), off_sphere},
      {"sphere, hexes", layers_on(cubed_sphere(6), heights, outwards),
       layers_on(cubed_sphere(12), heights, outwards), off_sphere},
      {"torus, hexes", layers_on(torus_grid(2.0, 0.7, 24, 16, false), heights, from_ring),
       layers_on(torus_grid(2.0, 0.7, 48, 32, false), heights, from_ring), off_torus}};
  const double least_rate[] = {0.0, 0.0, 2.8, 3.5, 4.2};
  for (const Row& row : rows) {
    for (int q = 2; q <= 4; ++q) {
      const double coarse = wall_error(row.coarse, q, row.distance),
                   fine = wall_error(row.fine, q, row.distance), rate = std::log2(coarse / fine);
      RecordProperty(fmt::format("{}, order {}", row.name, q),
                     fmt::format("{:.3g} {:.3g} rate {:.2f}", coarse, fine, rate));
      EXPECT_GT(rate, least_rate[q]) << row.name << " order " << q << ": " << coarse << " " << fine;
    }
  }
}

TEST(WithoutCad, CurvesTheBundledCasesTowardsTheirCad) {
  for (const char* name : {"ball", "elbow", "wing"}) {
    SCOPED_TRACE(name);
    const CurveOptions options = order(3);
    const CurveResult result = curve_without_cad(case_mesh(name), {}, options);
    expect_promises(result);
    EXPECT_EQ(result.report.status, "ok");
    EXPECT_EQ(result.report.link.method, "mesh");

    const std::unique_ptr<GeometryModel> cad = case_geometry(name);
    const Report truth = check(exported(result, options), cad.get(), {});
    EXPECT_LT(truth.surface.average, 0.6 * truth.surface.linear_average);
    EXPECT_LT(truth.surface.maximum, 0.7 * truth.surface.linear_maximum);
  }
}

TEST(WithoutCad, EndsCertifiedOnAWingOfFiftyThousandCells) {
  const std::string path = std::string(CAMBER_SHARED_CASES) + "/wing-bl-coarse/linear.msh";
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";

  const CurveResult result = curve_without_cad(io::read_mesh(path), {}, order(3));

  expect_promises(result);
}

TEST(WithoutCad, ThePlanesOfABoxStayPlanesAndItsEdgesSharp) {
  const CurveResult result = curve_without_cad(case_mesh("ball"), {}, order(3));
  std::size_t planes = 0;
  for (const Patch& patch : result.association.patches) {
    planes += patch.kind == PatchKind::plane;
    EXPECT_EQ(patch.kind == PatchKind::cad, patch.name == "ball");
  }
  EXPECT_EQ(planes, 6u);
}

TEST(WithoutCad, AFinerSurfaceMeshOrAnAnalyticSurfaceCanBeTheGeometry) {
  const std::string finer = ::testing::TempDir() + "camber_finer.msh";
  MeshData surface;
  const SurfaceMesh sphere = icosphere(3);
  surface.points = sphere.points;
  for (const std::array<Index, 4>& face : sphere.faces) {
    append_element(surface, Shape::triangle, 1, {face[0], face[1], face[2]});
  }
  io::write_mesh(surface, finer);
  CurveOptions options = order(3);
  options.link_by = LinkBy::shape;
  options.scale = 1.0;
  for (const std::string& source : {finer, std::string("sphere:0,0,0,1")}) {
    ASSERT_TRUE(is_geometry_without_cad(source));
    const std::unique_ptr<GeometryModel> geometry = make_geometry(source);
    options.association.distance_tolerance = 2e-2;  // the vertices are not those of the finer mesh
    const CurveResult result = curve(case_mesh("ball"), *geometry, options);
    expect_promises(result);
    const std::unique_ptr<GeometryModel> cad = case_geometry("ball");
    const Report truth = check(exported(result, options), cad.get(), {});
    EXPECT_LT(truth.surface.maximum, 1e-3) << source;
  }
  std::filesystem::remove(finer);
}

TEST(WithoutCad, RulesForPatchesHold) {
  CurveOptions options = order(3);
  options.association.patches["ball"] = PatchRule::fixed;
  const CurveResult result = curve_without_cad(case_mesh("ball"), {}, options);
  for (Index c = 0; at(c) < result.linear->cell_count(); ++c) {
    EXPECT_EQ(result.curved->cell_order(c), 1);
  }
}

}  // namespace
}  // namespace camber
