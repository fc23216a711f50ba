// What the options of curve() do, and that its bits depend on nothing else.
#include <camber/base/error.hpp>
#include <camber/base/parallel.hpp>

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "curve_cases.hpp"

namespace camber {
namespace {

using testing::Bits;
using testing::bits_of;
using testing::curve_case;
using testing::expect_promises;
using testing::order;

std::size_t nodes_above_order_one(const CurveResult& result) {
  return result.curved->high_order_node_count();
}

TEST(CurveBits, DoNotDependOnThreadsNorOnTheRun) {
  for (const char* name : {"ball", "elbow"}) {
    std::vector<Bits> seen;
    for (int threads : {1, 2, 4, 8, 1}) {
      const ThreadLimit limit(threads);
      seen.push_back(bits_of(curve_case(name, order(3))));
    }
    for (std::size_t i = 1; i < seen.size(); ++i)
      EXPECT_EQ(seen[i], seen[0]) << name << " run " << i;
  }
}

TEST(CurveBits, OfTheWingDoNotDependOnThreads) {
  std::vector<Bits> seen;
  for (int threads : {1, 4, 8}) {
    const ThreadLimit limit(threads);
    seen.push_back(bits_of(curve_case("wing", order(2))));
  }
  EXPECT_EQ(seen[1], seen[0]);
  EXPECT_EQ(seen[2], seen[0]);
}

TEST(CurveOptions, OrderOneLeavesTheMeshLinear) {
  const CurveResult result = curve_case("ball", order(1));

  EXPECT_EQ(nodes_above_order_one(result), 0u);
  EXPECT_EQ(result.report.surface.maximum, result.report.surface.linear_maximum);
  EXPECT_GT(result.report.surface.faces_over_deviation, 0u);
  expect_promises(result);
}

TEST(CurveOptions, FittingWallNodesBringsCubicFacesMuchNearerToTheCad) {
  CurveOptions options = order(3);
  options.orders.min_order = 3;
  const double evenly_spread = curve_case("ball", options).report.surface.average;
  options.fit = true;
  const CurveResult fitted = curve_case("ball", options);

  EXPECT_LT(fitted.report.surface.average, 0.1 * evenly_spread);
  expect_promises(fitted);
}

TEST(CurveOptions, UniformWritesAllCellsAtTheHighestOrderWithTheSameShape) {
  CurveOptions options = order(3);
  options.uniform = true;
  const CurveResult result = curve_case("ball", options);

  ExportMap map;
  const MeshData mixed = export_mesh(*result.curved, 0, &map);
  const MeshData uniform = exported(result, options);

  std::set<int> mixed_orders, uniform_orders;
  for (const ElementBlock& block : mixed.blocks) {
    if (dimension(block.shape) == 3) mixed_orders.insert(block.order);
  }
  for (const ElementBlock& block : uniform.blocks) uniform_orders.insert(block.order);
  EXPECT_GT(mixed_orders.size(), 1u);
  EXPECT_EQ(uniform_orders, std::set<int>{3});
  EXPECT_EQ(result.report.output.cells_by_order,
            (std::map<int, std::size_t>{{3, result.linear->cell_count()}}));
}

TEST(CurveOptions, ExportedMeshCarriesOneValuePerElementOfEachField) {
  const CurveResult result = curve_case("ball", order(2));

  const MeshData data = exported(result, order(2));

  ASSERT_EQ(data.element_fields.size(), 4u);
  for (const Field& field : data.element_fields)
    EXPECT_EQ(field.values.size(), data.element_count()) << field.name;
  const Field& deviation = data.element_fields[3];
  double largest = 0.0;
  for (double d : deviation.values) largest = std::isnan(d) ? largest : std::max(largest, d);
  EXPECT_EQ(largest, result.report.surface.maximum);
}

TEST(CurveOptions, MinimumOrderIsKeptByEveryCell) {
  CurveOptions options = order(3);
  options.orders.min_order = 2;

  const CurveResult result = curve_case("elbow", options);

  const std::vector<std::uint8_t>& orders = result.curved->orders().cell;
  EXPECT_EQ(*std::min_element(orders.begin(), orders.end()), 2);
  expect_promises(result);
}

TEST(CurveOptions, ATighterDeviationAsksForMoreNodesAndComesNearer) {
  std::size_t nodes = 0;
  double average = 1.0;
  for (double deviation : {0.1, 0.01, 0.001}) {
    CurveOptions options = order(4);
    options.orders.deviation = deviation;
    const CurveResult result = curve_case("elbow", options);
    expect_promises(result);
    EXPECT_GE(nodes_above_order_one(result), nodes);
    EXPECT_LE(result.report.surface.average, average);
    nodes = nodes_above_order_one(result);
    average = result.report.surface.average;
  }
}

TEST(CurveOptions, TheLengthOfTheCellAsksForMoreThanThatOfTheFace) {
  CurveOptions face = order(4), cell = order(4);
  cell.orders.deviation_length = DeviationLength::cell;

  const CurveResult of_face = curve_case("ball", face), of_cell = curve_case("ball", cell);

  expect_promises(of_cell);
  EXPECT_GT(nodes_above_order_one(of_cell), nodes_above_order_one(of_face));
  // A first cell of 1e-3 wall edges asks for 1e-5 of the edge: out of reach, so the highest order
  // everywhere.
  for (Index f = 0; at(f) < of_cell.topology->face_count(); ++f) {
    if (std::isnan(of_cell.face_deviation[at(f)])) continue;
    EXPECT_EQ(of_cell.curved->face_order(f), 4);
  }
}

TEST(CurveOptions, AGivenLengthIsMeasuredAgainst) {
  CurveOptions options = order(4);
  options.orders.deviation_length = DeviationLength::given;
  options.orders.length = 0.1;
  options.orders.deviation = 0.02;

  const CurveResult result = curve_case("ball", options);

  expect_promises(result);
  EXPECT_EQ(result.report.surface.faces_over_deviation, 0u);
  EXPECT_LE(result.report.surface.maximum, 0.002);
  EXPECT_GT(result.report.surface.linear_maximum, 0.002);
}

TEST(CurveOptions, AFixedWallStaysAsItIs) {
  CurveOptions options = order(3);
  options.association.patches["ball"] = PatchRule::fixed;

  const CurveResult result = curve_case("ball", options);

  EXPECT_EQ(nodes_above_order_one(result), 0u);
  EXPECT_EQ(result.report.surface.faces, 0u);
}

TEST(CurveOptions, StrictMakesFacesOverTheDeviationAFailure) {
  CurveOptions options = order(2);
  options.orders.deviation = 1e-5;
  EXPECT_EQ(curve_case("ball", options).report.exit_code, 0);

  options.strict = true;
  const Report report = curve_case("ball", options).report;

  EXPECT_GT(report.surface.faces_over_deviation, 0u);
  EXPECT_EQ(report.status, "over_deviation");
  EXPECT_EQ(report.exit_code, 3);
}

TEST(CurveOptions, OutsideTheirRangeAreRefused) {
  const auto with = [](int lowest, int highest, double deviation) {
    CurveOptions options = order(highest);
    options.orders.min_order = lowest;
    options.orders.deviation = deviation;
    return options;
  };
  EXPECT_THROW(static_cast<void>(curve_case("ball", with(1, 0, 0.01))), OptionError);
  EXPECT_THROW(static_cast<void>(curve_case("ball", with(1, k_max_order + 1, 0.01))), OptionError);
  EXPECT_THROW(static_cast<void>(curve_case("ball", with(3, 2, 0.01))), OptionError);
  EXPECT_THROW(static_cast<void>(curve_case("ball", with(1, 2, 0.0))), OptionError);
  CurveOptions options = order(2);
  options.orders.deviation_length = DeviationLength::given;
  EXPECT_THROW(static_cast<void>(curve_case("ball", options)), OptionError);
}

TEST(CurveProgress, RisesToOne) {
  const std::unique_ptr<GeometryModel> geometry = testing::case_geometry("ball");
  std::vector<double> fractions;
  Progress progress;
  progress.report = [&](std::string_view, double fraction) { fractions.push_back(fraction); };

  static_cast<void>(curve(testing::case_mesh("ball"), *geometry, order(2), progress));

  ASSERT_FALSE(fractions.empty());
  EXPECT_TRUE(std::is_sorted(fractions.begin(), fractions.end()));
  EXPECT_EQ(fractions.back(), 1.0);
}

TEST(CurveProgress, StopsTheRunWhenItIsCancelled) {
  const std::unique_ptr<GeometryModel> geometry = testing::case_geometry("ball");
  int asked = 0;
  Progress progress;
  progress.cancelled = [&] { return ++asked == 3; };

  EXPECT_THROW(static_cast<void>(curve(testing::case_mesh("ball"), *geometry, order(2), progress)),
               Cancelled);
  EXPECT_EQ(asked, 3);
}

}  // namespace
}  // namespace camber
