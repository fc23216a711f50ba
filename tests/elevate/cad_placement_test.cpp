// Placement on the kernel's surfaces and curves: seams, poles, arc length.
#include <camber/geom_occ/cad_file.hpp>

#include <cmath>
#include <filesystem>
#include <numbers>
#include <unistd.h>

#include <gtest/gtest.h>

#include <BRepBuilderAPI_MakeEdge.hxx>
#include <BRepBuilderAPI_MakeFace.hxx>
#include <BRepBuilderAPI_MakeWire.hxx>
#include <BRepPrimAPI_MakePrism.hxx>
#include <BRepPrimAPI_MakeSphere.hxx>
#include <BRepTools.hxx>
#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <STEPControl_Writer.hxx>
#include <gp_Elips.hxx>

#include "layer_meshes.hpp"

namespace camber {
namespace {

using namespace testing;

std::unique_ptr<GeometryModel> through_file(const TopoDS_Shape& shape,
                                            const std::string& extension) {
  const std::string path =
      ::testing::TempDir() + "camber_elevate_" + std::to_string(getpid()) + extension;
  if (extension == ".step") {
    Message::DefaultMessenger()->ChangePrinters().Clear();
    STEPControl_Writer writer;
    writer.Transfer(shape, STEPControl_AsIs);
    writer.Write(path.c_str());
  } else {
    BRepTools::Write(shape, path.c_str());
  }
  auto model = read_cad(path);
  std::filesystem::remove(path);
  return model;
}

TEST(CadPlacement, PutsEveryNodeOnTheKernelsSphereSeamAndPolesIncluded) {
  // Vertices on both poles, edges across the seam and faces around the poles.
  for (double turn : {0.0, 0.4}) {
    SurfaceMesh surface = icosphere(1);
    const Eigen::AngleAxisd tilt(turn, Vec3(1.0, 2.0, 0.3).normalized());
    for (Vec3& x : surface.points) x = tilt * x;
    const auto c = make_case(
        layers_on(surface, {0.0, 0.1}, [](const Vec3& x) -> Vec3 { return x.normalized(); }),
        through_file(BRepPrimAPI_MakeSphere(1.0).Shape(), ".step"));
    ASSERT_EQ(c->wall.face_count(), 80u);
    for (int q = 2; q <= 4; ++q) {
      for (Index slot = 0; at(slot) < c->wall.edge_count(); ++slot) {
        EXPECT_FALSE(c->placement->is_edge_unplaced(slot));
        for (const Vec3& x : c->placement->edge_nodes(slot, q)) EXPECT_NEAR(x.norm(), 1.0, 1e-14);
      }
      for (Index slot = 0; at(slot) < c->wall.face_count(); ++slot) {
        EXPECT_FALSE(c->placement->is_face_unplaced(slot));
        for (const Vec3& x : c->placement->face_nodes(slot, q)) EXPECT_NEAR(x.norm(), 1.0, 1e-14);
      }
    }
  }
}

constexpr double k_a = 2.0, k_b = 1.0;

/// Arc length of the ellipse between two parameters, by Simpson's rule.
double ellipse_length(double t0, double t1) {
  constexpr int n = 200;
  const auto speed = [](double t) { return std::hypot(k_a * std::sin(t), k_b * std::cos(t)); };
  double sum = speed(t0) + speed(t1);
  for (int i = 1; i < n; ++i) sum += speed(t0 + (t1 - t0) * i / n) * (i % 2 == 1 ? 4.0 : 2.0);
  return sum * (t1 - t0) / n / 3.0;
}

/// A cylinder over an ellipse, its mesh outside, rim edges classified on the CAD's rims.
std::unique_ptr<Case> elliptic_cylinder() {
  const gp_Elips ellipse(gp_Ax2(gp_Pnt(0, 0, 0), gp_Dir(0, 0, 1), gp_Dir(1, 0, 0)), k_a, k_b);
  const TopoDS_Face base =
      BRepBuilderAPI_MakeFace(BRepBuilderAPI_MakeWire(BRepBuilderAPI_MakeEdge(ellipse).Edge()));
  auto model = through_file(BRepPrimAPI_MakePrism(base, gp_Vec(0, 0, 1)).Shape(), ".brep");
  const auto projector = model->projector();
  int wall = 0;
  for (int face = 1; face <= model->count(2); ++face) {
    if (!model->is_planar(face)) wall = face;
  }
  LayerOptions options;
  options.wall_entity = wall;
  options.lateral_entity = [](const Vec3& x) { return x.z() < 0.5 ? 1001 : 1002; };
  options.rim_curve = [&](const Vec3& x) {
    for (int curve : model->curves_of_face(wall)) {
      if (model->is_seam(curve, wall)) continue;
      if (std::abs(projector->closest({1, curve}, x).point.z() - x.z()) < 1e-6) return curve;
    }
    return 0;
  };
  const auto around = [](double u, double v) {
    const double t = 2.0 * std::numbers::pi * u;
    return Vec3(k_a * std::cos(t), k_b * std::sin(t), v);
  };
  const auto away = [](const Vec3& x) -> Vec3 {
    return Vec3(x.x() / (k_a * k_a), x.y() / (k_b * k_b), 0.0).normalized();
  };
  const MeshData data = layers_on(grid(10, 2, around, false, true), {0.0, 0.1, 1.0}, away, options);
  return make_case(data, std::move(model));
}

TEST(CadPlacement, SpreadsNodesOnCurvesEvenlyInArcLength) {
  const auto c = elliptic_cylinder();
  std::size_t on_curves = 0;
  for (Index slot = 0; at(slot) < c->wall.edge_count(); ++slot) {
    const Index e = c->wall.edges[at(slot)];
    if (c->association.edge2curve[at(e)].dim != 1) continue;
    ++on_curves;
    for (int q = 2; q <= 4; ++q) {
      Points nodes{c->mesh.vertices[at(c->topology.edge2vertex[at(e)][0])]};
      for (const Vec3& x : c->placement->edge_nodes(slot, q)) nodes.push_back(x);
      nodes.push_back(c->mesh.vertices[at(c->topology.edge2vertex[at(e)][1])]);
      std::vector<double> pieces;
      for (std::size_t i = 0; i + 1 < nodes.size(); ++i) {
        EXPECT_NEAR(std::hypot(nodes[i].x() / k_a, nodes[i].y() / k_b), 1.0, 1e-13);
        const double t0 = std::atan2(nodes[i].y() / k_b, nodes[i].x() / k_a);
        const double t1 = std::atan2(nodes[i + 1].y() / k_b, nodes[i + 1].x() / k_a);
        const double step = std::remainder(t1 - t0, 2.0 * std::numbers::pi);
        pieces.push_back(std::abs(ellipse_length(t0, t0 + step)));
      }
      for (double piece : pieces) EXPECT_NEAR(piece, pieces[0], 1e-9);
    }
  }
  EXPECT_EQ(on_curves, 20u);
}

TEST(CadPlacement, LoweredFacesKeepTheirCurveEdgesUntilTheyAreStraight) {
  const auto c = elliptic_cylinder();
  Index slot = k_none, rim = k_none;
  for (Index s = 0; at(s) < c->wall.edge_count() && slot == k_none; ++s) {
    if (c->association.edge2curve[at(c->wall.edges[at(s)])].dim != 1) continue;
    rim = s;
    slot = c->wall.edge_faces[at(s)][0];
  }
  ASSERT_NE(slot, k_none);
  const std::span<const Vec3> nodes = c->placement->edge_nodes(rim, 4);
  const Points before(nodes.begin(), nodes.end());

  static_cast<void>(c->placement->lower({{slot, 2}}));
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_EQ(c->placement->edge_nodes(rim, 4)[i], before[i]);
  }
  static_cast<void>(c->placement->lower({{slot, 1}}));
  for (const Vec3& u : c->placement->edge_displacement(rim, 4)) EXPECT_EQ(u, Vec3::Zero());
}

}  // namespace
}  // namespace camber
