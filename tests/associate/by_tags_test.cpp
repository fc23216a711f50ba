// Association against an analytic sphere: every answer is known.
#include <camber/associate/by_tags.hpp>
#include <camber/associate/cad_scale.hpp>
#include <camber/base/error.hpp>
#include <camber/geom/analytic_model.hpp>

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "../support/cube_mesh.hpp"

namespace camber {
namespace {

using testing::cube_mesh;
using testing::Filling;
using ::testing::HasSubstr;
using testing::transform;

/// Nodes take the entity of lowest dimension that lists them, as a mesher classifies them.
void classify_points(MeshData& data) {
  data.point_entity.assign(data.points.size(), EntityKey{});
  for (const ElementBlock& block : data.blocks) {
    const EntityKey key{dimension(block.shape), block.entity};
    for (Index n : block.nodes) {
      EntityKey& best = data.point_entity[at(n)];
      if (best.dim < 0 || key < best) best = key;
    }
  }
}

/// A hybrid block whose side 1 lies on the unit sphere around the origin; sides 3 to 6 are planes
/// through it and side 2 lies on the sphere of radius 2. No line elements.
MeshData shell(double scale = 1.0) {
  MeshData data = cube_mesh(Filling::hybrid, 2, 3);
  transform(data, [&](const Vec3& x) {
    return Vec3(scale * (1.0 + x.x()) * Vec3(x.y() - 0.5, x.z() - 0.5, 1.0).normalized());
  });
  std::erase_if(data.blocks, [](const ElementBlock& block) { return block.shape == Shape::line; });
  data.entities = {{{2, 1}, "ball", {}, {}}, {{2, 2}, "far", {}, {}}};
  classify_points(data);
  return data;
}

struct Linked {
  LinearMesh mesh;
  Topology topology;
  Association association;
};

Linked link(const MeshData& data, const GeometryModel& model, const TagOptions& options = {}) {
  Linked result;
  result.mesh = build_linear_mesh(data);
  result.topology = build_topology(result.mesh);
  result.association = associate_by_tags(result.mesh, result.topology, model, options);
  return result;
}

const Patch& patch(const Linked& linked, int entity) {
  for (const Patch& p : linked.association.patches) {
    if (p.entity == entity) return p;
  }
  throw std::out_of_range("no patch has the entity " + std::to_string(entity));
}

std::unique_ptr<GeometryModel> unit_sphere() { return make_sphere(Vec3::Zero(), 1.0); }

/// The message of the Error that `run` ends in.
template <class Run>
std::string refusal(Run run) {
  try {
    run();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(AssociateByTags, PutsEveryBoundaryFaceOnThePatchOfItsTag) {
  const Linked linked = link(shell(), *unit_sphere());

  ASSERT_EQ(linked.association.patches.size(), 6u);
  for (Index f = 0; at(f) < linked.topology.face_count(); ++f) {
    const Patch* p = linked.association.patch_of(f);
    ASSERT_EQ(p == nullptr, !linked.topology.is_boundary(f));
    if (!p) continue;
    const Index b = linked.topology.face2patch_face[at(f)];
    EXPECT_EQ(p->entity, linked.mesh.patch_face_entity[at(b)]);
  }
}

TEST(AssociateByTags, TellsCadFromPlanesAndFromTheRest) {
  const Linked linked = link(shell(), *unit_sphere());

  EXPECT_EQ(patch(linked, 1).kind, PatchKind::cad);
  EXPECT_EQ(patch(linked, 1).name, "ball");
  EXPECT_EQ(patch(linked, 1).group, (GeometryGroup{{2, 1}}));
  EXPECT_EQ(patch(linked, 2).kind, PatchKind::straight);
  EXPECT_EQ(patch(linked, 2).name, "far");
  for (int side = 3; side <= 6; ++side) {
    const Patch& p = patch(linked, side);
    EXPECT_EQ(p.kind, PatchKind::plane);
    EXPECT_TRUE(p.group.empty());
    EXPECT_NEAR(p.origin.dot(p.normal), 0.0, 1e-14);  // through the origin
    EXPECT_NEAR(p.normal.norm(), 1.0, 1e-14);
  }
}

TEST(AssociateByTags, LinksTheVerticesOfTheWallAndNoOthers) {
  const Linked linked = link(shell(), *unit_sphere());

  for (std::size_t v = 0; v < linked.mesh.vertices.size(); ++v) {
    const bool is_on_sphere = std::abs(linked.mesh.vertices[v].norm() - 1.0) < 1e-9;
    EXPECT_EQ(linked.association.vertex2entity[v],
              is_on_sphere ? (GeomEntity{2, 1}) : GeomEntity{});
  }
  EXPECT_LT(linked.association.largest_distance, 1e-15);
  EXPECT_EQ(linked.association.scale, 1.0);
}

TEST(AssociateByTags, RefusesAnotherCadAndNamesTheEntityAndTheDistance) {
  const auto larger = make_sphere(Vec3::Zero(), 1.01);

  const std::string message = refusal([&] { static_cast<void>(link(shell(), *larger)); });

  EXPECT_THAT(message, HasSubstr("surface 1 lies 0.01 away"));
  EXPECT_THAT(message, HasSubstr("vertex"));
}

TEST(AssociateByTags, AlsoMeasuresVerticesThatTheFileDoesNotClassify) {
  MeshData data = shell();
  data.point_entity.clear();

  EXPECT_LT(link(data, *unit_sphere()).association.largest_distance, 1e-15);
  const auto larger = make_sphere(Vec3::Zero(), 1.01);
  EXPECT_THAT(refusal([&] { static_cast<void>(link(data, *larger)); }), HasSubstr("0.01 away"));
}

TEST(AssociateByTags, AcceptsADistanceWithinItsTolerance) {
  // The walls' box measures about 1.4: the default allows 1.4e-4.
  EXPECT_NO_THROW(static_cast<void>(link(shell(), *make_sphere(Vec3::Zero(), 1.00005))));
  TagOptions wide;
  wide.distance_tolerance = 0.1;
  EXPECT_NEAR(link(shell(), *make_sphere(Vec3::Zero(), 1.01), wide).association.largest_distance,
              0.01, 1e-12);
}

TEST(AssociateByTags, ClassifiesFacesWithoutSurfaceElementByTheirVertices) {
  MeshData data = shell();
  std::size_t listed = 0;
  for (const ElementBlock& block : data.blocks) {
    if (dimension(block.shape) == 2 && block.entity == 1) listed += block.size();
  }
  ASSERT_GT(listed, 0u);
  std::erase_if(data.blocks, [](const ElementBlock& block) {
    return dimension(block.shape) == 2 && block.entity == 1;
  });

  const Linked linked = link(data, *unit_sphere());

  // Vertices on the border are classified on side 1 too, as it is the lowest of their sides.
  EXPECT_EQ(patch(linked, 1).faces, listed);
  EXPECT_EQ(patch(linked, 1).kind, PatchKind::cad);
  EXPECT_EQ(linked.association.patches.size(), 6u);
}

TEST(AssociateByTags, KeepsFacesUnclassifiedThatNothingSpeaksFor) {
  MeshData data = shell();
  std::erase_if(data.blocks, [](const ElementBlock& block) {
    return dimension(block.shape) == 2 && block.entity == 2;
  });
  for (EntityKey& key : data.point_entity) {
    if (key == EntityKey{2, 2}) key = {3, 1};
  }

  const Linked linked = link(data, *unit_sphere());

  EXPECT_EQ(patch(linked, 0).name, "unclassified");
  EXPECT_EQ(patch(linked, 0).kind, PatchKind::straight);
}

TEST(PatchRules, SetAPatchFreeOrFixItWhereItIs) {
  for (const char* name : {"ball", "1", "surface 1"}) {
    TagOptions options;
    options.patches[name] = PatchRule::fixed;
    const Linked linked = link(shell(), *unit_sphere(), options);
    EXPECT_EQ(patch(linked, 1).kind, PatchKind::straight) << name;
    EXPECT_TRUE(patch(linked, 1).group.empty());
  }
  TagOptions options;
  options.patches = {{"3", PatchRule::fixed}, {"4", PatchRule::free}, {"5", PatchRule::plane}};
  const Linked linked = link(shell(), *unit_sphere(), options);
  EXPECT_EQ(patch(linked, 3).kind, PatchKind::straight);
  EXPECT_EQ(patch(linked, 4).kind, PatchKind::plane);
  EXPECT_EQ(patch(linked, 5).kind, PatchKind::plane);
}

TEST(PatchRules, KeepAWallOnItsCad) {
  TagOptions options;
  options.patches["ball"] = PatchRule::wall;
  EXPECT_EQ(patch(link(shell(), *unit_sphere(), options), 1).kind, PatchKind::cad);
}

TEST(PatchRules, RefuseAPlaneThatIsNone) {
  TagOptions options;
  options.patches["far"] = PatchRule::plane;
  EXPECT_THAT(refusal([&] { static_cast<void>(link(shell(), *unit_sphere(), options)); }),
              HasSubstr("patch far is not planar"));
}

TEST(PatchRules, RefuseANameThatNoPatchHasAndListThoseThereAre) {
  TagOptions options;
  options.patches["bal"] = PatchRule::fixed;
  const std::string message =
      refusal([&] { static_cast<void>(link(shell(), *unit_sphere(), options)); });
  EXPECT_THAT(message, HasSubstr("no patch is named bal"));
  EXPECT_THAT(message, HasSubstr("ball, far"));
}

TEST(FitCadScale, FindsTheUnitOfTheMesh) {
  for (double scale : {1.0, 1e-3, 1e3, 25.4, 1.0 / 25.4}) {
    const auto model = unit_sphere();
    EXPECT_DOUBLE_EQ(fit_cad_scale(shell(scale), *model), scale);
    const Linked linked = link(shell(scale), *model);
    EXPECT_DOUBLE_EQ(linked.association.scale, scale);
    EXPECT_LT(linked.association.largest_distance, 1e-14 * scale);
    // Once found it stays.
    EXPECT_DOUBLE_EQ(fit_cad_scale(shell(scale), *model), scale);
  }
}

TEST(FitCadScale, RefusesASizeThatNoUnitExplains) {
  for (double scale : {0.5, 3.0, 0.2}) {
    const auto model = unit_sphere();
    EXPECT_THAT(refusal([&] { fit_cad_scale(shell(scale), *model); }),
                HasSubstr("do not fit in any usual unit"));
  }
}

TEST(FitCadScale, TakesTheScaleThatItIsGiven) {
  const auto model = unit_sphere();
  EXPECT_EQ(fit_cad_scale(shell(0.5), *model, 0.5), 0.5);
  EXPECT_LT(link(shell(0.5), *model).association.largest_distance, 1e-15);
}

TEST(FitCadScale, RefusesAMeshWhoseTagsAreAllAboveThoseOfTheCad) {
  MeshData data = shell();
  for (ElementBlock& block : data.blocks) {
    if (dimension(block.shape) == 2) block.entity += 100;
  }
  const auto model = unit_sphere();
  EXPECT_THAT(refusal([&] { fit_cad_scale(data, *model); }),
              HasSubstr("no surface of the mesh refers to the CAD, which has faces 1..1"));
}

TEST(FitPlane, FindsThePlaneOfAnyMixOfFaces) {
  std::mt19937 random(4);
  for (int k = 0; k < 5; ++k) {
    MeshData data = cube_mesh(Filling::hybrid, 2, 5);
    transform(data, testing::random_affine(random));
    const LinearMesh mesh = build_linear_mesh(data);
    const Topology topology = build_topology(mesh);
    std::vector<Index> all;
    for (const auto& [entity, faces] : boundary_faces_by_entity(mesh, topology)) {
      Vec3 origin, normal;
      ASSERT_TRUE(fit_plane(mesh, topology, faces, 1e-12, origin, normal));
      for (Index f : faces) {
        for (int i = 0; i < topology.corners_of_face(f); ++i) {
          const Vec3& x =
              mesh.vertices[at(topology.face2vertex[at(f)][static_cast<std::size_t>(i)])];
          EXPECT_NEAR((x - origin).dot(normal), 0.0, 1e-14);
        }
      }
      all.insert(all.end(), faces.begin(), faces.end());
    }
    Vec3 origin, normal;
    EXPECT_FALSE(fit_plane(mesh, topology, all, 1e-12, origin, normal));
  }
}

}  // namespace
}  // namespace camber
