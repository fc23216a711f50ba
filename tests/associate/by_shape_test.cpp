// Association by shape where every answer is known: analytic surfaces and plates of our own.
#include <camber/associate/by_shape.hpp>
#include <camber/associate/cad_scale.hpp>
#include <camber/associate/given_link.hpp>
#include <camber/base/error.hpp>
#include <camber/geom/analytic_model.hpp>

#include <cmath>
#include <optional>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../support/cube_mesh.hpp"

namespace camber {
namespace {

using testing::cube_mesh;
using testing::Filling;
using ::testing::HasSubstr;
using testing::transform;

/// Plane faces z = heights[i] over a rectangle (x from lower[i] to upper[i], y from 0 to 1), with
/// normals up or down; no curves. What a thin wing's sides look like to an association.
class Plates final : public GeometryModel {
 public:
  struct Plate {
    double height, lower, upper;
    bool is_up;
  };
  explicit Plates(std::vector<Plate> plates) : plates_(std::move(plates)) {}

  [[nodiscard]] int count(int dim) const override {
    return dim == 2 ? static_cast<int>(plates_.size()) : 0;
  }
  [[nodiscard]] std::string name(GeomEntity) const override { return ""; }
  [[nodiscard]] Box box() const override {
    Box all;
    for (int f = 1; f <= count(2); ++f) {
      all.add(box({2, f}).lower);
      all.add(box({2, f}).upper);
    }
    return all;
  }
  [[nodiscard]] Box box(GeomEntity entity) const override {
    const Plate& p = plate(entity.tag);
    Box box;
    box.add(Vec3(p.lower, 0.0, p.height));
    box.add(Vec3(p.upper, 1.0, p.height));
    return box;
  }
  [[nodiscard]] double tolerance(GeomEntity) const override { return 1e-7; }
  [[nodiscard]] bool is_degenerate(int) const override { return false; }
  [[nodiscard]] bool is_seam(int, int) const override { return false; }
  [[nodiscard]] bool is_planar(int) const override { return true; }
  [[nodiscard]] bool is_straight(int) const override { return true; }
  [[nodiscard]] std::vector<int> faces_of_curve(int) const override { return {}; }
  [[nodiscard]] std::vector<int> curves_of_face(int) const override { return {}; }
  [[nodiscard]] std::vector<int> vertices_of_curve(int) const override { return {}; }
  [[nodiscard]] CurveRange range(int) const override { return {}; }
  [[nodiscard]] Vec2 periods(int) const override { return Vec2::Zero(); }
  [[nodiscard]] Vec2 curve_on_face(int, int, double, const std::optional<Vec2>&) const override {
    return Vec2::Zero();
  }
  [[nodiscard]] std::unique_ptr<Projector> projector() const override;
  void set_scale(double) override {}
  [[nodiscard]] double scale() const override { return 1.0; }
  [[nodiscard]] const Plate& plate(int face) const { return plates_[at(face - 1)]; }

 private:
  std::vector<Plate> plates_;
};

class PlateProjector final : public Projector {
 public:
  explicit PlateProjector(const Plates& plates) : plates_(plates) {}
  [[nodiscard]] Projection closest(GeomEntity entity, const Vec3& x,
                                   const std::optional<Vec2>&) override {
    const Plates::Plate& p = plates_.plate(entity.tag);
    Projection foot;
    foot.entity = entity;
    foot.point = Vec3(std::clamp(x.x(), p.lower, p.upper), std::clamp(x.y(), 0.0, 1.0), p.height);
    foot.uv = Vec2(foot.point.x(), foot.point.y());
    foot.distance = (x - foot.point).norm();
    foot.status = ProjectionStatus::inside;
    return foot;
  }
  [[nodiscard]] std::optional<Projection> along_line(int, const Vec3&, const Vec3&, double,
                                                     const std::optional<Vec2>&) override {
    return {};
  }
  [[nodiscard]] SurfacePoint evaluate_face(int face, const Vec2& uv) override {
    const Plates::Plate& p = plates_.plate(face);
    return {Vec3(uv.x(), uv.y(), p.height), Vec3::UnitX(), Vec3::UnitY(),
            p.is_up ? Vec3(0, 0, 1) : Vec3(0, 0, -1)};
  }
  [[nodiscard]] CurvePoint evaluate_curve(int, double) override { return {}; }
  void divide_curve(int, double, double, std::span<const double>, std::span<Projection>) override {}
  [[nodiscard]] double curve_length(int, double, double) override { return 0.0; }

 private:
  const Plates& plates_;
};

std::unique_ptr<Projector> Plates::projector() const {
  return std::make_unique<PlateProjector>(*this);
}

MeshData without_tags(MeshData data) {
  std::erase_if(data.blocks, [](const ElementBlock& block) { return dimension(block.shape) < 3; });
  data.point_entity.clear();
  data.entities.clear();
  return data;
}

/// A block whose side 1 lies on the unit sphere, side 2 on that of radius 2, the others on planes.
MeshData shell(double scale = 1.0) {
  MeshData data = cube_mesh(Filling::hybrid, 2, 3);
  transform(data, [&](const Vec3& x) {
    return Vec3(scale * (1.0 + x.x()) * Vec3(x.y() - 0.5, x.z() - 0.5, 1.0).normalized());
  });
  return without_tags(std::move(data));
}

struct Linked {
  LinearMesh mesh;
  Topology topology;
  ShapeLink link;
};

Linked link(const MeshData& data, const GeometryModel& model, const TagOptions& options = {}) {
  Linked result;
  result.mesh = build_linear_mesh(data);
  result.topology = build_topology(result.mesh);
  result.link = associate_by_shape(result.mesh, result.topology, model, options);
  return result;
}

/// Groups of the boundary faces whose corners all fulfil a condition.
template <class Condition>
std::vector<GeometryGroup> groups_where(const Linked& linked, const Condition& holds) {
  std::vector<GeometryGroup> groups;
  for (Index f = 0; at(f) < linked.topology.face_count(); ++f) {
    const Patch* patch = linked.link.association.patch_of(f);
    if (!patch) continue;
    bool all = true;
    for (int i = 0; i < linked.topology.corners_of_face(f); ++i) {
      all =
          all &&
          holds(linked.mesh
                    .vertices[at(linked.topology.face2vertex[at(f)][static_cast<std::size_t>(i)])]);
    }
    if (all) groups.push_back(patch->group);
  }
  return groups;
}

TEST(AssociateByShape, FindsTheSphereAndLeavesTheOtherSides) {
  const auto sphere = make_sphere(Vec3::Zero(), 1.0);
  const Linked linked = link(shell(), *sphere);

  const auto wall =
      groups_where(linked, [](const Vec3& x) { return std::abs(x.norm() - 1.0) < 1e-9; });
  ASSERT_FALSE(wall.empty());
  for (const GeometryGroup& group : wall) EXPECT_EQ(group, (GeometryGroup{{2, 1}}));
  EXPECT_EQ(linked.link.on_cad, wall.size());
  EXPECT_EQ(linked.link.straddling, 0u);
  std::size_t planes = 0, straight = 0, cad = 0;
  for (const Patch& patch : linked.link.association.patches) {
    planes += patch.kind == PatchKind::plane;
    straight += patch.kind == PatchKind::straight;
    cad += patch.kind == PatchKind::cad;
  }
  EXPECT_EQ(cad, 1u);
  EXPECT_EQ(planes, 4u);
  EXPECT_GE(straight, 1u);
  EXPECT_LT(linked.link.association.largest_distance, 1e-14);
}

TEST(AssociateByShape, FindsTheUnitWithoutTags) {
  for (double scale : {1.0, 1e-3, 1e3, 25.4, 0.1}) {
    const auto sphere = make_sphere(Vec3::Zero(), 1.0);
    const LinearMesh mesh = build_linear_mesh(shell(scale));
    EXPECT_DOUBLE_EQ(fit_cad_scale_by_shape(mesh, build_topology(mesh), *sphere), scale);
  }
}

TEST(AssociateByShape, RefusesACadThatIsSomewhereElse) {
  const auto sphere = make_sphere(Vec3(7.0, 0.0, 0.0), 1.0);
  const LinearMesh mesh = build_linear_mesh(shell());
  const Topology topology = build_topology(mesh);
  EXPECT_THROW(fit_cad_scale_by_shape(mesh, topology, *sphere), GeometryError);
  EXPECT_THROW(static_cast<void>(associate_by_shape(mesh, topology, *sphere)), GeometryError);
}

TEST(AssociateByShape, NeverTakesTheOtherSideOfAThinWing) {
  // The fluid above and below a wing of chord 1 that is 1e-4 thick. Vertices may be 1e-4 of the
  // size off the CAD, so both sides are in reach of all of them; off by a tenth of the thickness,
  // they are still nearer to their own.
  constexpr double thickness = 1e-4;
  const Plates wing({{thickness, 0.0, 1.0, true}, {0.0, 0.0, 1.0, false}});
  for (double off : {0.0, 0.1 * thickness}) {
    for (Filling filling : testing::k_fillings) {
      MeshData above = without_tags(cube_mesh(filling, 3, 5));
      transform(above, [&](const Vec3& x) {
        return Vec3(x.x(), x.y(), x.z() == 0.0 ? thickness - off : thickness + x.z());
      });
      MeshData below = without_tags(cube_mesh(filling, 3, 6));
      transform(below, [&](const Vec3& x) {
        return Vec3(x.x(), x.y(), x.z() == 1.0 ? off : x.z() - 1.0);
      });
      const auto on_wing = [](const Vec3& x) { return std::abs(x.z()) < 2e-4; };
      const auto upper = groups_where(link(above, wing), on_wing);
      const auto lower = groups_where(link(below, wing), on_wing);
      ASSERT_GE(upper.size(), 9u);
      ASSERT_GE(lower.size(), 9u);
      for (const GeometryGroup& group : upper) EXPECT_EQ(group, (GeometryGroup{{2, 1}}));
      for (const GeometryGroup& group : lower) EXPECT_EQ(group, (GeometryGroup{{2, 2}}));
    }
  }
}

TEST(AssociateByShape, PutsFacesAcrossCadEdgesOnAllCadFacesUnderThem) {
  // The CAD is cut at x = 0.5 and x = 0.55; the mesh has lines at thirds.
  const Plates plates({{0.0, 0.0, 0.5, false},
                       {0.0, 0.5, 0.55, false},
                       {0.0, 0.55, 1.0, false},
                       {-1e-3, 0.0, 1.0, true}});
  const Linked linked = link(without_tags(cube_mesh(Filling::hexes, 3, 2)), plates);

  std::size_t across = 0;
  for (const Patch& patch : linked.link.association.patches) {
    if (patch.group.size() < 2) continue;
    across += patch.faces;
    // The narrow face holds no node, and the far sheet 1e-3 below is none of them.
    for (const GeomEntity& face : patch.group) EXPECT_NE(face.tag, 4);
    EXPECT_EQ(patch.kind, PatchKind::plane);
  }
  EXPECT_EQ(across, 3u);
  EXPECT_EQ(linked.link.straddling, 3u);
  EXPECT_EQ(linked.link.on_cad, 9u);
}

TEST(AssociateByShape, ObeysThePatchRulesAndMaps) {
  MeshData data = cube_mesh(Filling::hexes, 2, 1);
  const Plates two({{0.0, 0.0, 1.0, false}, {1.0, 0.0, 1.0, true}});
  const Linked plain = link(data, two);
  EXPECT_EQ(plain.link.on_cad, 8u);
  int bottom = 0;
  for (const Patch& patch : plain.link.association.patches) {
    if (patch.group == GeometryGroup{{2, 1}}) bottom = patch.entity;
  }
  const std::string name = std::to_string(bottom);

  TagOptions options;
  options.patches[name] = PatchRule::fixed;
  EXPECT_EQ(link(data, two, options).link.on_cad, 4u);
  options = {};
  options.faces[name] = {"face_1"};
  EXPECT_EQ(link(data, two, options).link.on_cad, 8u);
  options.faces[name] = {"face_2"};
  EXPECT_EQ(link(data, two, options).link.on_cad, 4u);
  options.faces[name] = {"face_9"};
  EXPECT_THROW(static_cast<void>(link(data, two, options)), OptionError);
  options.faces = {{"nobody", {"face_1"}}};
  EXPECT_THROW(static_cast<void>(link(data, two, options)), OptionError);
}

TEST(AssociateGiven, DoesAsItIsToldAndRefusesWhatDoesNotFit) {
  const auto sphere = make_sphere(Vec3::Zero(), 1.0);
  const Linked found = link(shell(), *sphere);
  GivenLink given;
  given.face_group.resize(found.topology.face_count());
  given.edge_group.resize(found.topology.edge_count());
  for (Index f = 0; at(f) < found.topology.face_count(); ++f) {
    if (const Patch* patch = found.link.association.patch_of(f)) {
      given.face_group[at(f)] = patch->group;
    }
  }
  const Association again = associate_given(found.mesh, found.topology, *sphere, given);
  EXPECT_EQ(again.face2patch, found.link.association.face2patch);

  for (Index f = 0; at(f) < found.topology.face_count(); ++f) {
    if (found.topology.is_boundary(f)) given.face_group[at(f)] = {{2, 1}};
  }
  try {
    static_cast<void>(associate_given(found.mesh, found.topology, *sphere, given));
    FAIL() << "faces off the CAD were taken";
  } catch (const GeometryError& error) {
    EXPECT_THAT(error.what(), HasSubstr("1 away from face_1"));
  }
}

}  // namespace
}  // namespace camber
