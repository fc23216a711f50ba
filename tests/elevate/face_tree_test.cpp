#include <camber/elevate/face_tree.hpp>

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

#include "layer_meshes.hpp"

namespace camber {
namespace {

using namespace testing;

/// Nearest point of a triangle by minimising over a fine barycentric grid, then over its finer
/// neighbourhoods: obvious, slow, good to 1e-9.
double brute_distance(const Vec3& x, const std::array<Vec3, 3>& t) {
  double a = 1.0 / 3.0, b = 1.0 / 3.0, best = 1e300;
  for (double step = 0.5; step > 1e-9; step *= 0.6) {
    const double a0 = a, b0 = b;
    for (int i = -3; i <= 3; ++i) {
      for (int j = -3; j <= 3; ++j) {
        const double u = std::clamp(a0 + i * step / 3.0, 0.0, 1.0);
        const double v = std::clamp(b0 + j * step / 3.0, 0.0, 1.0 - u);
        const double d = (u * t[0] + v * t[1] + (1.0 - u - v) * t[2] - x).norm();
        if (d < best) {
          best = d;
          a = u;
          b = v;
        }
      }
    }
  }
  return best;
}

struct Shell {
  LinearMesh mesh;
  Topology topology;
  std::vector<Index> faces;
};

Shell shell_of(const SurfaceMesh& surface) {
  Shell shell;
  shell.mesh = build_linear_mesh(
      layers_on(surface, {0.0, 0.1}, [](const Vec3& x) -> Vec3 { return x.normalized(); }));
  shell.topology = build_topology(shell.mesh);
  for (Index f = 0; at(f) < shell.topology.face_count(); ++f) {
    const Index b = shell.topology.face2patch_face[at(f)];
    if (b != k_none && shell.mesh.patch_face_entity[at(b)] == 1) shell.faces.push_back(f);
  }
  return shell;
}

double brute_distance(const Shell& shell, Index item, const Vec3& x) {
  const Index f = shell.faces[at(item)];
  const auto corner = [&](std::size_t i) {
    return shell.mesh.vertices[at(shell.topology.face2vertex[at(f)][i])];
  };
  double d = brute_distance(x, {corner(0), corner(1), corner(2)});
  if (shell.topology.face_shape[at(f)] == Shape::quadrilateral) {
    d = std::min(d, brute_distance(x, {corner(0), corner(2), corner(3)}));
  }
  return d;
}

std::vector<Vec3> random_points(int count) {
  std::mt19937 random(11);
  std::uniform_real_distribution<double> value(-1.6, 1.6);
  std::vector<Vec3> points;
  for (int i = 0; i < count; ++i) points.emplace_back(value(random), value(random), value(random));
  return points;
}

TEST(FaceTree, FindsWhatBruteForceFinds) {
  for (const SurfaceMesh& surface : {icosphere(1), cubed_sphere(3)}) {
    const Shell shell = shell_of(surface);
    const FaceTree tree(shell.mesh, shell.topology, shell.faces,
                        std::vector<int>(shell.faces.size(), 0));
    for (const Vec3& x : random_points(25)) {
      double nearest = 1e300;
      for (Index i = 0; at(i) < shell.faces.size(); ++i) {
        nearest = std::min(nearest, brute_distance(shell, i, x));
      }
      FaceHit hit;

      ASSERT_TRUE(tree.nearest(x, 10.0, hit));

      EXPECT_NEAR(hit.distance, nearest, 1e-7);
      EXPECT_NEAR((hit.point - x).norm(), hit.distance, 1e-14);
      EXPECT_FALSE(tree.nearest(x, 0.99 * hit.distance, hit));
    }
  }
}

TEST(FaceTree, ReferencePointsLieWhereTheHitIs) {
  const Shell shell = shell_of(icosphere(1));
  const FaceTree tree(shell.mesh, shell.topology, shell.faces,
                      std::vector<int>(shell.faces.size(), 0));
  for (const Vec3& x : random_points(50)) {
    FaceHit hit;
    ASSERT_TRUE(tree.nearest(x, 10.0, hit));
    const std::array<Index, 4>& v = shell.topology.face2vertex[at(shell.faces[at(hit.item)])];
    const Vec3 from_xi = (1.0 - hit.xi.x() - hit.xi.y()) * shell.mesh.vertices[at(v[0])] +
                         hit.xi.x() * shell.mesh.vertices[at(v[1])] +
                         hit.xi.y() * shell.mesh.vertices[at(v[2])];
    EXPECT_LT((from_xi - hit.point).norm(), 1e-14);
  }
}

TEST(FaceTree, AnswersOncePerLabelSortedByDistance) {
  const Shell shell = shell_of(icosphere(1));
  std::vector<int> labels;
  for (std::size_t i = 0; i < shell.faces.size(); ++i)
    labels.push_back(static_cast<int>(i % 7) % 5);
  const FaceTree tree(shell.mesh, shell.topology, shell.faces, labels);
  std::vector<FaceHit> hits;
  for (const Vec3& x : random_points(20)) {
    const double radius = 0.9;
    std::array<double, 5> nearest;
    nearest.fill(1e300);
    for (Index i = 0; at(i) < shell.faces.size(); ++i) {
      double& d = nearest[static_cast<std::size_t>(labels[at(i)])];
      d = std::min(d, brute_distance(shell, i, x));
    }

    tree.nearest_per_label(x, radius, hits);

    std::size_t expected = 0;
    for (double d : nearest) expected += d <= radius;
    ASSERT_EQ(hits.size(), expected);
    for (std::size_t i = 0; i < hits.size(); ++i) {
      const int label = tree.label(hits[i].item);
      EXPECT_NEAR(hits[i].distance, nearest[static_cast<std::size_t>(label)], 1e-7);
      if (i > 0) {
        EXPECT_LE(hits[i - 1].distance, hits[i].distance);
      }
    }
  }
}

TEST(FaceTree, TiesGoToTheLowestFace) {
  // From the centre of a sphere of equal triangles everything is equally near; over a vertex six
  // are.
  const Shell shell = shell_of(icosphere(0));
  const FaceTree tree(shell.mesh, shell.topology, shell.faces,
                      std::vector<int>(shell.faces.size(), 0));
  for (const Vec3& vertex : icosphere(0).points) {
    Index lowest = k_none;
    for (Index i = 0; at(i) < shell.faces.size() && lowest == k_none; ++i) {
      const std::array<Index, 4>& v = shell.topology.face2vertex[at(shell.faces[at(i)])];
      for (std::size_t k = 0; k < 3; ++k) {
        if ((shell.mesh.vertices[at(v[k])] - vertex).norm() < 1e-12) lowest = i;
      }
    }
    FaceHit hit;
    ASSERT_TRUE(tree.nearest(vertex, 1.0, hit));
    EXPECT_EQ(hit.item, lowest);
    EXPECT_EQ(hit.distance, 0.0);
  }
}

TEST(FaceTree, WithoutFacesFindsNothing) {
  const FaceTree tree;
  FaceHit hit;
  std::vector<FaceHit> hits(3);

  EXPECT_TRUE(tree.is_empty());
  EXPECT_FALSE(tree.nearest(Vec3::Zero(), 1e9, hit));
  tree.nearest_per_label(Vec3::Zero(), 1e9, hits);

  EXPECT_TRUE(hits.empty());
}

}  // namespace
}  // namespace camber
