#include <camber/base/error.hpp>
#include <camber/base/parallel.hpp>
#include <camber/geom/analytic_model.hpp>
#include <camber/io/base64.hpp>
#include <camber/page/page.hpp>

#include <cmath>
#include <cstring>
#include <memory>
#include <regex>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "round_block.hpp"

namespace camber {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

std::string between(const std::string& text, const std::string& from, const std::string& to) {
  const std::size_t begin = text.find(from);
  if (begin == std::string::npos) return "";
  const std::size_t end = text.find(to, begin + from.size());
  return text.substr(begin + from.size(), end - begin - from.size());
}

/// Words of 32 bits of an array of the page.
std::vector<std::int32_t> words(const std::string& page, const std::string& name) {
  const std::string rest = between(page, "data-array=\"" + name + "\"", "</script>");
  return io::decode_base64(rest.substr(rest.find('>') + 1)).value();
}

std::vector<float> floats(const std::string& page, const std::string& name) {
  const std::vector<std::int32_t> bits = words(page, name);
  std::vector<float> values(bits.size());
  std::memcpy(values.data(), bits.data(), bits.size() * sizeof(float));
  return values;
}

nlohmann::json about(const std::string& page) {
  return nlohmann::json::parse(between(page, "data-json=\"about\">", "</script>"));
}

PageContent content_of(MeshData mesh) {
  CellFindings findings;
  const Report report = check(mesh, nullptr, {}, &findings);
  return page_content(std::move(mesh), std::move(findings), report, nullptr);
}

TEST(PageHtml, HoldsWhatIsKnownOfEveryCell) {
  const PageContent content = content_of(test::round_block(2, 2));

  const std::string page = page_html(content, nullptr);

  const nlohmann::json facts = about(page);
  EXPECT_EQ(facts["cells"], 8);
  EXPECT_EQ(facts["faces"], 24);
  EXPECT_EQ(facts["title"], "block.msh");
  EXPECT_EQ(facts["patches"].size(), 2u);
  EXPECT_FALSE(facts["has_deviation"]);
  const std::vector<float> bound = floats(page, "cell_bound"), cost = floats(page, "cell_cost");
  ASSERT_EQ(bound.size(), 8u);
  ASSERT_EQ(cost.size(), 8u);
  for (std::size_t c = 0; c < 8; ++c) {
    EXPECT_EQ(bound[c], static_cast<float>(content.findings.bound[c]));
    EXPECT_EQ(cost[c], static_cast<float>(content.findings.cost[c]));
  }
  EXPECT_EQ(words(page, "face_cell").size(), 24u);
  EXPECT_EQ(words(page, "volume_node").size(), 8u * 27u);
}

TEST(PageHtml, PointsOfTheSurfaceLieOnTheMesh) {
  const std::string page = page_html(content_of(test::round_block(2, 3)), nullptr);

  const std::vector<float> x = floats(page, "point");

  ASSERT_GT(x.size(), 300u);
  for (std::size_t i = 0; i < x.size(); i += 3) {
    EXPECT_NEAR(std::hypot(x[i], x[i + 1], x[i + 2]), 1.0, 0.01);
  }
}

TEST(PageHtml, ShowsHowFarTheSurfaceIsFromTheCad) {
  // Linear faces on the unit sphere: each misses by 1 minus the distance of its nearest points, the
  // curved ones by far less. Only "top" has a surface element, and so a CAD face.
  const std::unique_ptr<GeometryModel> sphere = make_sphere(Vec3::Zero(), 1.0);
  const auto largest = [&](int order) {
    PageContent content = content_of(test::round_block(2, order));
    content.surface_groups.assign(4, GeometryGroup{{2, 1}});
    const std::string page = page_html(content, sphere.get());
    EXPECT_TRUE(about(page)["has_deviation"]);
    double cell = 0.0, point = 0.0, linear = 0.0;
    for (float d : floats(page, "cell_deviation")) cell = std::fmax(cell, d);  // NaN is left out
    for (float d : floats(page, "point_deviation")) point = std::fmax(point, d);
    for (float d : floats(page, "face_linear_deviation")) linear = std::fmax(linear, d);
    EXPECT_LE(point, 1.3 * cell);  // Gauss points and lattice points see nearly the same
    EXPECT_GE(point, 0.7 * cell);
    return std::pair(cell, linear);
  };

  const auto [flat, flat_linear] = largest(1);
  const auto [curved, curved_linear] = largest(3);

  EXPECT_FLOAT_EQ(static_cast<float>(flat), static_cast<float>(flat_linear));
  EXPECT_FLOAT_EQ(static_cast<float>(flat), static_cast<float>(curved_linear));
  EXPECT_GT(flat, 0.05);
  EXPECT_LT(curved, 0.02 * flat);
}

TEST(PageHtml, IsTheSameForAnyNumberOfThreads) {
  const PageContent content = content_of(test::round_block(3, 2));
  const auto run = [&](int threads) {
    const ThreadLimit limit(threads);
    return page_html(content, nullptr);
  };

  EXPECT_TRUE(run(1) == run(2));
}

TEST(PageHtml, LoadsNothingFromOutside) {
  const std::string page = page_html(content_of(test::round_block(1, 2)), nullptr);

  // Addresses in the text of licences and messages are no harm; elements that load are.
  EXPECT_FALSE(
      std::regex_search(page.substr(0, 4000), std::regex("<(script|img|iframe)[^>]*src=")));
  EXPECT_THAT(page, Not(HasSubstr("<link ")));
  EXPECT_THAT(page, Not(HasSubstr("<script src")));
  EXPECT_THAT(page, Not(HasSubstr("@import")));
  EXPECT_THAT(page, HasSubstr("three.js authors"));  // its licence asks for the notice
}

TEST(PageHtml, NamesCannotEndTheirElement) {
  MeshData mesh = test::round_block(1, 2);
  mesh.source = "<b>&\"</script>.msh";
  mesh.entities.front().name = "</script><script>alert(1)</script>";

  const std::string page = page_html(content_of(std::move(mesh)), nullptr);

  EXPECT_THAT(page, Not(HasSubstr("<script>alert")));
  EXPECT_EQ(about(page)["patches"][1], "</script><script>alert(1)</script>");
}

TEST(PageHtml, ShowsCornersOnlyWhereTheVolumeIsTooLarge) {
  PageOptions options;
  options.max_volume_bytes = 100;

  const std::string page = page_html(content_of(test::round_block(2, 2)), nullptr, options);

  EXPECT_TRUE(about(page)["corners_only"]);
  EXPECT_EQ(about(page)["notices"].size(), 1u);
  EXPECT_EQ(words(page, "volume_node").size(), 8u * 8u);
  EXPECT_EQ(floats(page, "volume_point").size(), 27u * 3u);
}

TEST(PageHtml, SaysWhenTheSurfaceIsDrawnCoarser) {
  PageOptions options;
  options.tessellation.max_triangles = 500;

  const nlohmann::json facts =
      about(page_html(content_of(test::round_block(2, 3)), nullptr, options));

  EXPECT_LE(facts["triangles"].get<int>(), 500);
  EXPECT_THAT(facts["notices"][0].get<std::string>(), HasSubstr("500 triangles"));
}

TEST(PageHtml, RefusesAMeshWithoutCells) {
  MeshData mesh = test::round_block(1, 1);
  PageContent content;
  content.mesh = mesh;
  content.mesh.blocks.erase(content.mesh.blocks.begin());

  EXPECT_THROW((void)page_html(content, nullptr), MeshError);
}

}  // namespace
}  // namespace camber
