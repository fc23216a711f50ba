#include <camber/base/error.hpp>
#include <camber/reconstruct/detail/facet_set.hpp>
#include <camber/reconstruct/reconstruct.hpp>

#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "surfaces.hpp"

namespace camber {
namespace {

using namespace testing;

/// Largest of `distance` over a fine lattice of all facets of the model.
double worst(const FacetMesh& mesh, GeometryModel& model, const Features& features,
             const std::function<double(const Vec3&)>& distance) {
  const auto projector = model.projector();
  double result = 0.0;
  for (Index f = 0; at(f) < mesh.facets.size(); ++f) {
    const bool is_triangle = mesh.corner_count(f) == 3;
    for (int j = 0; j <= 7; ++j) {
      for (int i = 0; i <= (is_triangle ? 7 - j : 7); ++i) {
        const Vec2 uv = detail::packed(f, Vec2(i, j) / 7.0);
        const Vec3 x = projector->evaluate_face(features.region[at(f)] + 1, uv).point;
        result = std::max(result, distance(x));
      }
    }
  }
  return result;
}

double off_sphere(const Vec3& x) { return std::abs(x.norm() - 1.0); }
double off_torus(const Vec3& x) {
  return std::abs(std::hypot(std::hypot(x.x(), x.y()) - 2.0, x.z()) - 0.7);
}

std::vector<double> errors(const std::vector<FacetMesh>& meshes,
                           const std::function<double(const Vec3&)>& distance) {
  std::vector<double> list;
  for (const FacetMesh& mesh : meshes) {
    const auto model = reconstruct(mesh);
    list.push_back(worst(mesh, *model, model->features(), distance));
  }
  return list;
}

TEST(Reconstruction, ConvergesOnSmoothSurfaces) {
  struct Row {
    const char* name;
    std::vector<FacetMesh> meshes;
    std::function<double(const Vec3&)> distance;
  };
  const Row rows[] = {
      {"sphere, triangles",
       {facets_of(icosphere(2)), facets_of(icosphere(3)), facets_of(icosphere(4))},
       off_sphere},
      {"sphere, quads",
       {facets_of(cubed_sphere(6)), facets_of(cubed_sphere(12)), facets_of(cubed_sphere(24))},
       off_sphere},
      {"torus, triangles",
       {facets_of(torus_grid(2.0, 0.7, 24, 16, true)),
        facets_of(torus_grid(2.0, 0.7, 48, 32, true)),
        facets_of(torus_grid(2.0, 0.7, 96, 64, true))},
       off_torus},
      {"torus, quads",
       {facets_of(torus_grid(2.0, 0.7, 24, 16, false)),
        facets_of(torus_grid(2.0, 0.7, 48, 32, false)),
        facets_of(torus_grid(2.0, 0.7, 96, 64, false))},
       off_torus}};
  for (const Row& row : rows) {
    const std::vector<double> e = errors(row.meshes, row.distance);
    RecordProperty(row.name, std::to_string(e.back()));
    EXPECT_GT(std::log2(e[1] / e[2]), 3.8)
        << row.name << ": " << e[0] << " " << e[1] << " " << e[2];
    EXPECT_LT(e[1], 3e-4) << row.name;
  }
}

TEST(Reconstruction, KeepsRimsSharpAndCapsFlat) {
  std::vector<double> rim, side;
  for (int n : {12, 24, 48}) {
    const FacetMesh mesh = capped_cylinder(n);
    const auto model = reconstruct(mesh);
    ASSERT_EQ(model->count(2), 3);
    ASSERT_EQ(model->count(1), 2);
    const auto projector = model->projector();
    rim.push_back(0.0);
    for (int c = 1; c <= 2; ++c) {
      EXPECT_GT(model->range(c).period, 0.0);
      for (int k = 0; k <= 20 * n; ++k) {
        const Vec3 x = projector->evaluate_curve(c, k / 20.0).point;
        EXPECT_NEAR(std::abs(x.z()), 1.0, 1e-14);
        rim.back() = std::max(rim.back(), std::abs(x.head<2>().norm() - 1.0));
      }
      EXPECT_EQ(model->faces_of_curve(c).size(), 2u);
    }
    int planes = 0;
    for (int f = 1; f <= 3; ++f) planes += model->is_planar(f);
    EXPECT_EQ(planes, 2);
    side.push_back(worst(mesh, *model, model->features(), [](const Vec3& x) {
      return std::min(std::abs(x.head<2>().norm() - 1.0), std::abs(std::abs(x.z()) - 1.0));
    }));
  }
  EXPECT_GT(std::log2(rim[1] / rim[2]), 3.8) << rim[0] << " " << rim[1] << " " << rim[2];
  EXPECT_GT(std::log2(side[1] / side[2]), 3.8) << side[0] << " " << side[1] << " " << side[2];
}

TEST(Reconstruction, PassesThroughItsPointsWithoutGaps) {
  for (const FacetMesh& mesh : {facets_of(icosphere(2)), capped_cylinder(12)}) {
    const Features features = find_features(mesh);
    const auto model = reconstruct(mesh);
    const auto projector = model->projector();
    const auto on_edge = [&](Index f, Index e, double s) {
      std::size_t i = 0;
      while (features.facet2edge[at(f)][i] != e) ++i;
      const std::size_t n = mesh.corner_count(f);
      if (mesh.facets[at(f)][i] > mesh.facets[at(f)][(i + 1) % n]) s = 1.0 - s;
      const std::span<const Vec3> xi = corners(n == 3 ? Shape::triangle : Shape::quadrilateral);
      const Vec3 uv = (1.0 - s) * xi[i] + s * xi[(i + 1) % n];
      return projector->evaluate_face(features.region[at(f)] + 1, detail::packed(f, uv.head<2>()))
          .point;
    };
    for (Index e = 0; at(e) < features.edges.size(); ++e) {
      const FacetEdge& edge = features.edges[at(e)];
      for (double s : {0.0, 0.13, 0.5, 0.77, 1.0}) {
        const Vec3 x = on_edge(edge.facet[0], e, s);
        EXPECT_NEAR((x - on_edge(edge.facet[1], e, s)).norm(), 0.0, 1e-12);
        if (s == 0.0) {
          EXPECT_NEAR((x - mesh.points[at(edge.vertex[0])]).norm(), 0.0, 1e-12);
        }
        if (s == 1.0) {
          EXPECT_NEAR((x - mesh.points[at(edge.vertex[1])]).norm(), 0.0, 1e-12);
        }
      }
    }
  }
}

TEST(Reconstruction, ProjectsAsTheNaiveSearchDoes) {
  const FacetMesh mesh = capped_cylinder(12);
  const auto model = reconstruct(mesh);
  const auto projector = model->projector();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> uniform(-1.5, 1.5);
  for (int k = 0; k < 40; ++k) {
    const Vec3 x(uniform(random), uniform(random), uniform(random));
    for (int face = 1; face <= 3; ++face) {
      double nearest = 1e300;
      for (Index f = 0; at(f) < mesh.facets.size(); ++f) {
        if (model->features().region[at(f)] != face - 1) continue;
        for (int j = 0; j <= 20; ++j) {
          for (int i = 0; i <= (mesh.corner_count(f) == 3 ? 20 - j : 20); ++i) {
            const Vec2 uv = detail::packed(f, Vec2(i, j) / 20.0);
            nearest = std::min(nearest, (projector->evaluate_face(face, uv).point - x).norm());
          }
        }
      }
      const Projection foot = projector->closest({2, face}, x);
      ASSERT_NE(foot.status, ProjectionStatus::failed);
      EXPECT_LE(foot.distance, nearest + 1e-12);
      EXPECT_GE(foot.distance, nearest - 0.02);
      EXPECT_NEAR((projector->evaluate_face(face, foot.uv).point - foot.point).norm(), 0.0, 1e-12);
      const Projection again = projector->closest({2, face}, x, foot.uv);
      EXPECT_NEAR((again.point - foot.point).norm(), 0.0, 1e-9);
    }
  }
}

TEST(Reconstruction, KnowsWhereItsCurvesLieOnItsFaces) {
  const FacetMesh mesh = capped_cylinder(12);
  const auto model = reconstruct(mesh);
  const auto projector = model->projector();
  for (int c = 1; c <= 2; ++c) {
    for (double t : {0.0, 0.3, 4.75, 11.9}) {
      const Vec3 x = projector->evaluate_curve(c, t).point;
      for (int face : model->faces_of_curve(c)) {
        const Vec2 uv = model->curve_on_face(c, face, t);
        EXPECT_NEAR((projector->evaluate_face(face, uv).point - x).norm(), 0.0, 1e-12);
      }
      EXPECT_NEAR(projector->closest({1, c}, x).distance, 0.0, 1e-12);
    }
    EXPECT_NEAR(projector->curve_length(c, 0.0, 12.0), 2.0 * std::numbers::pi, 5e-3);
  }
}

TEST(Reconstruction, MeetsLinesWithinTheirReach) {
  const FacetMesh mesh = facets_of(icosphere(2));
  const auto model = reconstruct(mesh);
  const auto projector = model->projector();
  const Vec3 x(0.1, 0.2, 0.3), d = Vec3(0.3, -0.5, 0.9).normalized();
  EXPECT_FALSE(projector->along_line(1, x, d, 0.1));
  const auto hit = projector->along_line(1, x, d, 3.0);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->point.norm(), 1.0, 1e-3);
  EXPECT_NEAR((hit->point - x).cross(d).norm(), 0.0, 1e-9);
  EXPECT_LT(hit->distance, 1.0);  // the nearer of two crossings
}

TEST(Reconstruction, RefusesFacetsWithoutArea) {
  FacetMesh mesh = facets_of(icosphere(0));
  EXPECT_THROW((void)reconstruct(FacetMesh{}), GeometryError);
  mesh.facets[3][1] = mesh.facets[3][0];
  EXPECT_THROW((void)reconstruct(mesh), GeometryError);
}

}  // namespace
}  // namespace camber
