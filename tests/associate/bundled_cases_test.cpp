// The bundled cases against the bodies they were meshed from, through the CAD kernel.
#include <camber/associate/by_tags.hpp>
#include <camber/associate/cad_scale.hpp>
#include <camber/base/error.hpp>
#include <camber/geom_occ/cad_file.hpp>
#include <camber/io/mesh_file.hpp>

#include <set>
#include <string>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace camber {
namespace {

const std::string k_cases = std::string(CAMBER_SOURCE_DIR) + "/cases/";

struct Linked {
  std::unique_ptr<GeometryModel> geometry;
  LinearMesh mesh;
  Topology topology;
  Association association;
};

Linked link(const MeshData& data, const std::string& body) {
  Linked result;
  result.geometry = read_cad(k_cases + body + "/body.step");
  result.mesh = build_linear_mesh(data);
  result.topology = build_topology(result.mesh);
  fit_cad_scale(data, *result.geometry);
  result.association = associate_by_tags(result.mesh, result.topology, *result.geometry);
  return result;
}

MeshData mesh_of(const std::string& name) { return io::read_mesh(k_cases + name + "/linear.msh"); }

TEST(BundledCases, LieOnTheirCad) {
  for (const char* name : {"ball", "wing", "elbow"}) {
    const Linked linked = link(mesh_of(name), name);

    EXPECT_EQ(linked.association.scale, 1.0) << name;
    EXPECT_LT(linked.association.largest_distance, 1e-6 * linked.mesh.size()) << name;
    // The CAD faces without mesh faces: none.
    std::set<int> linked_faces;
    for (const Patch& patch : linked.association.patches) {
      for (const GeomEntity& face : patch.group) linked_faces.insert(face.tag);
    }
    EXPECT_EQ(linked_faces.size(), static_cast<std::size_t>(linked.geometry->count(2))) << name;
  }
}

TEST(BundledCases, HaveTheirWallEdgesOnTheCurvesOfTheirLineElements) {
  for (const char* name : {"ball", "wing", "elbow"}) {
    const Linked linked = link(mesh_of(name), name);
    std::size_t on_curves = 0;
    const std::unique_ptr<Projector> projector = linked.geometry->projector();
    for (Index e = 0; at(e) < linked.topology.edge_count(); ++e) {
      const GeomEntity curve = linked.association.edge2curve[at(e)];
      if (curve.dim != 1) continue;
      ++on_curves;
      for (Index v : linked.topology.edge2vertex[at(e)]) {
        EXPECT_LT(projector->closest(curve, linked.mesh.vertices[at(v)]).distance, 1e-6);
      }
    }
    std::size_t expected = 0;
    for (const LinearMesh::Line& line : linked.mesh.lines) {
      expected +=
          line.curve <= linked.geometry->count(1) && !linked.geometry->is_degenerate(line.curve)
              ? 1u
              : 0u;
    }
    EXPECT_EQ(on_curves, expected) << name;
  }
}

TEST(BundledCases, FindEdgesBetweenCadFacesWithoutLineElements) {
  // The ball's only curve is its seam: one face on both sides, nothing to find there.
  for (const char* name : {"wing", "elbow"}) {
    MeshData data = mesh_of(name);
    const Linked with_lines = link(data, name);
    std::erase_if(data.blocks,
                  [](const ElementBlock& block) { return block.shape == Shape::line; });
    const Linked without = link(data, name);

    std::size_t compared = 0;
    for (Index e = 0; at(e) < with_lines.topology.edge_count(); ++e) {
      const GeomEntity expected = with_lines.association.edge2curve[at(e)];
      if (expected.dim != 1 || with_lines.geometry->faces_of_curve(expected.tag).size() != 2)
        continue;
      EXPECT_EQ(without.association.edge2curve[at(e)], expected) << name << " edge " << e;
      ++compared;
    }
    EXPECT_GT(compared, 20u) << name;
  }
}

TEST(BundledCases, InAnotherUnitAreFoundAndScaled) {
  MeshData data = mesh_of("elbow");
  for (Vec3& x : data.points) x *= 1e-3;
  const Linked linked = link(data, "elbow");

  EXPECT_DOUBLE_EQ(linked.association.scale, 1e-3);
  EXPECT_LT(linked.association.largest_distance, 1e-6 * linked.mesh.size());
}

TEST(BundledCases, RefuseTheCadOfAnotherCase) {
  const std::array<std::array<const char*, 2>, 3> wrong{
      {{"wing", "ball"}, {"ball", "elbow"}, {"elbow", "wing"}}};
  for (const auto& [mesh, body] : wrong) {
    EXPECT_THROW(static_cast<void>(link(mesh_of(mesh), body)), GeometryError)
        << mesh << " on " << body;
  }
}

}  // namespace
}  // namespace camber
