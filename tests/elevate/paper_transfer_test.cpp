// Decay::cell: the paper's transfer (2.2.4) puts the whole displacement into the cells on the wall.
#include <camber/elevate/rescue.hpp>
#include <camber/geom/analytic_model.hpp>
#include <camber/pipeline/curve.hpp>

#include <gtest/gtest.h>

#include "layer_meshes.hpp"

namespace camber {
namespace {

using namespace testing;

MeshData layered(double first_over_edge, int refinements = 1) {
  const SurfaceMesh surface = icosphere(refinements);
  const double h = mean_edge(surface);
  return layers_on(surface, {0.0, first_over_edge * h, h, 2.0 * h},
                   [](const Vec3& x) -> Vec3 { return x.normalized(); });
}

std::vector<Index> inverted(double first_over_edge, Decay decay) {
  const auto c = make_case(layered(first_over_edge), make_sphere(Vec3::Zero(), 1.0));
  LayerFieldOptions options;
  options.decay = decay;
  return uncertified_cells(carried(*c, c->field(options), 4), all_cells(c->mesh));
}

TEST(PaperTransfer, DecaysLinearlyInTheFirstCellsAndNoFurther) {
  const SurfaceMesh surface = icosphere(1);
  const auto c = make_case(
      layers_on(surface, {0.0, 0.1, 0.5}, [](const Vec3& x) -> Vec3 { return x.normalized(); }),
      make_sphere(Vec3::Zero(), 1.0));
  LayerFieldOptions options;
  options.decay = Decay::cell;
  const LayerField field = c->field(options);
  const Index step = static_cast<Index>(surface.points.size());
  Points low(1), inside(1), top(1);
  for (Index v = 0; v < step; ++v) {
    EXPECT_LE(field.decay_length(v), 0.1);
    EXPECT_GT(field.decay_length(v), 0.09);
  }
  for (Index e : c->wall.edges) {
    const auto [a, b] = c->topology.edge2vertex[at(e)];
    field.edge(e, 2, low);
    field.edge(c->topology.find_edge(a + step, b + step), 2, top);
    EXPECT_EQ(top[0], Vec3::Zero());
    // The face between them: its middle is half way up.
    for (Index f = 0; at(f) < c->topology.face_count(); ++f) {
      const std::array<Index, 4>& v = c->topology.face2vertex[at(f)];
      if (c->topology.corners_of_face(f) != 4 || v[0] != a) continue;
      if ((v[1] != b && v[3] != b) || v[2] != b + step) continue;
      field.face(f, 2, inside);
      const double length = 0.5 * (field.decay_length(a) + field.decay_length(b));
      EXPECT_LT((inside[0] - (1.0 - 0.05 / length) * low[0]).norm(), 1e-15);
    }
  }
}

TEST(PaperTransfer, InvertsThinCellsAndOnlyThese) {
  EXPECT_EQ(inverted(1e-5, Decay::cell).size(), 80u) << "every cell on the wall";
  EXPECT_EQ(inverted(1e-2, Decay::cell).size(), 80u);
  EXPECT_TRUE(inverted(0.8, Decay::cell).empty());
  EXPECT_TRUE(inverted(1e-5, Decay::layer).empty());
  EXPECT_TRUE(inverted(0.8, Decay::layer).empty());
}

CurveResult run_from_tangled(double first_cell, int order, Smoothing smoothing) {
  CurveOptions options;
  options.orders.min_order = order;
  options.orders.max_order = order;
  options.propagation = Propagation::cell;
  options.smoothing = smoothing;
  const std::unique_ptr<GeometryModel> model = make_sphere(Vec3::Zero(), 1.0);
  return curve(layered(first_cell, 0), *model, options);
}

TEST(PaperTransfer, EndsCertifiedInAWholeRunWithoutSmoothing) {
  const CurveResult result = run_from_tangled(1e-2, 2, Smoothing::none);

  EXPECT_EQ(result.report.validity.certified, result.linear->cell_count());
  EXPECT_TRUE(uncertified_cells(*result.curved, all_cells(*result.linear)).empty());
  EXPECT_GT(result.report.rescue.patches + result.report.rescue.elastic_patches +
                result.report.rescue.orders_lowered + result.report.rescue.scaled_back,
            0u)
      << "the start was inverted";
}

TEST(PaperTransfer, IsUntangledByOneSolveWhoseCostDoesNotKnowTheFirstCell) {
  for (int order : {2, 3}) {
    std::size_t at_1e_2 = 0;
    for (double first_cell : {1e-2, 1e-4, 1e-6}) {
      const CurveResult result = run_from_tangled(first_cell, order, Smoothing::automatic);
      const auto& rescue = result.report.rescue;
      const std::size_t products = result.report.start.elastic.products;
      EXPECT_EQ(result.report.validity.certified, result.linear->cell_count()) << first_cell;
      EXPECT_EQ(rescue.patches + rescue.orders_lowered + rescue.scaled_back, 0u) << first_cell;
      EXPECT_EQ(result.report.start.taken, "elastic");
      EXPECT_GT(products, 0u);
      EXPECT_LE(products, 300u);
      EXPECT_EQ(result.report.start.elastic.unconverged, 0u);
      EXPECT_GT(result.report.validity.min_jacobian_ratio, 0.3) << first_cell;
      if (first_cell == 1e-2) at_1e_2 = products;
      EXPECT_LT(static_cast<double>(products), 1.5 * static_cast<double>(at_1e_2));
    }
  }
}

}  // namespace
}  // namespace camber
